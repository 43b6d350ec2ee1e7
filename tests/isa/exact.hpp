// Exact binary fractions, as wide as any sum of a product and a number of a floating-point format.
#pragma once

#include <array>
#include <cstdint>

namespace celltrace::test {

__extension__ using Wide = unsigned __int128;

/// A sign and a magnitude of 64 * Words bits, the lowest of which is worth 2^Lowest.
template <int Words, int Lowest> class Exact {
public:
  /// magnitude * 2^exponent; every bit of it must have its place.
  static Exact of(bool negative, Wide magnitude, int exponent) {
    Exact value;
    value.negative_ = negative;
    for (int i = 0; i < 128; ++i)
      if ((magnitude >> i & 1) != 0) value.set_bit(exponent + i);
    return value;
  }

  bool negative() const { return negative_; }
  bool is_zero() const { return exponent() == kNoBits; }

  /// Of the highest bit: floor(log2 |value|); kNoBits for zero.
  static constexpr int kNoBits = Lowest - 1;
  int exponent() const {
    for (int word = Words - 1; word >= 0; --word)
      for (int i = 63; words_[word] != 0 && i >= 0; --i)
        if ((words_[word] >> i & 1) != 0) return Lowest + 64 * word + i;
    return kNoBits;
  }

  /// |value| / 2^exponent without its fraction; below 2^64.
  std::uint64_t integer(int exponent) const {
    std::uint64_t result = 0;
    for (int i = 63; i >= 0; --i)
      result = result << 1 | static_cast<std::uint64_t>(bit(exponent + i));
    return result;
  }
  /// Whether a bit below 2^exponent is set.
  bool has_bits_below(int exponent) const {
    for (int word = 0; word < Words; ++word) {
      const int first = Lowest + 64 * word;
      if (first >= exponent) return false;
      if (first + 64 <= exponent) {
        if (words_[word] != 0) return true;
      } else {
        for (int i = first; i < exponent; ++i)
          if (bit(i)) return true;
      }
    }
    return false;
  }
  bool bit(int exponent) const {
    const int place = exponent - Lowest;
    return place >= 0 && place < 64 * Words && (words_[place / 64] >> (place % 64) & 1) != 0;
  }

  /// A sum of zero has the sign of the second.
  friend Exact operator+(const Exact& a, const Exact& b) {
    if (a.negative_ == b.negative_) return add_magnitudes(a, b);
    return magnitude_less(a, b) ? subtract_magnitudes(b, a) : subtract_magnitudes(a, b);
  }

private:
  void set_bit(int exponent) {
    const int place = exponent - Lowest;
    words_[place / 64] |= std::uint64_t{1} << (place % 64);
  }
  static bool magnitude_less(const Exact& a, const Exact& b) {
    for (int word = Words - 1; word >= 0; --word)
      if (a.words_[word] != b.words_[word]) return a.words_[word] < b.words_[word];
    return true; // equal: either may be the minuend
  }
  static Exact add_magnitudes(const Exact& a, const Exact& b) {
    Exact sum;
    sum.negative_ = b.negative_;
    Wide carry = 0;
    for (int word = 0; word < Words; ++word) {
      carry += Wide{a.words_[word]} + b.words_[word];
      sum.words_[word] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return sum;
  }
  static Exact subtract_magnitudes(const Exact& larger, const Exact& smaller) {
    Exact difference;
    difference.negative_ = larger.negative_;
    std::uint64_t borrow = 0;
    for (int word = 0; word < Words; ++word) {
      const Wide taken = Wide{smaller.words_[word]} + borrow;
      borrow = larger.words_[word] < taken ? 1 : 0;
      difference.words_[word] = static_cast<std::uint64_t>(larger.words_[word] - taken);
    }
    return difference;
  }

  bool negative_ = false;
  std::array<std::uint64_t, Words> words_{};
};

} // namespace celltrace::test
