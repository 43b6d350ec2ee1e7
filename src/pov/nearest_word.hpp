// Guesses the word that a misspelt one was meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace celltrace::pov {

/// Returns how many letters have to be changed, added, left out or swapped with the next one.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns the one of `words` that `word` is most likely meant to be, the first of several; "" if none is
/// similar.
std::string nearest_word(std::string_view word, const std::vector<std::string>& words);

} // namespace celltrace::pov
