#include "render/quality.hpp"

#include <unordered_map>

namespace celltrace {

namespace {

/// Highest quality at which surfaces have only the colour of their pigment; quality 0 is the same as 1.
constexpr int kColoursOnly = 1;
constexpr int kNoShadows = 3;
constexpr int kNoAreas = 4;
constexpr int kAllSurfaces = 8; ///< lowest quality with complete surfaces and all lights

/// Reduces the quality of textures. Maps that textures share stay shared.
class Reducer {
public:
  explicit Reducer(int quality) : colours_only_(quality <= kColoursOnly) {}

  Material reduced(const Material& material) {
    Material result = material;
    result.normal = nullptr;
    result.finish.reflection_min = result.finish.reflection_max = Vec3(0, 0, 0);
    if (colours_only_) {
      // Uses the innermost layer alone.
      const Material* layer = &material;
      while (layer->below)
        layer = layer->below.get();
      result.pigment = opaque(layer->pigment);
      result.finish = Finish();
      result.finish.ambient = Vec3(0, 0, 0);
      result.finish.emission = Vec3(1, 1, 1);
      result.finish.diffuse = 0;
      result.below = nullptr;
    } else if (material.below) {
      result.below = std::make_shared<const Material>(reduced(*material.below));
    }
    if (material.map)
      result.map = mapped(materials_, material.map, [this](const Material& entry) { return reduced(entry); });
    return result;
  }

private:
  template <class T> using Map = std::shared_ptr<const PatternMap<T>>;

  Pigment opaque(const Pigment& pigment) {
    Pigment result = pigment;
    result.filter = result.transmit = 0;
    if (pigment.map)
      result.map = mapped(pigments_, pigment.map, [this](const Pigment& entry) { return opaque(entry); });
    return result;
  }

  template <class T, class Change>
  static Map<T> mapped(std::unordered_map<const void*, Map<T>>& known, const Map<T>& map, Change change) {
    if (const auto found = known.find(map.get()); found != known.end()) return found->second;
    PatternMap<T> result = *map;
    for (auto& entry : result.entries)
      entry.value = change(entry.value);
    return known[map.get()] = std::make_shared<const PatternMap<T>>(std::move(result));
  }

  bool colours_only_;
  std::unordered_map<const void*, Map<Material>> materials_;
  std::unordered_map<const void*, Map<Pigment>> pigments_;
};

} // namespace

Scene at_quality(const Scene& scene, int quality) {
  Scene result = scene;
  if (quality >= kFullQuality) return result;
  result.fogs.clear();
  result.rainbows.clear();
  if (quality >= kAllSurfaces) return result;
  Reducer reducer(quality);
  for (Material& material : result.materials)
    material = reducer.reduced(material);
  if (quality <= kColoursOnly) {
    result.lights.clear();
    for (LightGroup& group : result.light_groups)
      group.lights.clear();
  }
  if (quality <= kNoShadows) {
    for (Object& object : result.objects)
      object.no_shadow = true;
    for (Light& light : result.lights) {
      light.projected_through = nullptr;
      light.is_dimmed_by_fog = false;
    }
  }
  if (quality <= kNoAreas)
    for (Light& light : result.lights)
      light.area.reset();
  return result;
}

} // namespace celltrace
