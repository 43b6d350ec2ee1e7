// EarlyLoads tracks early bytes: bytes in registers that were loaded from the target of a get in flight. It
// finds the first use of an early byte.
//
// Only a use is a mistake, because code that reads ahead, as memcpy() does, loads quadwords and then drops
// them. Early bytes are used as addresses, as conditions and targets of branches, as words for channels, and
// by stores. Shuffles, rotates and selects move early bytes; in other operations each word of the result
// depends on the same word of each operand.
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

  /// Returns true if a register holds early bytes.
  bool any() const { return live_ != 0; }
  /// Notes that the present instruction has loaded its target register early.
  void loaded(std::uint8_t target, const Load& load);
  /// Tracks an instruction. While any() is true, call this for every instruction before it executes. Returns
  /// the load whose early bytes the instruction uses, or null.
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

  std::unique_ptr<std::array<Register, 128>> registers_; ///< null if there were no early bytes since forget()
  unsigned live_ = 0;
};

} // namespace celltrace::cell_emu
