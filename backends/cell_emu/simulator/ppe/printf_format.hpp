// format_printf(): the conversions of the printf family, for arguments in local store.
#pragma once

#include "backends/cell_emu/simulator/ppe/call_arguments.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace celltrace::cell_emu {

/// Text that grows at its end. The length of all text is counted, but only its beginning, up to a limit, is
/// kept.
class FormattedText {
public:
  /// Largest length of the text in bytes; a longer text is refused with EOVERFLOW, so that a large width
  /// cannot keep the PPE busy.
  static constexpr std::uint64_t kMostBytes = 16 << 20;

  explicit FormattedText(std::uint64_t most_kept = kMostBytes) : most_kept_(most_kept) {}

  void append(std::string_view text);
  void fill(char character, std::uint64_t count);

  std::uint64_t length() const { return length_; }
  const std::string& kept() const { return kept_; }

private:
  std::size_t grow(std::uint64_t count); // returns the number of added characters that are kept

  std::uint64_t most_kept_, length_ = 0;
  std::string kept_;
};

/// Formats as C99's vprintf() does with 32-bit int, long and pointers, in the "C" locale. Where C99 leaves a
/// choice, follows glibc: "(nil)", "(null)" and "-nan", and unknown conversions are copied. Throws
/// CallFailed: EFAULT if a string, or the count of %n, is outside of local store; EINVAL if the format ends
/// within a conversion; EILSEQ for wide characters that are not ASCII; EOVERFLOW for too long text.
void format_printf(FormattedText& text, std::string_view format, const LocalStoreView& local_store,
                   VariableArguments arguments);

} // namespace celltrace::cell_emu
