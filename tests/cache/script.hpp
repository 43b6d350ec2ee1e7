// Writing scripts for software caches, on the host.
#pragma once

#include "memory.hpp"
#include "script_records.hpp"

#include "celltrace/spe/simd.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace celltrace::test {

/// Where in its word the byte at an offset lies, in bits.
constexpr std::uint32_t shift_of_byte(std::uint32_t offset, std::endian order) {
  return 8 * (order == std::endian::little ? offset & 3 : 3 - (offset & 3));
}

/// The entries of a script, and main memory as it is after each: as the script's own SPE has to see it.
class CacheScript {
public:
  /// `order`: of the machine's SPUs, which decides what bytes make of the words that they are in.
  CacheScript(const Memory& memory, std::endian order) : memory_(memory), order_(order) {}

  const std::vector<CacheEntry>& entries() const { return entries_; }
  std::uint32_t bytes() const { return memory_.bytes(); }
  std::uint32_t word(std::uint32_t offset) const { return memory_.word(offset); }

  void add(CacheStep step, std::uint32_t offset = 0, std::uint32_t value = 0, std::uint32_t kind = 0) {
    entries_.push_back({step, kind, offset, value});
  }
  void read(std::uint32_t offset, std::uint32_t kind = 0) {
    add(CacheStep::read, offset, word(offset), kind);
  }
  void read_byte(std::uint32_t offset, std::uint32_t kind = 0) {
    add(CacheStep::read_byte, offset, word(offset & ~3u) >> shift_of(offset) & 0xFF, kind);
  }
  void read_block(std::uint32_t offset, std::uint32_t kind = 0) {
    add(CacheStep::read_block, offset, sum_at(offset, 4), kind);
  }
  void read_line(std::uint32_t offset, std::uint32_t kind = 0) {
    add(CacheStep::read_line, offset, sum_at(offset, kLineBytes / 4), kind);
  }
  void get(std::uint32_t offset, std::uint32_t kind = 0) { add(CacheStep::get, offset, word(offset), kind); }
  /// At most kMaxItems.
  void fetch(const std::vector<std::uint32_t>& offsets) {
    for (const std::uint32_t offset : offsets)
      add(CacheStep::item, offset);
    add(CacheStep::fetch);
  }
  void lanes(const std::array<std::uint32_t, kSimdLanes>& offsets, std::uint32_t wanted,
             std::uint32_t kind = 0) {
    for (const std::uint32_t offset : offsets)
      add(CacheStep::item, offset, word(offset));
    add(CacheStep::lanes, 0, wanted, kind);
  }
  /// The first `taken` words of a run of `count`.
  void run(std::uint32_t offset, std::uint32_t count, std::uint32_t taken, std::uint32_t kind = 0) {
    add(CacheStep::run, offset, count, kind);
    for (std::uint32_t i = 0; i < taken; ++i)
      add(CacheStep::next, offset + 4 * i, word(offset + 4 * i), kind);
  }
  /// Other words in main memory, once nothing is under way there.
  void change(std::uint32_t offset, std::uint32_t bytes) {
    add(CacheStep::settle);
    for (std::uint32_t at = offset; at < offset + bytes / 4 * 4; at += 4)
      add(CacheStep::change, at, memory_.word(at) += 77);
  }
  void write_byte(std::uint32_t offset, std::uint32_t value, std::uint32_t kind = 0) {
    add(CacheStep::write_byte, offset, value & 0xFF, kind);
    std::uint32_t& word = memory_.word(offset & ~3u);
    word = (word & ~(0xFFu << shift_of(offset))) | (value & 0xFF) << shift_of(offset);
  }
  void write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t kind = 0) {
    add(CacheStep::write_word, offset, value, kind);
    memory_.word(offset) = value;
  }
  void write_block(std::uint32_t offset, std::uint32_t value, std::uint32_t kind = 0) {
    write_words(CacheStep::write_block, offset, value, kind, sizeof(CacheBlock));
  }
  void write_line(std::uint32_t offset, std::uint32_t value, std::uint32_t kind = 0) {
    write_words(CacheStep::write_line, offset, value, kind, sizeof(CacheLine));
  }

private:
  std::uint32_t shift_of(std::uint32_t offset) const { return shift_of_byte(offset, order_); }
  std::uint32_t sum_at(std::uint32_t offset, std::uint32_t words) const {
    return sum_of_words(&memory_.word(offset), words);
  }
  void write_words(CacheStep step, std::uint32_t offset, std::uint32_t value, std::uint32_t kind,
                   std::uint32_t bytes) {
    add(step, offset, value, kind);
    for (std::uint32_t at = 0; at < bytes; at += 4)
      memory_.word(offset + at) = value++;
  }

  Memory memory_;
  std::endian order_;
  std::vector<CacheEntry> entries_;
};

} // namespace celltrace::test
