// Waves and frequencies of list patterns, which the kernel does not implement: the entries are blended
// beforehand.
#pragma once

#include "celltrace/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

namespace celltrace {

/// Limit on entries of a list.
constexpr std::size_t kMostListEntries = 6;

/// Returns whether a pattern chooses an entry of its map by an index, as checker does.
bool is_list(const Pattern& pattern);

/// Returns whether a pattern is a colour at every point, computed from the entries of its map.
bool is_colour(const Pattern& pattern);

/// Returns whether a list's wave or frequency turns its indices into other numbers, so that entries are
/// blended.
bool blends_list(const Pattern& pattern);

/// Returns the number into which a list's wave and frequency turn an index. A frequency of 1 counts as no
/// frequency, so that the phase is ignored as well.
double in_wave(const Pattern& pattern, std::size_t number);

/// Returns whether a blend of two of the map's entries has to be a map itself, an average.
inline bool needs_averages(const PatternMap<Pigment>& map) {
  return std::any_of(map.entries.begin(), map.entries.end(),
                     [](const auto& entry) { return entry.value.map != nullptr; });
}
template <class T> bool needs_averages(const PatternMap<T>&) {
  return true;
}

/// Returns a map that blends a and b: `share` is the weight of b.
template <class T> T average(const T& a, const T& b, double share) {
  auto map = std::make_shared<PatternMap<T>>();
  map->is_average = true;
  map->entries = {{1 - share, a}, {share, b}};
  T blend{};
  blend.map = std::move(map);
  return blend;
}
/// Returns a blend of a and b, without a map if that is possible.
template <class T> T blended(const T& a, const T& b, double share) {
  return average(a, b, share);
}
template <> inline Pigment blended(const Pigment& a, const Pigment& b, double share) {
  if (a.map || b.map) return average(a, b, share);
  const double rest = 1 - share;
  return {rest * a.rgb + share * b.rgb, rest * a.filter + share * b.filter,
          rest * a.transmit + share * b.transmit};
}

/// Returns a list without a wave that looks as `map` does with its wave: its entries are blends.
template <class T> std::shared_ptr<const PatternMap<T>> without_wave(const PatternMap<T>& map) {
  auto list = std::make_shared<PatternMap<T>>();
  list->pattern = map.pattern;
  list->pattern.wave = Pattern::Wave::ramp;
  list->pattern.frequency = 1;
  const double last = static_cast<double>(map.entries.size() - 1);
  for (std::size_t i = 0; i < kMostListEntries; ++i) {
    const double at = in_wave(map.pattern, i);
    const double value = at > 0 ? std::min(at, last) : 0;
    const auto below = static_cast<std::size_t>(value);
    const double share = value - std::floor(value);
    list->entries.push_back({static_cast<double>(i),
                             share == 0
                                 ? map.entries[below].value
                                 : blended(map.entries[below].value, map.entries[below + 1].value, share)});
  }
  return list;
}

} // namespace celltrace
