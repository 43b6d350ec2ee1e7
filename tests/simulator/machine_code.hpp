// Machine code for the SPU written in tests, word by word, so that these need no assembler.
//
//   Code code;
//   code.add("il", {.rt = 3, .immediate = 5});
//   code.add("stop", {.immediate = 0x2000});
//   const SimulatedRun run = simulate(simulated(1), code.elf());
#pragma once

#include "backends/cell_emu/isa/instruction.hpp"
#include "simulator/elf_image.hpp"

#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace celltrace::test {

struct Fields {
  std::uint32_t rt = 0, ra = 0, rb = 0, rc = 0;
  std::int32_t immediate =
      0; ///< as it stands in the instruction: words for branches, quadwords for lqd and stqd
};

inline std::uint32_t encode(std::string_view mnemonic, const Fields& f) {
  using isa::Format;
  for (const isa::OpcodeInfo& info : isa::opcodes()) {
    if (info.mnemonic != mnemonic) continue;
    const std::uint32_t code = info.code;
    const auto immediate = static_cast<std::uint32_t>(f.immediate);
    if (mnemonic == "stop") return immediate & 0x3FFF;
    switch (info.format) {
    case Format::rr:
      return code << 21 | f.rb << 14 | f.ra << 7 | f.rt;
    case Format::rrr:
      return code << 28 | f.rt << 21 | f.rb << 14 | f.ra << 7 | f.rc;
    case Format::ri7:
      return code << 21 | (immediate & 0x7F) << 14 | f.ra << 7 | f.rt;
    case Format::ri8:
      return code << 22 | (immediate & 0xFF) << 14 | f.ra << 7 | f.rt;
    case Format::ri10:
      return code << 24 | (immediate & 0x3FF) << 14 | f.ra << 7 | f.rt;
    case Format::ri16:
      return code << 23 | (immediate & 0xFFFF) << 7 | f.rt;
    case Format::ri18:
      return code << 25 | (immediate & 0x3FFFF) << 7 | f.rt;
    }
  }
  throw std::logic_error("no instruction " + std::string(mnemonic));
}

/// A program that is loaded at local-store address 0 and starts there.
class Code {
public:
  std::uint32_t here() const { return static_cast<std::uint32_t>(4 * words_.size()); }
  Code& add(std::string_view mnemonic, const Fields& fields = {}) { return word(encode(mnemonic, fields)); }
  Code& word(std::uint32_t word) {
    words_.push_back(word);
    return *this;
  }
  Code& append(const Code& other) {
    words_.insert(words_.end(), other.words_.begin(), other.words_.end());
    return *this;
  }
  /// No-ops up to `address`.
  Code& fill_to(std::uint32_t address) {
    while (here() < address)
      add("lnop");
    return *this;
  }
  /// Writes `channel` from the low bits of an immediate, by register 99.
  Code& write_channel(std::uint32_t channel, std::int32_t value) {
    add("il", {.rt = 99, .immediate = value});
    return add("wrch", {.rt = 99, .ra = channel});
  }
  /// A DMA command of `size` bytes for main memory at argp, register 4.
  Code& dma(std::uint32_t opcode, std::int32_t lsa, std::int32_t size, std::int32_t tag) {
    write_channel(16, lsa);
    add("wrch", {.rt = 4, .ra = 17});
    add("rotqbyi", {.rt = 98, .ra = 4, .immediate = 4});
    add("wrch", {.rt = 98, .ra = 18});
    write_channel(19, size);
    write_channel(20, tag);
    return write_channel(21, static_cast<std::int32_t>(opcode));
  }
  Code& wait_for_tags(std::int32_t mask) {
    write_channel(22, mask);
    write_channel(23, 2);
    return add("rdch", {.rt = 97, .ra = 24});
  }
  Code& exit(std::int32_t code = 0) { return add("stop", {.immediate = 0x2000 | code}); }

  Bytes elf() const {
    ElfImage image;
    image.entry = 0;
    Bytes bytes(4 * words_.size());
    for (std::size_t i = 0; i < words_.size(); ++i)
      put<std::uint32_t>(bytes, 4 * i, words_[i]);
    const auto size = static_cast<std::uint32_t>(bytes.size());
    image.add_segment(0, std::move(bytes), size, 7);
    return image.build();
  }

private:
  std::vector<std::uint32_t> words_;
};

} // namespace celltrace::test
