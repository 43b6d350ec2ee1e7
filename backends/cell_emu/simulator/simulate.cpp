#include "backends/cell_emu/machine.hpp"
#include "backends/cell_emu/simulator/simulated_spu.hpp"
#include "celltrace/simulator.hpp"

namespace celltrace {

void check_spu_program(std::span<const std::uint8_t> elf) {
  const cell_emu::SpuElf checked(elf);
}

MachineConfig simulated(unsigned spes) {
  MachineConfig config;
  config.backend = Backend::cell_sim;
  config.spes = spes;
  config.emulation.schedule = Schedule::lockstep;
  return config;
}

SimulatedRun simulate(const MachineConfig& config, std::span<const std::uint8_t> elf, ea_t argument,
                      const EmulatedPpe& ppe, const std::stop_token& stop) {
  if (config.backend != Backend::cell_sim)
    throw InputError("machine code runs on cell_sim, not on " + std::string(name_of(config.backend)));
  check_spu_program(elf);
  SimulatedRun run;
  MachineConfig own = config;
  const auto collect_in = [](std::string& text) {
    return [&text](std::string_view piece) { text += piece; };
  };
  if (!own.simulation.output) own.simulation.output = collect_in(run.output);
  if (!own.simulation.error_output) own.simulation.error_output = collect_in(run.error_output);
  const std::unique_ptr<Machine> machine = cell_emu::make_machine(own);
  SpeProgram program("SPU program");
  program.add_image(cell_emu::SimulatedSpu::kElfKey, elf);
  const std::stop_callback interrupt(stop, [&machine] { machine->interrupt(); });
  static_cast<EmulatedRun&>(run) = emulate_on(*machine, program, argument, ppe);
  return run;
}

} // namespace celltrace
