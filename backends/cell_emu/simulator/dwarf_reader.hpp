// DwarfReader reads debugging information that may be malformed: reads beyond the end throw and access no
// memory.
#pragma once

#include "backends/cell_emu/simulator/big_endian.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

namespace celltrace::cell_emu {

/// Exception of a DwarfReader at the end of its bytes; each source file that uses a DwarfReader catches it.
struct MalformedDwarf {};

/// Reads from the front of a range of bytes.
class DwarfReader {
public:
  DwarfReader() = default;
  explicit DwarfReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  bool done() const { return rest_.empty(); }
  std::size_t left() const { return rest_.size(); } ///< bytes

  std::span<const std::uint8_t> take(std::size_t count) {
    if (count > rest_.size()) throw MalformedDwarf();
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  template <class Integer> Integer integer() {
    return load_big_endian<Integer>(take(sizeof(Integer)).data());
  }

  /// Read an LEB128 number; bits above the 64th are dropped.
  std::uint64_t unsigned_leb() { return leb().first; }
  std::int64_t signed_leb() {
    auto [value, bits] = leb();
    if (bits < 64 && (value >> (bits - 1) & 1) != 0) value |= ~std::uint64_t{0} << bits;
    return static_cast<std::int64_t>(value);
  }

  std::string_view string() {
    const auto end = std::ranges::find(rest_, 0);
    if (end == rest_.end()) throw MalformedDwarf();
    const auto bytes = take(static_cast<std::size_t>(end - rest_.begin()) + 1);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size() - 1};
  }

private:
  std::pair<std::uint64_t, unsigned> leb() {
    std::uint64_t value = 0;
    unsigned bits = 0;
    std::uint8_t byte = 0;
    do {
      byte = integer<std::uint8_t>();
      if (bits < 64) {
        value |= std::uint64_t{byte & 0x7Fu} << bits;
        bits += 7;
      }
    } while ((byte & 0x80) != 0);
    return {value, bits};
  }

  std::span<const std::uint8_t> rest_;
};

} // namespace celltrace::cell_emu
