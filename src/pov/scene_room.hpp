// Room in the lists of a scene's objects, and of what belongs to them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "pov/token_stream.hpp"

namespace celltrace::pov {

/// Bytes of the shortest object in a scene's text, "object{A}".
inline constexpr std::size_t kShortestObject = 9;

/// Before a list of all objects has to grow: as far as it will, if the rest of the scene is like what has
/// been read. In a large scene of small objects, moving them each time that their number has doubled takes
/// an eighth of the time, and memory for both copies of them. Never by more than some times their number: the
/// rest may be a comment.
template <class T> void make_room(std::vector<T>& list, const TokenStream& tokens) {
  constexpr std::size_t kFewest = 1024;
  if (list.size() < list.capacity() || list.size() < kFewest) return;
  const auto [read, left] = tokens.read_and_left();
  const double expected =
      static_cast<double>(list.size()) * static_cast<double>(left) / static_cast<double>(read);
  const double most = static_cast<double>(left) / kShortestObject;
  constexpr double kMargin = 1.03, kMostTimes = 16;
  const auto more = static_cast<std::size_t>(
      std::min(kMargin * std::min(expected, most), kMostTimes * static_cast<double>(list.size())));
  list.reserve(std::max(2 * list.size(), list.size() + more));
}

} // namespace celltrace::pov
