// The registers and the argv with which a stand-alone program for the SPU starts.
//
// Sources: the start-up code of newlib's libgloss/spu (crt1 for main(speid, argp, envp), crt2 for -mstdmain),
// and libspe2's spe_context_run() and elfspe, which set the registers that the start-up code reads.
#pragma once

#include "celltrace/spe/quadword.hpp"
#include "backends/cell_emu/simulator/spu_elf.hpp"
#include "celltrace/spe/types.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace celltrace::cell_emu {

/// The values of registers 3 to 6 at a program's start.
struct StartRegisters {
  isa::Quadword spe_id, argp, envp;
  isa::Quadword local_store; ///< effective address of the program's own local store

  /// Returns the registers for a main(speid, argp, envp): each has 64 bits, which begin in the preferred
  /// slot. envp is 0.
  static StartRegisters of(std::uint64_t spe_id, std::uint64_t argp, std::uint64_t local_store);
};

/// Returns true if the program's start-up code fetches argv into local store, for a main(argc, argv).
bool fetches_argv(const SpuElf& elf);

/// An argv in main memory, in the form for main(speid, argp, envp) and in the form for -mstdmain. Immutable;
/// must not be moved while programs run.
class ProgramArguments {
public:
  /// Throws InputError if the arguments do not fit into one DMA command: 16 KB with terminators and pointers.
  explicit ProgramArguments(const std::vector<std::string>& arguments);

  /// Returns true if there are arguments besides argv[0].
  bool has_any() const { return count_ > 1; }
  /// Returns the address of an argv in the format of a 64-bit PPE.
  ea_t ppe_argv() const { return reinterpret_cast<std::uintptr_t>(ppe_argv_.data()); }
  /// Returns the registers for start-up code that fetches argv: argc, argv's address in local store, its
  /// effective address, and its size in bytes.
  StartRegisters for_fetching(std::uint64_t local_store) const;

private:
  struct alignas(kLineBytes) Line {
    std::uint8_t bytes[kLineBytes] = {};
  };

  std::uint32_t count_;
  std::uint32_t local_bytes_; ///< size of spu_argv_, a multiple of 16
  std::vector<Line> ppe_argv_, spu_argv_;
};

} // namespace celltrace::cell_emu
