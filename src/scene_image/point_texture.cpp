#include "scene_image/point_texture.hpp"

#include "kernel/textures/pigments.hpp"
#include "scene_image/point_simd.hpp"
#include "scene_image/scene_image.hpp"

#include <algorithm>

namespace celltrace {

using namespace kernel;

namespace {

/// Returns a scene with nothing but an object that has the pigment.
Scene scene_of(const Pigment& pigment, int noise_generator) {
  Scene scene;
  scene.noise_generator = noise_generator;
  Material material;
  material.pigment = pigment;
  Object object;
  object.shape = Sphere{{0, 0, 0}, 1};
  object.material = scene.add(material);
  object.interior = scene.add(Interior{});
  scene.objects.push_back(object);
  return scene;
}

/// Removes from a pigment's pattern the transformations that a point goes through first, since records would
/// hold them in single precision. Returns the inverse of these transformations.
Transform take_transform(Pigment& pigment) {
  Transform all;
  if (!pigment.map || pigment.map->pattern.uv_mapping) return all;
  auto map = std::make_shared<PatternMap<Pigment>>(*pigment.map);
  std::vector<SpaceStep>& space = map->pattern.space;
  while (!space.empty() && std::holds_alternative<Transform>(space.back())) {
    all = std::get<Transform>(space.back()).then(all);
    space.pop_back();
  }
  pigment.map = std::move(map);
  return all.inverse();
}

} // namespace

struct PointTexture::Image {
  Image(Pigment pigment, int noise_generator)
      : to_pattern(take_transform(pigment)), image(scene_of(pigment, noise_generator)),
        scene(spu, CacheConfig::off(), reinterpret_cast<ea_t>(image.base())) {
    const auto& material =
        *reinterpret_cast<const MaterialRecord*>(image.base() + image.header().material_offset);
    pattern = material.pattern;
    plain = pigment;
    plain.map = nullptr;
  }

  PatternPoints<PointSimd> points(const Vec3& point) const {
    const Vec3 at = to_pattern.point(point);
    return {{at.x, at.y, at.z}};
  }

  Transform to_pattern;
  Pigment plain;
  SceneImage image;
  PointSpu spu;
  SceneAccess<PointSpu> scene;
  std::uint32_t pattern;
};

PointTexture::PointTexture(const Pigment& pigment, int noise_generator)
    : image_(std::make_unique<Image>(pigment, noise_generator)) {
}
PointTexture::PointTexture(PointTexture&&) noexcept = default;
PointTexture& PointTexture::operator=(PointTexture&&) noexcept = default;
PointTexture::~PointTexture() = default;

Pigment PointTexture::pigment_at(const Vec3& point) const {
  if (image_->pattern == kNoOffset) return image_->plain;
  PigmentLanes<PointSimd> lanes;
  kernel::pigment_at<PointSpu>(image_->scene, image_->pattern, image_->points(point), 1, lanes);
  return {
      {lanes.rgb.x.value, lanes.rgb.y.value, lanes.rgb.z.value}, lanes.filter.value, lanes.transmit.value};
}

double PointTexture::pattern_at(const Vec3& point) const {
  const PatternRecord& r = *image_->scene.pattern(image_->pattern);
  const PatternPoints<PointSimd> points = image_->points(point);
  if (is_pigment(r)) {
    MapWalk<PointSpu, TextureStage::colours> walk(image_->scene, points);
    return in_wave<PointSimd>(r, walk.grey_of_pigment(r.table, points, 1)).value;
  }
  return pattern_value(image_->scene, r, to_pattern_space<TextureStage::colours>(image_->scene, r, points, 1))
      .value;
}

std::size_t PointTexture::bytes() const {
  return sizeof *image_ + image_->image.end_offset();
}

} // namespace celltrace
