// The events of a Chrome trace as JSON text ("Trace Event Format" by the Chromium authors).
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>

namespace celltrace::cell_emu {

/// Writes events through a buffer. For each event call begin(), then functions that add fields, then
/// functions that add arguments, then end(). Independent of the locale. Errors: the stream's own state.
class TraceEvents {
public:
  /// Opens the file. `out` must outlive this object.
  TraceEvents(std::ostream& out, std::uint64_t clock_hz);
  /// Completes the file; nothing may follow.
  void close();

  void begin(char phase, unsigned process, unsigned thread);
  /// Adds a time, written as microseconds with three decimals.
  void time(std::string_view key, std::uint64_t nanoseconds);
  void text(std::string_view key, std::string_view value);
  void identifier(std::uint64_t id);

  void argument(std::string_view key, std::uint64_t value);
  void argument(std::string_view key, std::string_view value);
  void argument_in_hex(std::string_view key, std::uint64_t value);

  void end();

private:
  void argument_key(std::string_view key);
  void append(std::uint64_t value, int base = 10);
  void append_quoted(std::string_view text);
  void flush();

  std::ostream& out_;
  std::string buffer_;
  bool first_event_ = true;
  bool in_arguments_ = false;
};

} // namespace celltrace::cell_emu
