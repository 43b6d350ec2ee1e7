// Which lights shine on which objects, as bits for the kernel.
#pragma once

#include "celltrace/scene.hpp"

#include <cstdint>
#include <vector>

namespace celltrace {

/// The sets of lights that objects are lit by: set 0 has all that are global, set i + 1 is light group i's.
/// What is in all sets takes no words.
class LightSets {
public:
  explicit LightSets(const Scene& scene);

  std::uint32_t count() const { return count_; }
  /// By light, the index of the first of its words, of which bit b of word w says whether set 32 w + b has
  /// it; kNoIndex: all have.
  const std::vector<Index>& first_words() const { return first_words_; }
  const std::vector<std::uint32_t>& words() const { return words_; }

private:
  std::uint32_t count_;
  std::vector<Index> first_words_;
  std::vector<std::uint32_t> words_;
};

/// Throws InputError if there are too many groups, or one refers to a light that is not there.
void validate_light_groups(const Scene& scene);

} // namespace celltrace
