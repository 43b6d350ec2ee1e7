// SimulatedProgram: a program of machine code, with the source places of its addresses.
#pragma once

#include "backends/cell_emu/simulator/code_places.hpp"
#include "backends/cell_emu/simulator/spu_elf.hpp"
#include "celltrace/spe/call_site.hpp"

#include <cstdint>
#include <span>

namespace celltrace::cell_emu {

/// The way in which a program takes the argument of Machine::start().
enum class Convention : std::uint8_t {
  kernel,      ///< as a kernel with backends/spu/main.cpp: the second argument of main() is the address of a
               ///< ControlBlock
  stand_alone, ///< as main(speid, argp, envp): argp is the argument of Machine::start()
};

/// Thread safety: all members are const.
class SimulatedProgram {
public:
  /// Throws InputError if `image` is no executable for the SPU.
  SimulatedProgram(std::span<const std::uint8_t> image, Convention convention);

  const SpuElf& elf() const { return elf_; }
  const CodePlaces& places() const { return places_; }
  Convention convention() const { return convention_; }
  /// Returns true if the program's stack follows the ABI: register 1 then holds the stack pointer and the
  /// number of free bytes.
  bool has_abi_stack() const { return has_abi_stack_; }
  /// Returns the source place of an address, for diagnostics: the innermost line outside of the compiler's
  /// own headers. Its strings stay valid as long as the process runs.
  CallSite site(std::uint32_t address) const;

private:
  SpuElf elf_;
  CodePlaces places_;
  Convention convention_;
  bool has_abi_stack_;
};

} // namespace celltrace::cell_emu
