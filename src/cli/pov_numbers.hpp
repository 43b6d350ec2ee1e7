// Numbers as POV-Ray reads them on its command line and in INI files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace celltrace::cli {

/// A number at the front of a text.
struct FrontNumber {
  double value;
  std::string_view rest; ///< behind the number; blanks around it are left out
};

/// Reads a whole number: blanks, a sign, decimal digits, whatever follows. None: no digit is there.
std::optional<FrontNumber> read_whole(std::string_view text);

/// Reads a number as strtod() does in the C locale, but for words such as "inf": with a fraction, an exponent
/// or hexadecimal digits. One that is too large is infinite. None: no number is there.
std::optional<FrontNumber> read_real(std::string_view text);

/// Returns the shortest text that is read as the same number.
std::string number_text(double value);

} // namespace celltrace::cli
