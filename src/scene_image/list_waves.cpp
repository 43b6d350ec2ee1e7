#include "scene_image/list_waves.hpp"

#include "kernel/textures/list.hpp"
#include "scene_image/patterns.hpp"

#include <cmath>
#include <numbers>

namespace celltrace {

using namespace kernel;

namespace {

std::uint32_t kind_of(const Pattern& pattern) {
  return pattern_words(pattern.kind, 1).kind_and_flags & pattern_flag::kind_mask;
}

} // namespace

bool is_list(const Pattern& pattern) {
  return Patterns::kAreLists[kind_of(pattern)];
}

bool is_colour(const Pattern& pattern) {
  return Patterns::is_colour(kind_of(pattern));
}

bool blends_list(const Pattern& pattern) {
  const bool has_wave = pattern.wave != Pattern::Wave::ramp;
  return (has_wave || (pattern.frequency != 0 && pattern.frequency != 1)) && is_list(pattern);
}

double in_wave(const Pattern& pattern, std::size_t number) {
  auto v = static_cast<double>(number);
  if (pattern.frequency != 0 && pattern.frequency != 1) {
    v = std::fmod(v * pattern.frequency + pattern.phase, 1.00001);
    if (v < 0) v -= std::floor(v);
  }
  const double turn = v - std::floor(v);
  switch (pattern.wave) {
  case Pattern::Wave::ramp:
    return v;
  case Pattern::Wave::triangle:
    return turn <= 0.5 ? 2 * turn : 2 - 2 * turn;
  case Pattern::Wave::sine:
    return (1 + std::sin(2 * std::numbers::pi * turn)) / 2;
  case Pattern::Wave::scallop:
    return std::abs(std::sin(std::numbers::pi * v));
  case Pattern::Wave::cubic:
    return v * v * (3 - 2 * v);
  case Pattern::Wave::poly:
    return std::pow(v, pattern.wave_exponent);
  }
  return v;
}

} // namespace celltrace
