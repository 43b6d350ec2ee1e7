// From the kinds of patterns as people write them to those of the kernel.
#pragma once

#include "celltrace/texture.hpp"
#include "records/pattern.hpp"

#include <cstdint>

namespace celltrace {

/// Which table a pattern reads.
enum class PatternTable : std::uint8_t { none, features, gradients, waves, slopes, pigments, objects };

/// What a kind is in PatternRecords.
struct PatternWords {
  std::uint32_t kind_and_flags = 0; ///< its number; of flags, those that follow from the kind
  float parameter[5] = {};
  PatternTable table = PatternTable::none;
  std::uint32_t fractal = 0; ///< a fractal_word
  kernel::SlopeRecord slope = {};
};
/// The table of a PatternRecord with these flags.
PatternTable pattern_table(std::uint32_t kind_and_flags);

/// Throws InputError if numbers of the kind mean nothing. `number_of_waves`: the scene's.
PatternWords pattern_words(const pattern::Kind& kind, int number_of_waves);

} // namespace celltrace
