#include "backends/cell_emu/local_store_watch.hpp"

#include "backends/cell_emu/access_checkers.hpp"

#include <cstring>

namespace celltrace::cell_emu {
namespace {

// Fill patterns: pairs of words, in the byte order of host code.
constexpr std::uint64_t kPoison = 0x7FB0DEAD'7FB0DEADu;
constexpr std::uint32_t kInFlightWord = 0x7FB5DEADu;
constexpr std::uint32_t kQuiet = 0x00400000u;
constexpr std::uint64_t kInFlight = std::uint64_t{kInFlightWord} << 32 | kInFlightWord;

void fill(std::uint8_t* at, std::uint32_t bytes, std::uint64_t pattern) {
  for (; bytes >= 8; at += 8, bytes -= 8)
    std::memcpy(at, &pattern, sizeof pattern);
  std::memcpy(at, &pattern, bytes);
}

bool is_filled(const std::uint8_t* at, std::uint32_t bytes, std::uint64_t pattern) {
  std::uint64_t difference = 0;
  for (; bytes >= 8; at += 8, bytes -= 8) {
    std::uint64_t word;
    std::memcpy(&word, at, sizeof word);
    difference |= word ^ pattern;
  }
  std::uint64_t rest = pattern;
  std::memcpy(&rest, at, bytes);
  difference |= rest ^ pattern;
  settle(&difference, sizeof difference);
  return difference == 0;
}

} // namespace

std::uint64_t checksum(const std::uint8_t* at, std::uint32_t bytes) {
  // Four independent sums, because each step of a sum waits for the step before.
  std::uint64_t sums[4] = {bytes, 1, 2, 3};
  const auto take = [](std::uint64_t& sum, const std::uint8_t* from) {
    std::uint64_t word;
    std::memcpy(&word, from, sizeof word);
    sum = (sum ^ word) * 0x9E3779B97F4A7C15u;
    sum ^= sum >> 29;
  };
  for (; bytes >= 32; at += 32, bytes -= 32)
    for (unsigned i = 0; i < 4; ++i)
      take(sums[i], at + 8 * i);
  for (; bytes >= 8; at += 8, bytes -= 8)
    take(sums[0], at);
  for (; bytes != 0; ++at, --bytes)
    sums[1] = (sums[1] ^ *at) * 0x100000001B3u;
  std::uint64_t sum = 0;
  for (const std::uint64_t each : sums)
    sum = (sum ^ each) * 0xD1342543DE82EF95u;
  settle(&sum, sizeof sum);
  return sum;
}

void fill_with_poison(std::uint8_t* at, std::uint32_t bytes) {
  fill(at, bytes, kPoison);
}
bool is_poison(const std::uint8_t* at, std::uint32_t bytes) {
  return is_filled(at, bytes, kPoison);
}

void fill_as_in_flight(std::uint8_t* at, std::uint32_t bytes) {
  fill(at, bytes, kInFlight);
}
bool is_as_in_flight(const std::uint8_t* at, std::uint32_t bytes) {
  return is_filled(at, bytes, kInFlight);
}

std::optional<std::uint32_t> find_in_flight_word(const std::uint8_t* at, std::uint32_t bytes) {
  const auto is_one = [at](std::uint32_t offset) {
    std::uint32_t word;
    std::memcpy(&word, at + offset, sizeof word);
    return (word & ~kQuiet) == kInFlightWord;
  };
  std::uint32_t found = 0;
  for (std::uint32_t offset = 0; offset + 4 <= bytes; offset += 4)
    found |= is_one(offset);
  settle(&found, sizeof found);
  if (!found) return std::nullopt;
  const UncheckedScope unset_bytes_count;
  std::uint32_t offset = 0;
  while (!is_one(offset))
    offset += 4;
  return offset;
}

} // namespace celltrace::cell_emu
