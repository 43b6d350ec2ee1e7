// Random numbers that are the same on every host (splitmix64, Steele, Lea and Flood 2014).
#pragma once

#include <cstdint>

namespace celltrace::cell_emu {

class SeededRandom {
public:
  /// Makes a generator; `stream` tells apart generators with the same seed.
  constexpr SeededRandom(std::uint64_t seed, std::uint64_t stream)
      : state_(seed * 0xD1342543DE82EF95u + stream * 0x9E3779B97F4A7C15u + 0x2545F4914F6CDD1Du) {}

  constexpr std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  /// Returns a number in 0 .. bound - 1; 0 if bound is 0.
  constexpr std::uint64_t below(std::uint64_t bound) {
    return bound == 0 ? 0 : static_cast<std::uint64_t>(((next() >> 32) * bound) >> 32);
  }
  /// Returns true once in `n` times on average.
  constexpr bool once_in(std::uint64_t n) { return below(n) == 0; }
  /// Returns a number from 0 up to, but not including, 1.
  constexpr double fraction() { return static_cast<double>(next() >> 11) * 0x1p-53; }

private:
  std::uint64_t state_;
};

} // namespace celltrace::cell_emu
