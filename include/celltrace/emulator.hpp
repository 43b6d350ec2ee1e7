// Any callable as an SPE program on an emulated Cell: for unit tests of SPE code on a PC.
//
//   alignas(128) float data[32] = {1, 2, 3};
//   const EmulatedRun run = emulate(lockstep(1), [&](EmulatedSpu& spu) {
//     float* buffer = spu.allocate<float>(32);
//     spu.get(buffer, to_ea(data), sizeof data, 0);
//     spu.wait_all(1 << 0);
//     CHECK(buffer[2] == 3);
//   });
//   CHECK(run.ok());
//
// docs/testing-spe-code.md shows more. Link the CMake target celltrace::emulator.
#pragma once

#include "celltrace/export.hpp"
#include "celltrace/spe/emulated_spu.hpp"
#include "celltrace/spe/machine.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace celltrace {

/// What a program sees of its SPE: SpuBase, and what only the emulator has.
using EmulatedSpu = cell_emu::Spu;

/// What a run of programs left behind.
struct CELLTRACE_EXPORT EmulatedRun {
  std::vector<Diagnostic> diagnostics; ///< in the order of their discovery
  /// By SPE: the error that ended its program; "" if there was none.
  std::vector<std::string> errors;
  /// The SpeError that one of the PPE's calls ended with, a deadlock for instance; or "".
  std::string ppe_error;
  std::vector<std::uint32_t> exit_codes; ///< by SPE
  std::vector<SpeStatistics> spes;       ///< by SPE
  /// Virtual cycles of the SPE that took most, from its start to its end.
  std::uint64_t cycles = 0;

  /// No rule was broken and no program failed.
  bool ok() const;
  bool broke(Rule rule) const { return count(rule) != 0; }
  std::size_t count(Rule rule) const;
  /// The first diagnostic of a rule, or null.
  const Diagnostic* find(Rule rule) const;
  /// All diagnostics and errors, a line each; for messages of failed tests.
  std::string report() const;
};

/// A machine in lockstep by virtual time.
CELLTRACE_EXPORT MachineConfig lockstep(unsigned spes);
/// A machine in lockstep that explores the interleavings of `seed`, with data that move at random times.
CELLTRACE_EXPORT MachineConfig exploring(unsigned spes, std::uint64_t seed);
/// As exploring(), with slow and pausing SPEs, late DMA and late words from the PPE.
CELLTRACE_EXPORT MachineConfig exploring_with_faults(unsigned spes, std::uint64_t seed);
/// A machine with a thread per SPE.
CELLTRACE_EXPORT MachineConfig free_running(unsigned spes);

using EmulatedProgram = std::function<void(EmulatedSpu&, ea_t)>;
using EmulatedPpe = std::function<void(Machine&)>;

/// Runs the program on every SPE of a new machine while `ppe` plays the PPE, and waits for all. A program
/// that stops with a signal is the PPE's to resume. Programs may use whatever the host has, also what they
/// capture; on the free schedule they run at the same time. Throws InputError for a configuration out of
/// range, and what `ppe` throws unless that is an SpeError.
CELLTRACE_EXPORT EmulatedRun emulate_program(const MachineConfig& config, const EmulatedProgram& program,
                                             ea_t argument, const EmulatedPpe& ppe);

/// The same on a machine that is there, with a program as machines take it. Of the machine before there must
/// be nothing left to wait for.
CELLTRACE_EXPORT EmulatedRun emulate_on(Machine& machine, const SpeProgram& program, ea_t argument = 0,
                                        const EmulatedPpe& ppe = {});

/// emulate_program() with a program that takes (spu, argument) or only (spu).
template <class Program>
EmulatedRun emulate(const MachineConfig& config, Program program, ea_t argument = 0,
                    const EmulatedPpe& ppe = {}) {
  if constexpr (std::is_invocable_v<Program&, EmulatedSpu&, ea_t>) {
    return emulate_program(config, std::move(program), argument, ppe);
  } else {
    return emulate_program(
        config, [program = std::move(program)](EmulatedSpu& spu, ea_t) mutable { program(spu); }, argument,
        ppe);
  }
}

} // namespace celltrace
