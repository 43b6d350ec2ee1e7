#include "scene_image/pattern_space.hpp"

#include "scene_image/record_vectors.hpp"

#include <variant>

#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

void fill(SpaceStepRecord& r, const Turbulence& t) {
  r.kind_and_flags = static_cast<std::uint32_t>(WarpKind::turbulence);
  r.turbulence = words_of(t);
}
void fill(SpaceStepRecord& r, const warp::Repeat& w) {
  r.kind_and_flags = static_cast<std::uint32_t>(WarpKind::repeat) | static_cast<std::uint32_t>(w.axis)
                                                                        << warp_flag::axis_shift;
  r.value[0] = static_cast<float>(w.width);
  for (int i = 0; i < 3; ++i)
    r.value[1 + i] = w.flip[i] != 0 ? -1.0f : 1.0f;
  copy(w.offset, r.value + 4);
}
void fill(SpaceStepRecord& r, const warp::BlackHole& w) {
  r.kind_and_flags =
      static_cast<std::uint32_t>(WarpKind::black_hole) | (w.is_inverse ? warp_flag::inverse : 0);
  copy(w.centre, r.value);
  r.value[3] = static_cast<float>(w.radius);
  r.value[4] = static_cast<float>(w.strength);
  r.value[5] = static_cast<float>(w.falloff);
  copy(w.repeat, r.value + 6);
  copy(w.turbulence, r.turbulence.amount);
}
void fill(SpaceStepRecord& r, const warp::Mapping& w) {
  using Shape = warp::Mapping::Shape;
  const WarpKind kind = w.shape == Shape::planar        ? WarpKind::planar
                        : w.shape == Shape::cylindrical ? WarpKind::cylindrical
                        : w.shape == Shape::spherical   ? WarpKind::spherical
                                                        : WarpKind::toroidal;
  r.kind_and_flags = static_cast<std::uint32_t>(kind);
  copy(glm::normalize(w.orientation), r.value);
  r.value[3] = static_cast<float>(w.shape == Shape::planar ? w.distance : w.distance_exponent);
  r.value[4] = static_cast<float>(w.major_radius);
}
void fill(SpaceStepRecord&, const Transform&) {
} // the neighbouring records hold the transformation

} // namespace

TurbulenceWords words_of(const Turbulence& t) {
  return {{static_cast<float>(t.amount.x), static_cast<float>(t.amount.y), static_cast<float>(t.amount.z)},
          static_cast<float>(t.lambda),
          static_cast<float>(t.omega),
          static_cast<std::uint32_t>(t.octaves)};
}

bool is_still(const Turbulence& t) {
  return t.amount == Vec3(0);
}

bool is_moved_by_turbulence(const pattern::Kind& kind) {
  return !std::holds_alternative<pattern::Marble>(kind) && !std::holds_alternative<pattern::Wood>(kind);
}

Transform whole_map(const PatternSpace& space) {
  Transform map;
  for (const SpaceStep& step : space.steps)
    if (const auto* transform = std::get_if<Transform>(&step)) map = map.then(*transform);
  return map.then(space.of_normals);
}

PatternSpace space_of(const Pattern& pattern, const PatternSpace& outer) {
  if (pattern.uv_mapping) return {pattern.space, true, pattern.normal_space.then(whole_map(outer))};
  PatternSpace all = outer;
  all.steps.insert(all.steps.begin(), pattern.space.begin(), pattern.space.end());
  return all;
}

PatternSpace space_inside(const Pattern& pattern, const PatternSpace& outer) {
  PatternSpace inside = space_of(pattern, outer);
  if (is_moved_by_turbulence(pattern.kind) && !is_still(pattern.turbulence))
    inside.steps.insert(inside.steps.begin(), pattern.turbulence);
  return inside;
}

SpaceStepRecord record_of(const SpaceStep& step) {
  SpaceStepRecord r{};
  std::visit([&](const auto& one) { fill(r, one); }, step);
  return r;
}

bool reads_features(const SpaceStepRecord& r) {
  const float(&amount)[3] = r.turbulence.amount;
  return (r.kind_and_flags & warp_flag::kind_mask) == static_cast<std::uint32_t>(WarpKind::black_hole) &&
         (amount[0] != 0 || amount[1] != 0 || amount[2] != 0);
}

} // namespace celltrace
