#include "backends/cell_emu/local_store_watch.hpp"

#include <cstring>

#if defined(__SANITIZE_ADDRESS__)
#define CELLTRACE_HAS_ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CELLTRACE_HAS_ASAN 1
#endif
#endif
#ifdef CELLTRACE_HAS_ASAN
#include <sanitizer/asan_interface.h>
#endif

namespace celltrace::cell_emu {
namespace {

// Two words 0x7FB0DEAD, a signalling NaN, as programs of this machine read them.
constexpr std::uint64_t kPoison = 0x7FB0DEAD'7FB0DEADu;

} // namespace

std::uint64_t checksum(const std::uint8_t* at, std::uint32_t bytes) {
  // Four sums side by side, as each step has to wait for the one before.
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
  return sum;
}

void fill_with_poison(std::uint8_t* at, std::uint32_t bytes) {
  for (; bytes >= 8; at += 8, bytes -= 8)
    std::memcpy(at, &kPoison, sizeof kPoison);
  std::memcpy(at, &kPoison, bytes);
}

bool is_poison(const std::uint8_t* at, std::uint32_t bytes) {
  std::uint64_t difference = 0;
  for (; bytes >= 8; at += 8, bytes -= 8) {
    std::uint64_t word;
    std::memcpy(&word, at, sizeof word);
    difference |= word ^ kPoison;
  }
  return difference == 0 && std::memcmp(at, &kPoison, bytes) == 0;
}

#ifdef CELLTRACE_HAS_ASAN
void forbid_access(const std::uint8_t* at, std::uint32_t bytes) {
  __asan_poison_memory_region(at, bytes);
}
void permit_access(const std::uint8_t* at, std::size_t bytes) {
  __asan_unpoison_memory_region(at, bytes);
}
bool may_access(const std::uint8_t* at, std::uint32_t bytes) {
  return __asan_region_is_poisoned(const_cast<std::uint8_t*>(at), bytes) == nullptr;
}
#else
void forbid_access(const std::uint8_t*, std::uint32_t) {
}
void permit_access(const std::uint8_t*, std::size_t) {
}
bool may_access(const std::uint8_t*, std::uint32_t) {
  return true;
}
#endif

} // namespace celltrace::cell_emu
