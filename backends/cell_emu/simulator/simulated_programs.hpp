// SimulatedPrograms: a machine's data for SPUs that execute machine code. They are the programs that were
// started, the control blocks of kernels in main memory, and the PPE's side of calls that programs make.
#pragma once

#include "backends/cell_emu/address_map.hpp"
#include "backends/cell_emu/simulator/ppe_calls.hpp"
#include "backends/cell_emu/simulator/program_arguments.hpp"
#include "backends/cell_emu/simulator/simulated_program.hpp"
#include "backends/cell_emu/simulator/simulated_spu.hpp"
#include "celltrace/spe/machine.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace celltrace::cell_emu {

/// Thread safety: call() may be called by any thread, all other members by the PPE's thread.
class SimulatedPrograms {
public:
  /// Throws InputError for arguments that are too long, and for folders that do not exist. The map has to
  /// outlive this object.
  SimulatedPrograms(const MachineConfig& config, const AddressMap& map);
  ~SimulatedPrograms();

  /// Returns the machine code of a program. Throws SpeError if the program has no machine code, InputError if
  /// the machine code is no executable for the SPU.
  std::shared_ptr<const SimulatedProgram> find(const SpeProgram& program);
  /// Returns the registers for the program when SPE `spe` starts it.
  StartRegisters arguments(const SimulatedProgram& program, unsigned spe, ea_t argument);
  /// Calls PpeCalls::handle() at virtual time `now`. Thread-safe.
  bool call(unsigned code, std::uint8_t* local_store, std::uint32_t npc, Cycle now);

private:
  PpeCallsConfig calls_config(const MachineConfig& config, const AddressMap& map);

  /// The big-endian data of one SPE that its kernel reads.
  struct Block;

  std::vector<std::shared_ptr<const SimulatedProgram>> programs_;
  std::unique_ptr<Block[]> blocks_;
  const AddressMap& map_;
  const ProgramArguments arguments_;
  std::atomic<Cycle> time_of_call_{0};
  PpeCalls calls_;
};

} // namespace celltrace::cell_emu
