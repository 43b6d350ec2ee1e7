#include "pov/nearest_word.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace celltrace::pov {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({changed, last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& words) {
  // Short words are similar to too many others; a distance takes time in proportion to the product of the
  // lengths, which the scene's author chooses.
  constexpr std::size_t kShortest = 4, kLongest = 64;
  if (word.size() < kShortest || word.size() > kLongest) return "";
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  std::string nearest;
  for (const std::string& each : words) {
    const std::size_t difference = std::max(each.size(), word.size()) - std::min(each.size(), word.size());
    if (difference >= least) continue;
    if (const std::size_t distance = edit_distance(word, each); distance < least) {
      least = distance;
      nearest = each;
    }
  }
  return nearest;
}

} // namespace celltrace::pov
