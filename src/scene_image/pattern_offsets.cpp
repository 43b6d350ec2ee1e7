#include "scene_image/pattern_offsets.hpp"

#include "celltrace/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <type_traits>

#include <glm/geometric.hpp>

namespace celltrace {

namespace {

/// Limit on offsets that stay as they are, in units.
constexpr double kNear = 4096;
/// The period of noise, and of other functions of its unit cubes, in units.
constexpr double kOfNoise = 4096;
/// The period of waves, as in POV-Ray.
constexpr double kOfWave = 1.00001;
/// The period of a function that any shift leaves unchanged.
constexpr double kAny = std::numeric_limits<double>::infinity();

/// Periods by axis, after which a pattern or a step has the same results. Shifts are multiples of a period; a
/// period of 0 allows no shift.
using Periods = Vec3;

constexpr double kFixed = 0;

bool is_still(const Turbulence& turbulence) {
  return turbulence.amount == Vec3(0);
}

/// Returns the periods of turbulence. Its octaves have a common period only if the period of the first octave
/// is a multiple of the periods of finer octaves.
Periods of(const Turbulence& turbulence) {
  if (is_still(turbulence)) return Periods(kAny);
  return Periods(turbulence.lambda == std::floor(turbulence.lambda) ? kOfNoise : kFixed);
}

/// Returns the larger of two periods if it is a multiple of the smaller one, else kFixed.
double common(double a, double b) {
  if (a == kFixed || b == kFixed) return kFixed;
  if (a == kAny || b == kAny) return std::min(a, b);
  const double larger = std::max(a, b), smaller = std::min(a, b);
  return std::fmod(larger, smaller) == 0 ? larger : kFixed;
}
Periods common(const Periods& a, const Periods& b) {
  return {common(a.x, b.x), common(a.y, b.y), common(a.z, b.z)};
}

// Periods of the kinds of patterns that have one.

constexpr double kRootOfThree = std::numbers::sqrt3;

struct PeriodsOfKind {
  const Pattern& pattern;
  const Vec3& at; ///< offset of the points at which the pattern is evaluated

  /// Returns the period of a pattern whose values are not cut to one unit before they become a wave.
  double of_wave() const { return pattern.frequency != 0 ? std::abs(kOfWave / pattern.frequency) : kFixed; }

  Periods operator()(const pattern::Checker&) const { return Periods(2); }
  Periods operator()(const pattern::Square&) const { return {2, kAny, 2}; }
  Periods operator()(const pattern::Hexagon&) const {
    constexpr double kHeight = 0.866025404;
    return {3, kAny, 6 * kHeight};
  }
  Periods operator()(const pattern::Triangular&) const { return {3, kAny, kRootOfThree}; }
  Periods operator()(const pattern::Brick& brick) const {
    return {std::abs(brick.size.x), 2 * std::abs(brick.size.y), std::abs(brick.size.z)};
  }
  Periods operator()(const pattern::Quilted&) const { return Periods(1); }
  Periods operator()(const pattern::Leopard&) const { return Periods(2 * std::numbers::pi); }
  Periods operator()(const pattern::Marble&) const {
    const bool is_plain = pattern.turbulence.amount.x == 0;
    return is_plain ? Periods(of_wave(), kAny, kAny)
                    : Periods(pattern.frequency != 0 ? kOfNoise : kFixed, kOfNoise, kOfNoise);
  }
  Periods operator()(const pattern::Agate&) const { return {kOfNoise, kOfNoise, 10 * kOfNoise}; }
  Periods operator()(const pattern::Bozo&) const { return Periods(kOfNoise); }
  Periods operator()(const pattern::Bumps&) const { return Periods(kOfNoise); }
  Periods operator()(const pattern::Dents&) const { return Periods(kOfNoise); }
  Periods operator()(const pattern::Granite&) const { return Periods(kOfNoise); }
  Periods operator()(const pattern::Wrinkles&) const { return Periods(kOfNoise); }
  Periods operator()(const pattern::Cells&) const { return Periods(kOfNoise); }
  Periods operator()(const pattern::Crackle&) const { return Periods(kOfNoise); }
  Periods operator()(const pattern::Facets& facets) const {
    return Periods(facets.size > 0 ? kFixed : kOfNoise);
  }
  Periods operator()(const pattern::Planar&) const { return {kAny, kFixed, kAny}; }
  Periods operator()(const pattern::Cylindrical&) const { return {kFixed, kAny, kFixed}; }
  /// Returns the periods of a gradient: positive values are cut to one unit, while of negative values only
  /// the wave repeats.
  Periods operator()(const pattern::Gradient& gradient) const {
    const Vec3 along = glm::normalize(gradient.direction);
    Periods periods(kFixed);
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(along[axis]) == 1) {
        periods = Periods(kAny);
        periods[axis] = at[axis] * along[axis] > 0 ? 1 : of_wave();
      }
    return periods;
  }
  template <class Other> Periods operator()(const Other&) const { return Periods(kFixed); }
};

/// The part of an offset that is left after a shift.
enum class Left {
  least,     ///< as little as possible
  same_side, ///< enough to stay on the same side of 0, for patterns that differ between the sides
};

Vec3 whole_periods(const Vec3& offset, const Periods& periods, Left left = Left::least) {
  constexpr double kSide = 512;
  Vec3 whole(0);
  for (int axis = 0; axis < 3; ++axis) {
    const double at = offset[axis], period = periods[axis];
    if (std::abs(at) <= kNear || period == kFixed) continue;
    if (period == kAny)
      whole[axis] = at;
    else if (left == Left::least)
      whole[axis] = std::round(at / period) * period;
    else
      whole[axis] = std::copysign(std::floor((std::abs(at) - kSide) / period) * period, at);
  }
  return whole;
}

/// Returns a shift towards the origin by whole shells. Shells farther than kFlat units from the origin count
/// as flat.
Vec3 whole_shells(const Vec3& offset, double period) {
  constexpr double kFlat = 8192;
  const double distance = glm::length(offset);
  if (distance <= 2 * kFlat || !(period > 0)) return Vec3(0);
  return offset * (std::floor((distance - kFlat) / period) * period / distance);
}

Vec3 shift_of(const Pattern& pattern, const Vec3& offset) {
  const PeriodsOfKind of_kind{pattern, offset};
  const bool moves_points = !std::holds_alternative<pattern::Marble>(pattern.kind) &&
                            !std::holds_alternative<pattern::Wood>(pattern.kind);
  if (is_still(pattern.turbulence)) {
    if (const auto* gradient = std::get_if<pattern::Gradient>(&pattern.kind)) {
      // Shifts points along the gradient's direction, which need not be along an axis.
      const Vec3 along = glm::normalize(gradient->direction);
      const double at = glm::dot(along, offset);
      if (glm::length(offset) <= kNear) return Vec3(0);
      const double period = at > 0 ? 1 : of_kind.of_wave();
      return offset - along * at + along * whole_periods(Vec3(at, 0, 0), Periods(period), Left::same_side).x;
    }
    const Vec3 off_axis(offset.x, offset.y, 0);
    const auto around_axis = [&](double period, double along) {
      return whole_shells(off_axis, period) + whole_periods(offset, {kFixed, kFixed, along});
    };
    if (std::holds_alternative<pattern::Onion>(pattern.kind)) return whole_shells(offset, 1);
    if (std::holds_alternative<pattern::Wood>(pattern.kind)) return around_axis(of_kind.of_wave(), kAny);
    if (const auto* spiral = std::get_if<pattern::Spiral>(&pattern.kind)) {
      const double period = spiral->is_crossed ? 1 : of_kind.of_wave();
      return around_axis(period, period);
    }
    if (std::holds_alternative<pattern::Ripples>(pattern.kind) && pattern.frequency != 0)
      return whole_shells(offset, std::abs(1 / pattern.frequency));
  }
  Periods periods = std::visit(of_kind, pattern.kind);
  if (moves_points) periods = common(periods, of(pattern.turbulence));
  const bool has_sides = std::holds_alternative<pattern::Gradient>(pattern.kind) ||
                         std::holds_alternative<pattern::Marble>(pattern.kind);
  return whole_periods(offset, periods, has_sides ? Left::same_side : Left::least);
}

/// Returns by how much the points before a step may be shifted.
Vec3 shift_of(const SpaceStep& step, const Vec3& offset) {
  if (const auto* turbulence = std::get_if<Turbulence>(&step)) return whole_periods(offset, of(*turbulence));
  if (const auto* repeat = std::get_if<warp::Repeat>(&step)) {
    if (repeat->offset != Vec3(0)) return Vec3(0);
    const bool is_flipped = repeat->flip != Vec3(0);
    Periods periods(is_flipped ? kFixed : kAny);
    periods[repeat->axis] = std::abs(repeat->width) * (is_flipped ? 2 : 1);
    return whole_periods(offset, periods);
  }
  if (const auto* hole = std::get_if<warp::BlackHole>(&step); hole != nullptr && hole->repeat == Vec3(0))
    return whole_periods(offset, Periods(kAny));
  return Vec3(0);
}

/// Returns a step that acts on shifted points as `step` does on unshifted points.
SpaceStep shifted(const SpaceStep& step, const Vec3& shift) {
  const auto* hole = std::get_if<warp::BlackHole>(&step);
  if (hole == nullptr) return step;
  warp::BlackHole nearer = *hole;
  nearer.centre -= shift;
  return nearer;
}

/// Returns the shift of points after a step if `shift` is their shift before it.
Vec3 after(const SpaceStep& step, Vec3 shift) {
  if (const auto* repeat = std::get_if<warp::Repeat>(&step)) shift[repeat->axis] = 0;
  return shift;
}

} // namespace

PlacedPattern near_own_origin(const Pattern& pattern, const std::vector<SpaceStep>& space) {
  PlacedPattern placed = {pattern.kind, space, pattern.phase};
  std::vector<SpaceStep> steps; // in the order in which points go through them
  Vec3 carried(0);              // sum of the shifts of points so far
  bool is_shifted = false;
  Transform map;
  const auto end_map = [&](const auto& next) {
    map.rows[3] += map.direction(carried);
    const Vec3 shift = shift_of(next, map.rows[3]);
    map.rows[3] -= shift;
    is_shifted = is_shifted || shift != Vec3(0);
    if (!map.is_identity()) steps.emplace_back(map.inverse());
    map = Transform();
    return shift;
  };
  for (auto step = space.rbegin(); step != space.rend(); ++step) {
    if (const auto* transform = std::get_if<Transform>(&*step)) {
      map = map.then(transform->inverse());
      continue;
    }
    const Vec3 shift = end_map(*step);
    carried = after(*step, shift);
    steps.push_back(shifted(*step, shift));
  }
  // Slopes and object patterns do not repeat. Far from the origin, a slope's heights and an object pattern's
  // solid are moved instead.
  if (auto* slope = std::get_if<pattern::Slope>(&placed.kind);
      slope != nullptr && is_still(pattern.turbulence)) {
    const Vec3 offset = map.rows[3] + map.direction(carried);
    const double climbing = glm::length(slope->altitude);
    if (climbing > 0 && glm::length(offset) > kNear) {
      const double height = glm::dot(slope->altitude, offset) / climbing;
      slope->lowest -= height;
      slope->highest -= height;
      carried = Vec3(0);
      map.rows[3] = Vec3(0);
      is_shifted = true;
    }
  } else if (auto* solid = std::get_if<pattern::Inside>(&placed.kind);
             solid != nullptr && solid->of && is_still(pattern.turbulence)) {
    const Vec3 offset = map.rows[3] + map.direction(carried);
    if (glm::length(offset) > kNear) {
      Object moved = *solid->of;
      const Transform back = Transform::translate(-offset);
      moved.transform = moved.transform.then(back);
      if (moved.clipped_by) {
        auto clips = *moved.clipped_by;
        for (Object& clip : clips)
          clip.transform = clip.transform.then(back);
        moved.clipped_by = std::make_shared<const std::vector<Object>>(std::move(clips));
      }
      solid->of = std::make_shared<const Object>(std::move(moved));
      carried = Vec3(0);
      map.rows[3] = Vec3(0);
      is_shifted = true;
    }
  }
  const Vec3 shift = end_map(pattern);
  // The turbulence of marble has another period than its wave: the wave's phase takes the rest of the shift.
  if (std::holds_alternative<pattern::Marble>(pattern.kind) && pattern.turbulence.amount.x != 0)
    placed.phase += std::fmod(shift.x * pattern.frequency, kOfWave);
  if (!is_shifted) return {pattern.kind, space, pattern.phase};
  std::reverse(steps.begin(), steps.end());
  placed.space = std::move(steps);
  return placed;
}

} // namespace celltrace
