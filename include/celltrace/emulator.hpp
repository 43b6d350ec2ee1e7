// Runs any callable as an SPE program on an emulated Cell: for unit tests of SPE code on a PC.
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

/// The SPE as its program sees it: the functions of SpuBase, and functions that only the emulator has.
using EmulatedSpu = cell_emu::Spu;

/// The outcome of a run of programs.
struct CELLTRACE_EXPORT EmulatedRun {
  std::vector<Diagnostic> diagnostics; ///< diagnostics in the order of their discovery
  /// The errors that ended the SPEs' programs, by SPE; "" for a program that ended well.
  std::vector<std::string> errors;
  /// The message of an SpeError that a call of the PPE threw, because of a deadlock for instance; or "".
  std::string ppe_error;
  std::vector<std::uint32_t> exit_codes; ///< index: SPE
  std::vector<SpeStatistics> spes;       ///< index: SPE
  /// Virtual cycles of the SPE that took the longest, from its start to its end.
  std::uint64_t cycles = 0;

  /// Returns true if no rule was broken and no program failed.
  bool ok() const;
  bool broke(Rule rule) const { return count(rule) != 0; }
  std::size_t count(Rule rule) const;
  /// Returns the first diagnostic of a rule, or null.
  const Diagnostic* find(Rule rule) const;
  /// Returns all diagnostics and errors, a line each, for the messages of failed tests.
  std::string report() const;
};

/// Returns the configuration of a machine in lockstep by virtual time.
CELLTRACE_EXPORT MachineConfig lockstep(unsigned spes);
/// As lockstep(), but the order of the SPEs' turns and the times at which DMA moves data are random, from
/// `seed`.
CELLTRACE_EXPORT MachineConfig exploring(unsigned spes, std::uint64_t seed);
/// As exploring(), with slow and pausing SPEs, late DMA and late words from the PPE.
CELLTRACE_EXPORT MachineConfig exploring_with_faults(unsigned spes, std::uint64_t seed);
/// Returns the configuration of a machine with one thread per SPE.
CELLTRACE_EXPORT MachineConfig free_running(unsigned spes);

using EmulatedProgram = std::function<void(EmulatedSpu&, ea_t)>;
using EmulatedPpe = std::function<void(Machine&)>;

/// Runs `program` on every SPE of a new machine while `ppe` plays the PPE, and waits for all SPEs. If a
/// program stops with a signal, `ppe` has to resume it. Programs may use everything on the host, including
/// variables that they capture; on the free schedule programs run at the same time. Throws InputError if the
/// configuration is out of range, and passes on exceptions of `ppe` other than SpeError.
CELLTRACE_EXPORT EmulatedRun emulate_program(const MachineConfig& config, const EmulatedProgram& program,
                                             ea_t argument, const EmulatedPpe& ppe);

/// As emulate_program(), on an existing machine and with a program in the form that machines take. All
/// earlier runs on the machine must have been waited for.
CELLTRACE_EXPORT EmulatedRun emulate_on(Machine& machine, const SpeProgram& program, ea_t argument = 0,
                                        const EmulatedPpe& ppe = {});

/// Calls emulate_program() with a program that takes (spu, argument) or only (spu).
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
