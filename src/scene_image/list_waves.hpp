// The waves and frequencies of lists, which the kernel does not know: their entries are blended beforehand.
#pragma once

#include "celltrace/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

namespace celltrace {

/// As many entries as any list has.
constexpr std::size_t kMostListEntries = 6;

/// Whether a pattern chooses an entry of its map by a number, as checker does.
bool is_list(const Pattern& pattern);

/// Whether a pattern is a colour at every point, for which the entries of its map are what it is made of.
bool is_colour(const Pattern& pattern);

/// Whether the numbers of a list become others, between which its entries are blended.
bool blends_list(const Pattern& pattern);

/// What becomes of a number of a list. Frequency 1 is as good as none: then there is no phase either.
double in_wave(const Pattern& pattern, std::size_t number);

/// Whether blends of its entries are averages, which are maps.
inline bool needs_averages(const PatternMap<Pigment>& map) {
  return std::any_of(map.entries.begin(), map.entries.end(),
                     [](const auto& entry) { return entry.value.map != nullptr; });
}
template <class T> bool needs_averages(const PatternMap<T>&) {
  return true;
}

/// `share` of b, and the rest of a: as a map of both,
template <class T> T average(const T& a, const T& b, double share) {
  auto map = std::make_shared<PatternMap<T>>();
  map->is_average = true;
  map->entries = {{1 - share, a}, {share, b}};
  T blend{};
  blend.map = std::move(map);
  return blend;
}
/// or where that is possible without one.
template <class T> T blended(const T& a, const T& b, double share) {
  return average(a, b, share);
}
template <> inline Pigment blended(const Pigment& a, const Pigment& b, double share) {
  if (a.map || b.map) return average(a, b, share);
  const double rest = 1 - share;
  return {rest * a.rgb + share * b.rgb, rest * a.filter + share * b.filter,
          rest * a.transmit + share * b.transmit};
}

/// A list of blends without a wave.
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
