// A program of machine code, and the source places of its addresses.
#pragma once

#include "backends/cell_emu/simulator/code_places.hpp"
#include "backends/cell_emu/simulator/spu_elf.hpp"
#include "celltrace/spe/call_site.hpp"

#include <cstdint>
#include <span>

namespace celltrace::cell_emu {

/// The way in which a program takes the argument of Machine::start().
enum class Convention : std::uint8_t {
  kernel,      ///< as backends/spu/main.cpp: the second argument is the address of a ControlBlock
  stand_alone, ///< main(speid, argp, envp), whose second argument it is
};

/// Thread safety: all members are const.
class SimulatedProgram {
public:
  /// Throws InputError if `image` is no executable for the SPU.
  SimulatedProgram(std::span<const std::uint8_t> image, Convention convention);

  const SpuElf& elf() const { return elf_; }
  const CodePlaces& places() const { return places_; }
  Convention convention() const { return convention_; }
  /// Returns true if it keeps a stack as the ABI demands: register 1 holds the stack pointer and the space
  /// that is left.
  bool has_abi_stack() const { return has_abi_stack_; }
  /// Returns a place for diagnostics: the innermost line outside of the compiler's own headers. Its strings
  /// stay valid for as long as the process runs.
  CallSite site(std::uint32_t address) const;

private:
  SpuElf elf_;
  CodePlaces places_;
  Convention convention_;
  bool has_abi_stack_;
};

} // namespace celltrace::cell_emu
