// The lights that illuminate each object, as bits for the kernel.
#pragma once

#include "celltrace/scene.hpp"

#include <cstdint>
#include <vector>

namespace celltrace {

/// The sets of lights that illuminate objects: set 0 has all global lights, set i + 1 has those of light
/// group i. A light in all sets takes no words.
class LightSets {
public:
  explicit LightSets(const Scene& scene);

  std::uint32_t count() const { return count_; }
  /// Returns for each light the index of its first word; kNoIndex if the light is in all sets. Bit b of a
  /// light's word w says whether set 32 w + b has the light.
  const std::vector<Index>& first_words() const { return first_words_; }
  const std::vector<std::uint32_t>& words() const { return words_; }

private:
  std::uint32_t count_;
  std::vector<Index> first_words_;
  std::vector<std::uint32_t> words_;
};

/// Throws InputError if there are too many groups, or if a group refers to a light that does not exist.
void validate_light_groups(const Scene& scene);

} // namespace celltrace
