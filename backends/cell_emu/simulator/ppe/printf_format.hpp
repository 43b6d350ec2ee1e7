// The conversions of the printf family, for arguments in local store.
#pragma once

#include "backends/cell_emu/simulator/ppe/call_arguments.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace celltrace::cell_emu {

/// Text that grows at its end. All of it is counted, but only a limited part is kept.
class FormattedText {
public:
  /// Largest text; more is refused with EOVERFLOW, so that no width keeps the PPE busy for long.
  static constexpr std::uint64_t kMostBytes = 16 << 20;

  explicit FormattedText(std::uint64_t most_kept = kMostBytes) : most_kept_(most_kept) {}

  void append(std::string_view text);
  void fill(char character, std::uint64_t count);

  std::uint64_t length() const { return length_; }
  const std::string& kept() const { return kept_; }

private:
  std::size_t grow(std::uint64_t count); // returns how many of them are kept

  std::uint64_t most_kept_, length_ = 0;
  std::string kept_;
};

/// Formats as C99's vprintf() does with 32-bit int, long and pointers, in the "C" locale, with glibc's
/// choices where C99 leaves one: "(nil)" and "(null)", "-nan", unknown conversions are copied.
/// Throws CallFailed: EFAULT for strings, and counts of %n, outside of local store; EINVAL for a
/// format that ends in a conversion; EILSEQ for wide characters that are not ASCII; EOVERFLOW.
void format_printf(FormattedText& text, std::string_view format, const LocalStoreView& local_store,
                   VariableArguments arguments);

} // namespace celltrace::cell_emu
