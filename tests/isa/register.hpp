// A register of the reference: 16 bytes in the order of local store.
#pragma once

#include <array>
#include <cstdint>

namespace celltrace::test {

struct Register {
  std::array<std::uint8_t, 16> bytes{};

  /// The index-th part of `size` bytes, counted from the most significant.
  std::uint64_t part(unsigned size, unsigned index) const {
    std::uint64_t value = 0;
    for (unsigned i = 0; i < size; ++i)
      value = value << 8 | bytes[index * size + i];
    return value;
  }
  void set_part(unsigned size, unsigned index, std::uint64_t value) {
    for (unsigned i = size; i-- > 0; value >>= 8)
      bytes[index * size + i] = static_cast<std::uint8_t>(value);
  }
  std::uint32_t word(unsigned index) const { return static_cast<std::uint32_t>(part(4, index)); }
  std::uint32_t preferred() const { return word(0); }

  /// 0 is the most significant of the 128.
  bool bit(unsigned index) const { return (bytes[index / 8] >> (7 - index % 8) & 1) != 0; }
  void set_bit(unsigned index, bool value) {
    const auto mask = static_cast<std::uint8_t>(0x80 >> index % 8);
    bytes[index / 8] = static_cast<std::uint8_t>(value ? bytes[index / 8] | mask : bytes[index / 8] & ~mask);
  }

  /// The value in the preferred slot, zeros elsewhere.
  static Register of_preferred(std::uint32_t value) {
    Register r;
    r.set_part(4, 0, value);
    return r;
  }

  friend bool operator==(const Register&, const Register&) = default;
};

/// `value` of `bits` bits, as a number with sign.
constexpr std::int64_t with_sign(std::uint64_t value, unsigned bits) {
  const std::uint64_t sign = std::uint64_t{1} << (bits - 1);
  value &= sign | (sign - 1);
  return static_cast<std::int64_t>((value ^ sign) - sign);
}

/// f(index) for each part of `size` bytes; only as many bits of it count.
template <class F> Register for_parts(unsigned size, F f) {
  Register result;
  for (unsigned i = 0; i < 16 / size; ++i)
    result.set_part(size, i, static_cast<std::uint64_t>(f(i)));
  return result;
}

} // namespace celltrace::test
