// Tracks bytes in registers that were loaded from the target of a get in flight, up to the first use of one.
//
// Code that reads ahead, as memcpy() does, loads quadwords that it then drops: only a use is a mistake. Uses
// are addresses, conditions and targets of branches, words for channels, and stores. Shuffles, rotates and
// selects pass on certain bytes; for other operations every word of the result depends on the same
// words of the operands.
#pragma once

#include "backends/cell_emu/isa/instruction.hpp"
#include "backends/cell_emu/mfc.hpp"

#include <array>
#include <cstdint>
#include <memory>

namespace celltrace::cell_emu {

/// The early bytes of one SPU. Thread safety: none.
class EarlyLoads {
public:
  struct Load {
    std::uint32_t lsa = 0;
    CallSite site; ///< place of the load
    Mfc::FlightInfo flight;
  };

  /// Returns whether a register holds such bytes.
  bool any() const { return live_ != 0; }
  /// Notes that the present instruction has loaded its target register early.
  void loaded(std::uint8_t target, const Load& load);
  /// Tracks an instruction; call it for every one before it executes, while any() is true. Returns the load
  /// that the instruction uses too early, or null.
  const Load* use(const isa::State& state, const isa::Instruction& instruction);
  void forget() { registers_.reset(), live_ = 0; }

private:
  struct Register {
    isa::Quadword early = {}; ///< 0xFF for each early byte
    bool live = false;
    Load load;
  };

  void set(std::uint8_t target, const isa::Quadword& early, const Load& load);
  void clear(std::uint8_t target);
  isa::Quadword passed_on(const isa::State& state, const isa::Instruction& instruction) const;
  isa::Quadword moved(const isa::State& state, const isa::Instruction& instruction) const;
  const isa::Quadword& early(std::uint8_t number) const { return (*registers_)[number].early; }

  std::unique_ptr<std::array<Register, 128>> registers_; ///< only while there are early bytes
  unsigned live_ = 0;
};

} // namespace celltrace::cell_emu
