#include "backends/cell_emu/run_programs.hpp"

#include <algorithm>

namespace celltrace::cell_emu {
namespace {

void wait_for(Machine& machine, unsigned spe, EmulatedRun& run) {
  run.errors.emplace_back();
  run.exit_codes.push_back(0);
  try {
    const SpeStop stop = machine.wait(spe);
    run.exit_codes.back() = stop.code;
    if (stop.reason == SpeStop::Reason::stop_and_signal)
      run.errors.back() = "SPE " + std::to_string(spe) + ": stopped with code " + std::to_string(stop.code) +
                          " and was not resumed";
  } catch (const SpeError& error) {
    run.errors.back() = error.what();
  }
}

} // namespace

EmulatedRun run_programs(Machine& machine, const SpeProgram& program, ea_t argument, const EmulatedPpe& ppe) {
  const unsigned spes = machine.spe_count();
  for (unsigned spe = 0; spe < spes; ++spe)
    machine.start(spe, program, argument);
  EmulatedRun run;
  try {
    if (ppe) ppe(machine);
  } catch (const SpeError& error) {
    run.ppe_error = error.what();
  }
  for (unsigned spe = 0; spe < spes; ++spe) {
    wait_for(machine, spe, run);
    run.spes.push_back(machine.statistics(spe));
    run.cycles = std::max(run.cycles, run.spes.back().cycles.total_cycle);
  }
  run.diagnostics = machine.diagnostics();
  return run;
}

} // namespace celltrace::cell_emu
