#include "backends/cell_emu/trace_events.hpp"

#include <charconv>
#include <ostream>

namespace celltrace::cell_emu {

namespace {

constexpr std::size_t kBufferBytes = 1 << 16;

} // namespace

TraceEvents::TraceEvents(std::ostream& out, std::uint64_t clock_hz) : out_(out) {
  buffer_ += R"({"displayTimeUnit":"ns","otherData":{"time":"virtual","clock_hz":)";
  append(clock_hz);
  buffer_ += "},\"traceEvents\":[";
}

void TraceEvents::close() {
  buffer_ += "\n]}\n";
  flush();
  out_.flush();
}

void TraceEvents::begin(char phase, unsigned process, unsigned thread) {
  if (buffer_.size() >= kBufferBytes) flush();
  buffer_ += first_event_ ? "\n{" : ",\n{";
  first_event_ = false;
  buffer_ += "\"ph\":\"";
  buffer_ += phase;
  buffer_ += "\",\"pid\":";
  append(process);
  buffer_ += ",\"tid\":";
  append(thread);
}

void TraceEvents::time(std::string_view key, std::uint64_t nanoseconds) {
  buffer_ += ',';
  append_quoted(key);
  buffer_ += ':';
  append(nanoseconds / 1000);
  buffer_ += '.';
  for (const unsigned place : {100u, 10u, 1u})
    buffer_ += static_cast<char>('0' + nanoseconds / place % 10);
}

void TraceEvents::text(std::string_view key, std::string_view value) {
  buffer_ += ',';
  append_quoted(key);
  buffer_ += ':';
  append_quoted(value);
}

void TraceEvents::identifier(std::uint64_t id) {
  buffer_ += ",\"id\":\"0x";
  append(id, 16);
  buffer_ += '"';
}

void TraceEvents::argument(std::string_view key, std::uint64_t value) {
  argument_key(key);
  append(value);
}

void TraceEvents::argument(std::string_view key, std::string_view value) {
  argument_key(key);
  append_quoted(value);
}

void TraceEvents::argument_in_hex(std::string_view key, std::uint64_t value) {
  argument_key(key);
  buffer_ += "\"0x";
  append(value, 16);
  buffer_ += '"';
}

void TraceEvents::end() {
  buffer_ += in_arguments_ ? "}}" : "}";
  in_arguments_ = false;
}

void TraceEvents::argument_key(std::string_view key) {
  buffer_ += in_arguments_ ? "," : ",\"args\":{";
  in_arguments_ = true;
  append_quoted(key);
  buffer_ += ':';
}

void TraceEvents::append(std::uint64_t value, int base) {
  char digits[24];
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value, base);
  buffer_.append(digits, end);
}

void TraceEvents::append_quoted(std::string_view text) {
  constexpr char kHex[] = "0123456789abcdef";
  buffer_ += '"';
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      buffer_ += '\\';
      buffer_ += c;
    } else if (byte < 0x20) {
      buffer_ += "\\u00";
      buffer_ += kHex[byte >> 4];
      buffer_ += kHex[byte & 15];
    } else {
      buffer_ += c;
    }
  }
  buffer_ += '"';
}

void TraceEvents::flush() {
  out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
}

} // namespace celltrace::cell_emu
