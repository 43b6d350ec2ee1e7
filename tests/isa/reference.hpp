// The SPU, instruction by instruction, as the SPU Instruction Set Architecture 1.2 states it and in the
// plainest form: what the interpreter is held against. Slow.
//
// Of the FPSCR's exceptions it models those of arithmetic, of conversions but to integers, and divisions by
// zero of the estimates; not what compares, fi and conversions to integers may raise.
#pragma once

#include "isa/register.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace celltrace::test {

constexpr std::uint32_t kLocalStoreSize = 0x40000;

/// What the world answers an instruction.
struct Answers {
  std::uint32_t channel_value = 0;
  std::uint32_t channel_count = 0;
  std::uint32_t srr0 = 0;
  bool event = false;
};

/// What an instruction asks of the world or does to it.
struct Effect {
  enum Kind { read_channel, write_channel, count_channel, stop, halt, invalid, interrupts } kind;
  std::uint32_t number = 0; ///< channel, stop code, instruction word
  std::uint32_t value = 0;  ///< written to the channel; interrupts on or off

  friend bool operator==(const Effect&, const Effect&) = default;
};

/// Bits of the four words of the FPSCR that mean something.
constexpr std::uint32_t kDefinedFpscr[4] = {0xF07, 0x3F07, 0x3F07, 0xF07};

class Reference {
public:
  Register gpr[128];
  Register fpscr;
  std::uint32_t pc = 0;   ///< of the instruction
  std::uint32_t next = 0; ///< of the one after it
  std::vector<std::uint8_t> local_store = std::vector<std::uint8_t>(kLocalStoreSize);
  Answers answers;

  /// Of the last instruction; in its order.
  std::vector<Effect> effects;
  std::optional<std::uint32_t> loaded, stored; ///< addresses of quadwords

  void execute(std::uint32_t word);

private:
  // By the width of the opcode; false: it is none of that width.
  bool execute_rrr(std::uint32_t word);
  bool execute_ri18(std::uint32_t word);
  bool execute_ri10(std::uint32_t word);
  bool execute_ri16(std::uint32_t word);
  bool execute_ri8(std::uint32_t word);
  bool execute_11_bits(std::uint32_t word);
  // Parts of the last.
  bool execute_integer(std::uint32_t word);
  bool execute_shift(std::uint32_t word);
  bool execute_shuffle(std::uint32_t word);
  bool execute_float(std::uint32_t word);
  bool execute_double(std::uint32_t word);
  bool execute_control(std::uint32_t word);

  Register load(std::uint32_t address);
  void store(std::uint32_t address, const Register& value);
  void branch(std::uint32_t address);
  /// With the D and E bits of the word.
  void branch_indirect(std::uint32_t word, std::uint32_t address);
  Register link() const;
  void halt_if(bool condition);
  /// f(slot, exceptions) for each of the four; the exceptions go to the FPSCR.
  template <class F> Register compute_singles(F f) {
    return for_parts(4, [&](unsigned slot) {
      std::uint32_t exceptions = 0;
      const std::uint32_t result = f(slot, exceptions);
      fpscr.set_part(4, slot, fpscr.word(slot) | exceptions);
      return result;
    });
  }
};

} // namespace celltrace::test
