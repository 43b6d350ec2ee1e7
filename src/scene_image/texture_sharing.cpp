#include "scene_image/texture_sharing.hpp"

#include <algorithm>
#include <memory>
#include <unordered_map>

namespace celltrace {

namespace {

/// Limit on entries of all maps if each texture has its own; they take some 20 MB. If there are more,
/// textures share maps.
constexpr double kManyEntries = 1 << 17;

/// Counts the entries of maps as if each use of a map had its own copy; in floating point, as the number may
/// exceed all integers.
class EntryCounter {
public:
  double of(const Material& material) {
    const double inside = material.inside ? of(*material.inside) : 0;
    if (material.map) return inside + of_map(material.map);
    return inside + of(material.pigment) + (material.normal ? of(*material.normal) : 0) +
           (material.below ? of(*material.below) : 0);
  }

private:
  double of(const Pigment& pigment) { return pigment.map ? of_map(pigment.map) : 0; }
  double of(const Normal& normal) { return normal.map ? of_map(normal.map) : 0; }
  template <class T> double of_map(const std::shared_ptr<const PatternMap<T>>& map) {
    const auto [known, is_new] = counts_.try_emplace(map.get(), 0);
    if (!is_new) return known->second;
    auto count = static_cast<double>(map->entries.size());
    for (const auto& entry : map->entries)
      count += of(entry.value);
    return counts_[map.get()] = count;
  }

  std::unordered_map<const void*, double> counts_;
};

} // namespace

TextureSharing::TextureSharing(const std::vector<Material>& materials) {
  EntryCounter counter;
  double count = 0;
  for (const Material& material : materials)
    count += counter.of(material);
  is_needed_ = count > kManyEntries;
}

bool TextureSharing::may_be_relative(const PatternMap<Pigment>& map) const {
  return std::any_of(map.entries.begin(), map.entries.end(),
                     [](const auto& entry) { return entry.value.map != nullptr; });
}

bool TextureSharing::may_be_relative(const PatternMap<Material>& map) {
  const auto [known, is_new] = same_everywhere_.try_emplace(&map, false);
  if (!is_new) return known->second;
  const bool all = std::all_of(map.entries.begin(), map.entries.end(),
                               [&](const auto& entry) { return is_same_everywhere(entry.value); });
  return same_everywhere_[&map] = all;
}

/// Returns whether a texture is the same at all points, except for its maps. A thin film's thickness may
/// vary.
bool TextureSharing::is_same_everywhere(const Material& material) {
  if (material.inside) return false;
  if (material.map) return may_be_relative(*material.map);
  return !material.pigment.map && !material.normal && material.finish.irid == 0 &&
         (!material.below || is_same_everywhere(*material.below));
}

} // namespace celltrace
