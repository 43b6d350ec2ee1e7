// Numbers as POV-Ray reads them on its command line and in INI files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace celltrace::cli {

/// A number at the front of a text.
struct NumberPrefix {
  double value;
  std::string_view rest; ///< text after the number, without leading blanks
};

/// Reads an integer: blanks, a sign and decimal digits; any text may follow. Returns nothing if there is no
/// digit.
std::optional<NumberPrefix> read_whole(std::string_view text);

/// Reads a number as strtod() does in the C locale, except words such as "inf": with a fraction, an exponent
/// or hexadecimal digits. A number that is too large becomes infinite. Returns nothing if there is no number.
std::optional<NumberPrefix> read_real(std::string_view text);

/// Returns the shortest text that reads as the same number.
std::string number_text(double value);

} // namespace celltrace::cli
