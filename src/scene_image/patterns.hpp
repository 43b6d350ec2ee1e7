// Converts the kinds of a Scene's patterns to the kinds of the kernel's patterns.
#pragma once

#include "celltrace/texture.hpp"
#include "records/pattern.hpp"
#include "records/picture.hpp"

#include <cstdint>

namespace celltrace {

/// The table that a pattern reads.
enum class PatternTable : std::uint8_t { none, features, gradients, waves, slopes, pigments, objects, pictures, functions };

/// The words of a PatternRecord that depend on the pattern's kind.
struct PatternWords {
  std::uint32_t kind_and_flags = 0; ///< the kind's number, and the flags that follow from it
  float parameter[5] = {};
  PatternTable table = PatternTable::none;
  std::uint32_t fractal = 0; ///< a fractal_word
  kernel::SlopeRecord slope = {};
  kernel::PictureRecord picture = {}; ///< without its tiles
};
/// Returns the table that a PatternRecord with these flags reads.
PatternTable pattern_table(std::uint32_t kind_and_flags);

/// Returns the words of a kind. Throws InputError if numbers of the kind are invalid. `number_of_waves` is
/// the scene's.
PatternWords pattern_words(const pattern::Kind& kind, int number_of_waves);

} // namespace celltrace
