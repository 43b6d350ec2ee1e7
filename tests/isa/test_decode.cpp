// The table of opcodes, and what decoding says of an instruction's operands.
#include "backends/cell_emu/isa/instruction.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace celltrace::isa {
namespace {

constexpr std::size_t kLocalStoreBytes = kLocalStoreLimit + 1;

const OpcodeInfo& info_of(const std::string& mnemonic) {
  const auto all = opcodes();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](auto& info) { return info.mnemonic == mnemonic; });
  REQUIRE(found != all.end());
  return *found;
}
Instruction decoded(const std::string& mnemonic, std::uint32_t operands) {
  const OpcodeInfo& info = info_of(mnemonic);
  const unsigned bits[] = {11, 4, 11, 10, 8, 9, 7};
  return decode(static_cast<std::uint32_t>(info.code) << (32 - bits[static_cast<int>(info.format)]) |
                operands);
}

/// Answers by what it is asked; writes down what it is told.
class Recorder : public Environment {
public:
  std::uint32_t read_channel(unsigned channel) override { return channel * 0x01010101; }
  void write_channel(unsigned channel, std::uint32_t value) override { told = {channel, value}; }
  std::uint32_t channel_count(unsigned channel) override { return channel + 1; }
  void stop(std::uint32_t code) override { told = {1, code}; }
  void halt() override { told = {2}; }
  void invalid_instruction(std::uint32_t word) override { told = {3, word}; }
  bool has_event() override { return true; }
  void enable_interrupts(bool enabled) override { told = {4, enabled}; }
  std::uint32_t srr0() override { return 0x1234; }
  void watched_load(std::uint32_t lsa) override { told = {5, lsa}; }
  void watched_store(std::uint32_t lsa, const Quadword&) override { told = {6, lsa}; }

  std::vector<std::uint32_t> told;
};

struct Spu {
  Recorder environment;
  std::vector<std::uint8_t> local_store = std::vector<std::uint8_t>(kLocalStoreBytes);
  std::vector<std::uint8_t> watch = std::vector<std::uint8_t>(kLocalStoreBytes / 16);
  State state;

  Spu() {
    for (std::size_t i = 0; i < local_store.size(); ++i)
      local_store[i] = static_cast<std::uint8_t>(i * 7 + i / 256);
    state.local_store = local_store.data();
    state.watch = watch.data();
    state.environment = &environment;
    state.pc = 0x1000;
    state.next = 0x1004;
  }
};

Quadword random_quadword(std::mt19937& random) {
  Quadword q;
  for (unsigned slot = 0; slot < 4; ++slot)
    q.set<std::uint32_t>(slot, static_cast<std::uint32_t>(random()));
  return q;
}

TEST_CASE("opcodes have different codes and names") {
  std::set<std::string> names;
  for (const OpcodeInfo& info : opcodes()) {
    CAPTURE(info.mnemonic);
    CHECK(names.insert(info.mnemonic).second);
    CHECK(&opcodes()[static_cast<std::size_t>(info.opcode)] == &info);
    CHECK(decoded(info.mnemonic, 0).opcode == info.opcode);
    CHECK(decoded(info.mnemonic, 0).execute == info.execute);
  }
  CHECK(names.size() == 199);
}

TEST_CASE("immediates are decoded for execution") {
  CHECK(decoded("ai", 0x3F0u << 14).immediate == -16);
  CHECK(decoded("lqd", 0x3FFu << 14).immediate == -16);
  CHECK(decoded("br", 0xFFFFu << 7).immediate == -4);
  CHECK(decoded("lqa", 0xFFFFu << 7).immediate == 0x3FFFC);
  CHECK(decoded("il", 0x8000u << 7).immediate == -0x8000);
  CHECK(decoded("ilhu", 0x8000u << 7).immediate == 0x8000);
  CHECK(decoded("ila", 0x3FFFFu << 7).immediate == 0x3FFFF);
  CHECK(decoded("cflts", 173u << 14).immediate == 0);
  CHECK(decoded("csflt", 155u << 14).immediate == 0);
  CHECK(decoded("rotqbyi", 0x7Fu << 14).immediate == -1);
  CHECK(decoded("stop", 0x2101).immediate == 0x2101);
}

TEST_CASE("hints name the branch that they are for") {
  // hbrr +0x1FC, -4: the offset of the branch is in two pieces
  const Instruction hbrr = decoded("hbrr", 0u << 23 | 0xFFFFu << 7 | 0x7F);
  CHECK(hinted_branch(hbrr, 0x100) == 0x100 + 0x7F * 4);
  CHECK(hbrr.immediate == -4);
  CHECK(hinted_branch(decoded("hbra", 3u << 23 | 0x7F), 0x100) == 0xFC);
  CHECK(hinted_branch(decoded("hbr", 2u << 14), 0x800) == 0x800 - 1024);
  CHECK(decoded("hbr", 5u << 7 | 1).source[0] == 5);
}

TEST_CASE("a word that is no instruction is reported when it is executed") {
  const std::uint32_t word = 0x00800000;
  CHECK(find_opcode(word) == nullptr);
  CHECK(disassemble(word, 0) == ".long 0x800000");
  const auto spu = std::make_unique<Spu>();
  const Instruction instruction = decode(word);
  CHECK(instruction.target == kNoRegister);
  instruction.execute(spu->state, instruction);
  CHECK(spu->environment.told == std::vector<std::uint32_t>{3, word});
}

TEST_CASE("instructions are disassembled as the assembler reads them") {
  CHECK(disassemble(decoded("ai", 0x3F0u << 14 | 4u << 7 | 3).word, 0) == "ai\t$3,$4,-16");
  CHECK(disassemble(decoded("brsl", 0x10u << 7).word, 0x160) == "brsl\t$0,0x1a0\t# 1a0");
  CHECK(disassemble(decoded("br", 0).word, 0x160) == "br\t0");
  CHECK(disassemble(decoded("bi", 0x20u << 14).word, 0) == "bid\t$0");
  CHECK(disassemble(decoded("sync", 0x40u << 14).word, 0) == "syncc");
  CHECK(disassemble(decoded("stqd", 2u << 14 | 1u << 7).word, 0) == "stqd\t$0,32($1)\t# 20");
  CHECK(disassemble(decoded("wrch", 21u << 7 | 9).word, 0) == "wrch\t$ch21,$9");
}

// The pipeline's model knows of dependencies by this alone.
TEST_CASE("operands are the registers that execution reads and writes") {
  std::mt19937 random(7);
  const auto spu = std::make_unique<Spu>(), other = std::make_unique<Spu>();
  for (const OpcodeInfo& info : opcodes())
    for (unsigned round = 0; round < 8; ++round) {
      CAPTURE(info.mnemonic, round);
      const Instruction i =
          decoded(info.mnemonic, 5u << 14 | 4u << 7 | (info.format == Format::rrr ? 3u << 21 | 6u : 3u));
      const std::set<unsigned> sources(i.source, i.source + 3);
      spu->environment.told.clear();
      other->environment.told.clear();
      for (unsigned r = 0; r < 128; ++r) {
        spu->state.gpr[r] = random_quadword(random);
        other->state.gpr[r] = sources.count(r) != 0 ? spu->state.gpr[r] : random_quadword(random);
      }
      const State before = spu->state, other_before = other->state;
      i.execute(spu->state, i);
      i.execute(other->state, i);
      for (unsigned r = 0; r < 128; ++r)
        if (r == i.target)
          CHECK(spu->state.gpr[r] == other->state.gpr[r]);
        else {
          CHECK(spu->state.gpr[r] == before.gpr[r]);
          CHECK(other->state.gpr[r] == other_before.gpr[r]);
        }
      CHECK(spu->state.next == other->state.next);
      CHECK(spu->environment.told == other->environment.told);
      CHECK(spu->local_store == other->local_store);
    }
}

} // namespace
} // namespace celltrace::isa
