// Access to a call's arguments and results in local store, and checked access to the data that arguments
// point to.
//
// Arguments are padded to 16 bytes each. The result replaces the first argument: the value is in word 0 (in
// words 0 and 1 if it has 64 bits), errno in word 3.
#pragma once

#include "backends/cell_emu/simulator/big_endian.hpp"
#include "backends/cell_emu/simulator/ppe/spu_errno.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace celltrace::cell_emu {

/// Local store, which a program's pointers refer to. As on the hardware, bits of an address above the 18th
/// are ignored. A range that crosses the end of local store is refused with EFAULT.
class LocalStoreView {
public:
  static constexpr std::uint32_t kBytes = 256 * 1024;

  explicit LocalStoreView(std::uint8_t* local_store) : bytes_(local_store) {}

  static std::uint32_t wrap(std::uint32_t address) { return address & (kBytes - 1); }

  std::span<std::uint8_t> range(std::uint32_t address, std::uint64_t bytes) const {
    const std::uint32_t start = wrap(address);
    if (bytes > kBytes - start) throw CallFailed{SpuErrno::fault};
    return {bytes_ + start, static_cast<std::size_t>(bytes)};
  }
  /// Returns a range, cut at the end of local store.
  std::span<std::uint8_t> range_up_to(std::uint32_t address, std::uint64_t bytes) const {
    const std::uint32_t start = wrap(address);
    return {bytes_ + start, static_cast<std::size_t>(std::min<std::uint64_t>(bytes, kBytes - start))};
  }

  /// Returns the string up to its terminating zero, which must be in local store.
  std::string_view string(std::uint32_t address) const { return string_up_to(address, kBytes + 1); }
  /// As string(), but at most `bytes` characters: if there are as many, no terminating zero is needed.
  std::string_view string_up_to(std::uint32_t address, std::uint64_t bytes) const {
    const auto all = range_up_to(address, bytes);
    const auto* start = reinterpret_cast<const char*>(all.data());
    const void* end = all.empty() ? nullptr : std::memchr(start, 0, all.size());
    if (end != nullptr) return {start, static_cast<std::size_t>(static_cast<const char*>(end) - start)};
    if (all.size() < bytes) throw CallFailed{SpuErrno::fault};
    return {start, all.size()};
  }

  template <class Integer> Integer load(std::uint32_t address) const {
    return load_big_endian<Integer>(range(address, sizeof(Integer)).data());
  }
  template <class Integer> void store(std::uint32_t address, Integer value) const {
    store_big_endian<Integer>(range(address, sizeof(Integer)).data(), value);
  }
  void store_bytes(std::uint32_t address, std::string_view bytes) const {
    std::ranges::copy(bytes, range(address, bytes.size()).begin());
  }

private:
  std::uint8_t* bytes_;
};

/// A va_list: the address of the next argument that was passed in a register, and the caller's stack frame,
/// which has further arguments behind its first 32 bytes.
class VariableArguments {
public:
  VariableArguments(const LocalStoreView& local_store, std::uint32_t next, std::uint32_t caller_frame)
      : local_store_(local_store), next_(next), caller_frame_(caller_frame) {}

  std::uint32_t word() { return local_store_.load<std::uint32_t>(advance()); }
  std::uint64_t doubleword() { return local_store_.load<std::uint64_t>(advance()); }
  double floating() { return std::bit_cast<double>(doubleword()); }

private:
  std::uint32_t advance() {
    constexpr std::uint32_t kSlot = 16, kFrameHeader = 32;
    std::uint32_t at = LocalStoreView::wrap(next_) & ~(kSlot - 1);
    if (at == (LocalStoreView::wrap(caller_frame_) & ~(kSlot - 1))) at += kFrameHeader;
    next_ = at + kSlot;
    return at;
  }

  LocalStoreView local_store_;
  std::uint32_t next_, caller_frame_;
};

/// The arguments of one call, by number from 0, in a block of local store. A block that crosses the end of
/// local store continues at address 0.
class CallArguments {
public:
  CallArguments(const LocalStoreView& local_store, std::uint32_t block)
      : local_store_(local_store), block_(block & ~3u) {}

  const LocalStoreView& local_store() const { return local_store_; }

  std::uint32_t word(unsigned argument) const { return load(argument, 0); }
  std::int32_t number(unsigned argument) const { return static_cast<std::int32_t>(word(argument)); }
  std::uint64_t doubleword(unsigned argument) const {
    return std::uint64_t{load(argument, 0)} << 32 | load(argument, 1);
  }
  std::string_view string(unsigned argument) const { return local_store_.string(word(argument)); }
  /// Returns a va_list that was passed by value, in this slot and the next one.
  VariableArguments variable(unsigned argument) const {
    return {local_store_, word(argument), word(argument + 1)};
  }

  void set_result(std::uint32_t word0, std::uint32_t word1, SpuErrno error) const {
    const std::uint32_t words[4] = {word0, word1, 0, static_cast<std::uint32_t>(error)};
    for (unsigned i = 0; i < 4; ++i)
      local_store_.store(place(0, i), words[i]);
  }

private:
  std::uint32_t place(unsigned argument, unsigned word) const { return block_ + argument * 16 + word * 4; }
  std::uint32_t load(unsigned argument, unsigned word) const {
    return local_store_.load<std::uint32_t>(place(argument, word));
  }

  LocalStoreView local_store_;
  std::uint32_t block_;
};

/// The result of a successful call.
class CallResult {
public:
  static CallResult number(std::int64_t value) { return {static_cast<std::uint32_t>(value), 0}; }
  static CallResult address(std::uint32_t lsa) { return {lsa, 0}; }
  static CallResult wide(std::uint64_t value) {
    return {static_cast<std::uint32_t>(value >> 32), static_cast<std::uint32_t>(value)};
  }

  std::uint32_t word0 = 0, word1 = 0;

private:
  CallResult(std::uint32_t first, std::uint32_t second) : word0(first), word1(second) {}
};

} // namespace celltrace::cell_emu
