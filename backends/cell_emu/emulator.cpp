#include "celltrace/emulator.hpp"

#include "backends/cell_emu/machine.hpp"

namespace celltrace {
namespace {

MachineConfig emulated(unsigned spes, Schedule schedule) {
  MachineConfig config;
  config.backend = Backend::cell_emu;
  config.spes = spes;
  config.emulation.schedule = schedule;
  config.emulation.red_zones = true;
  return config;
}

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

/// Returns the error without its description of a deadlock, if `text` already contains the description.
std::string without_told(const std::string& error, const std::string& text) {
  const std::size_t deadlock = error.find("deadlock: ");
  if (deadlock == std::string::npos || text.find(error.substr(deadlock)) == std::string::npos) return error;
  return error.substr(0, deadlock) + "deadlock";
}

} // namespace

bool EmulatedRun::ok() const {
  return diagnostics.empty() && ppe_error.empty() &&
         std::all_of(errors.begin(), errors.end(), [](const std::string& error) { return error.empty(); });
}

std::size_t EmulatedRun::count(Rule rule) const {
  return static_cast<std::size_t>(std::count_if(diagnostics.begin(), diagnostics.end(),
                                                [&](const Diagnostic& each) { return each.rule == rule; }));
}

const Diagnostic* EmulatedRun::find(Rule rule) const {
  const auto found = std::find_if(diagnostics.begin(), diagnostics.end(),
                                  [&](const Diagnostic& each) { return each.rule == rule; });
  return found == diagnostics.end() ? nullptr : &*found;
}

std::string EmulatedRun::report() const {
  std::string text;
  for (const Diagnostic& each : diagnostics)
    text += each.text + "\n";
  const auto add = [&](const std::string& who, const std::string& error) {
    if (!error.empty() && text.find(error) == std::string::npos)
      text += who + without_told(error, text) + "\n";
  };
  add("PPE: ", ppe_error);
  for (const std::string& error : errors)
    add("", error);
  return text;
}

MachineConfig lockstep(unsigned spes) {
  return emulated(spes, Schedule::lockstep);
}

MachineConfig exploring(unsigned spes, std::uint64_t seed) {
  MachineConfig config = emulated(spes, Schedule::lockstep);
  config.emulation.explore = true;
  config.emulation.seed = seed;
  config.emulation.transfers = TransferTime::random;
  return config;
}

MachineConfig exploring_with_faults(unsigned spes, std::uint64_t seed) {
  MachineConfig config = exploring(spes, seed);
  config.emulation.faults = Faults::mixed();
  return config;
}

MachineConfig free_running(unsigned spes) {
  return emulated(spes, Schedule::free);
}

EmulatedRun emulate_program(const MachineConfig& config, const EmulatedProgram& program, ea_t argument,
                            const EmulatedPpe& ppe) {
  const std::unique_ptr<Machine> machine = cell_emu::make_machine(config);
  SpeProgram entries("emulated program");
  entries.add(EmulatedSpu::kKey,
              [&program](void* spu, ea_t given) { program(*static_cast<EmulatedSpu*>(spu), given); });
  return emulate_on(*machine, entries, argument, ppe);
}

EmulatedRun emulate_on(Machine& machine, const SpeProgram& program, ea_t argument, const EmulatedPpe& ppe) {
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

} // namespace celltrace
