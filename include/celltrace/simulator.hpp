// Runs binaries for the SPU on a simulated Cell: for tests of the machine code that the SPU's compiler makes.
//
//   const std::vector<std::uint8_t> elf = ...; // spu-elf-gcc -O2 saxpy.c -o saxpy.elf
//   const SimulatedRun run = simulate(simulated(1), elf, to_ea(&control_block));
//   CHECK(run.ok());
//   CHECK(run.exit_codes[0] == 0);
//   CHECK(run.output == "done\n");
//
// docs/simulator.md says more. Link the CMake target celltrace::emulator.
#pragma once

#include "celltrace/emulator.hpp"
#include "celltrace/export.hpp"

#include <cstdint>
#include <span>
#include <stop_token>
#include <string>

namespace celltrace {

/// The outcome of a run of a binary.
struct SimulatedRun : EmulatedRun {
  /// Text that the programs wrote; empty if SimulationConfig::output receives it.
  std::string output, error_output;
};

/// Checks a binary. Throws InputError, with the reason, if `elf` is no executable for the SPU.
CELLTRACE_EXPORT void check_spu_program(std::span<const std::uint8_t> elf);

/// Returns the configuration of a machine whose SPUs execute machine code, in lockstep by virtual time.
CELLTRACE_EXPORT MachineConfig simulated(unsigned spes);

/// Runs a stand-alone program on every SPE of a new machine while `ppe` plays the PPE, and waits for all
/// SPEs. The program has main(speid, argp, envp), or is linked with -mstdmain. `argument` is argp. If `stop`
/// is requested, the programs end with errors. Throws InputError if the configuration is out of range or of a
/// backend other than "cell_sim", or if `elf` is no executable for the SPU, and passes on exceptions of `ppe`
/// other than SpeError. Thread safety: runs are independent of each other.
CELLTRACE_EXPORT SimulatedRun simulate(const MachineConfig& config, std::span<const std::uint8_t> elf,
                                       ea_t argument = 0, const EmulatedPpe& ppe = {},
                                       const std::stop_token& stop = {});

/// Returns the counters of all SPEs together, in the order of IBM's full-system simulator; several lines.
/// `timing` is the machine's.
CELLTRACE_EXPORT std::string counters_text(const EmulatedRun& run, const TimingParameters& timing);

/// Returns a profile's cycles as text for people: the functions, hottest first, then the hottest
/// instructions, as many as make up the share `listed` (0..1) of all cycles. `elf` is the program that was
/// profiled; throws InputError if it is no executable for the SPU.
CELLTRACE_EXPORT std::string profile_text(const SpuProfile& profile, std::span<const std::uint8_t> elf,
                                          double listed = 0.95);
/// Returns the profile as JSON, which docs/simulator.md describes, with all instructions that were executed.
CELLTRACE_EXPORT std::string profile_json(const SpuProfile& profile, std::span<const std::uint8_t> elf);

} // namespace celltrace
