// Bytes in registers that were loaded from the target of a get in flight, up to the first use of one.
//
// Code that reads ahead, as memcpy() does, loads quadwords that it then drops: only a use is a mistake. Uses
// are addresses, conditions and targets of branches, words for channels, and stores. Shuffles, rotates and
// selects say which bytes they pass on; of other operations every word of the result depends on the same
// words of the operands.
#pragma once

#include "backends/cell_emu/isa/instruction.hpp"
#include "backends/cell_emu/mfc.hpp"

#include <array>
#include <cstdint>
#include <memory>

namespace celltrace::cell_emu {

/// Of one SPU. Thread safety: none.
class EarlyLoads {
public:
  struct Load {
    std::uint32_t lsa = 0;
    CallSite site; ///< of the load
    Mfc::FlightInfo flight;
  };

  /// A register holds such bytes.
  bool any() const { return live_ != 0; }
  /// The instruction that executes has loaded its target register early.
  void loaded(std::uint8_t target, const Load& load);
  /// Call it for every instruction, before it executes, while there are any. Returns what the instruction
  /// uses too early, or null.
  const Load* use(const isa::State& state, const isa::Instruction& instruction);
  void forget() { registers_.reset(), live_ = 0; }

private:
  struct Register {
    isa::Quadword early = {}; ///< 0xFF where the byte is
    bool live = false;
    Load load;
  };

  void set(std::uint8_t target, const isa::Quadword& early, const Load& load);
  void clear(std::uint8_t target);
  isa::Quadword passed_on(const isa::State& state, const isa::Instruction& instruction) const;
  isa::Quadword moved(const isa::State& state, const isa::Instruction& instruction) const;
  const isa::Quadword& early(std::uint8_t number) const { return (*registers_)[number].early; }

  std::unique_ptr<std::array<Register, 128>> registers_; ///< only while there are any
  unsigned live_ = 0;
};

} // namespace celltrace::cell_emu
