#include "reference/textures.hpp"

#include "celltrace/scene.hpp"
#include "reference/solids.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <glm/geometric.hpp>

namespace celltrace::reference {

namespace {

double fraction(double x) {
  return x - std::floor(x);
}

double number(const pattern::Checker&, const Vec3& p) {
  const double sum = std::floor(p.x) + std::floor(p.y) + std::floor(p.z);
  return sum - 2 * std::floor(sum / 2);
}
double number(const pattern::Gradient& gradient, const Vec3& p) {
  const double along = glm::dot(p, gradient.direction) / glm::length(gradient.direction);
  return along > 1 ? std::fmod(along, 1) : along;
}
double number(const pattern::Onion&, const Vec3& p) {
  return std::fmod(glm::length(p), 1);
}
double number(const pattern::Slope& slope, const SurfacePoint& p) {
  const double facing = glm::length(slope.direction), climbing = glm::length(slope.altitude);
  double sum = 0;
  if (facing > 0) {
    const double angle = std::acos(std::clamp(glm::dot(p.normal, slope.direction) / facing, -1.0, 1.0));
    sum += facing * (1 - angle / std::numbers::pi - slope.least) / (slope.most - slope.least);
  }
  if (climbing > 0)
    sum += climbing * (glm::dot(p.at, slope.altitude) / climbing - slope.lowest) /
           (slope.highest - slope.lowest);
  const double value = sum / (facing + climbing), beyond = std::fmod(value, 1);
  if (value > 1) return beyond;
  return value < 0 ? 1 + beyond : value;
}
double number(const pattern::Grey& grey, const SurfacePoint& p) {
  const Vec3 rgb = pigment_at(*grey.of, p).rgb;
  return 0.297 * rgb.x + 0.589 * rgb.y + 0.114 * rgb.z;
}
double number(const pattern::Inside& inside, const Vec3& p) {
  return is_inside(*inside.of, p) ? 1 : 0;
}
template <class Kind> double number(const Kind&, const Vec3&) {
  throw std::logic_error("the reference has no such pattern");
}

bool is_list(const pattern::Kind& kind) {
  return std::holds_alternative<pattern::Checker>(kind) || std::holds_alternative<pattern::Inside>(kind);
}

void add(Pigment& sum, double weight, const Pigment& pigment) {
  sum.rgb += weight * pigment.rgb;
  sum.filter += weight * pigment.filter;
  sum.transmit += weight * pigment.transmit;
}

} // namespace

double number_of(const pattern::Kind& kind, const Vec3& p) {
  return std::visit([&](const auto& one) { return number(one, p); }, kind);
}

double wave(const Pattern& pattern, double number) {
  using Wave = Pattern::Wave;
  const bool list = is_list(pattern.kind);
  if (pattern.frequency == 0 && pattern.wave == Wave::ramp && !list) return number;
  double v = pattern.frequency == 0 ? number : number * pattern.frequency + pattern.phase;
  if (list && (pattern.frequency == 0 || pattern.frequency == 1)) {
    v = number;
  } else {
    v = std::fmod(v, 1.00001);
    if (v < 0) v -= std::floor(v);
  }
  const double u = fraction(v);
  switch (pattern.wave) {
  case Wave::ramp:
    return v;
  case Wave::triangle:
    return u <= 0.5 ? 2 * u : 2 * (1 - u);
  case Wave::sine:
    return (1 + std::sin(2 * std::numbers::pi * u)) / 2;
  case Wave::scallop:
    return std::abs(std::sin(std::numbers::pi * v));
  case Wave::cubic:
    return v * v * (3 - 2 * v);
  case Wave::poly:
    return std::pow(v, pattern.wave_exponent);
  }
  throw std::logic_error("no such wave");
}

double value_of(const Pattern& pattern, const SurfacePoint& p) {
  if (const auto* slope = std::get_if<pattern::Slope>(&pattern.kind)) return wave(pattern, number(*slope, p));
  if (const auto* grey = std::get_if<pattern::Grey>(&pattern.kind)) return wave(pattern, number(*grey, p));
  return wave(pattern, number_of(pattern.kind, p.at));
}

Transform to_own_space(const Pattern& pattern) {
  Transform map;
  for (auto step = pattern.space.rbegin(); step != pattern.space.rend(); ++step)
    map = map.then(std::get<Transform>(*step).inverse());
  return map;
}

Pigment pigment_at(const Pigment& pigment, const SurfacePoint& point) {
  if (!pigment.map) return pigment;
  const PatternMap<Pigment>& map = *pigment.map;
  const auto& entries = map.entries;
  // What is in a map is in the space of the map's pattern.
  const SurfacePoint p = {
      to_own_space(map.pattern).point(map.pattern.uv_mapping ? point.coordinates : point.at),
      point.coordinates, point.normal};
  Pigment sum;
  if (map.is_average) {
    double weights = 0;
    for (const auto& entry : entries)
      weights += entry.position;
    for (const auto& entry : entries)
      add(sum, entry.position / weights, pigment_at(entry.value, p));
    return sum;
  }
  double value = value_of(map.pattern, p);
  if (is_list(map.pattern.kind)) {
    value = std::clamp(value, 0.0, static_cast<double>(entries.size() - 1));
    const auto below = static_cast<std::size_t>(value);
    const double share = fraction(value);
    add(sum, 1 - share, pigment_at(entries[below].value, p));
    if (share != 0) add(sum, share, pigment_at(entries[below + 1].value, p));
    return sum;
  }
  if (value < 0 || value > 1) value = fraction(value);
  if (value >= entries.back().position) return pigment_at(entries.back().value, p);
  std::size_t above = 0;
  while (value > entries[above].position)
    ++above;
  if (above == 0) return pigment_at(entries[0].value, p);
  const double from = entries[above - 1].position;
  const double share = (value - from) / (entries[above].position - from);
  add(sum, share, pigment_at(entries[above].value, p));
  add(sum, 1 - share, pigment_at(entries[above - 1].value, p));
  return sum;
}

} // namespace celltrace::reference
