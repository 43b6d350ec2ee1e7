// The kinds of machine that the programs of tests run on: every SPU type of the build, and the emulated Cell,
// with kernels that the host compiled (cell_emu) or with machine code (cell_sim), under each of its
// schedules.
//
//   const auto kind = GENERATE(from_range(kinds_for(probe_program())));
//   const std::unique_ptr<Machine> machine = kind.machine(2);
//   ... records in machine->byte_order() ...
//   check_clean(emulate_on(*machine, probe_program(), records.ea()));
#pragma once

#include "celltrace/emulator.hpp"
#include "celltrace/spe/machine.hpp"

#include <catch2/catch.hpp>

#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace celltrace::test {

struct MachineKind {
  std::string name; ///< "native.avx2", "cell_sim, exploring"
  MachineConfig config;

  bool is_native() const { return config.backend == Backend::native; }
  bool runs_machine_code() const { return config.backend == Backend::cell_sim; }
  std::unique_ptr<Machine> machine(unsigned spes) const {
    MachineConfig with_spes = config;
    with_spes.spes = spes;
    std::unique_ptr<Machine> made = make_machine(with_spes);
    const std::string backend = name_of(config.backend);
    REQUIRE(made->spu_key() == (is_native() ? backend + "." + name_of(config.simd) : backend));
    return made;
  }
  friend std::ostream& operator<<(std::ostream& out, const MachineKind& kind) { return out << kind.name; }
};

/// Those that this host can run and that the program was made for.
inline std::vector<MachineKind> kinds_for(const SpeProgram& program) {
  std::vector<MachineKind> kinds;
  for (const SimdLevel simd : kSimdLevels) {
    if (simd == SimdLevel::automatic) continue;
    MachineKind kind{std::string("native.") + name_of(simd), {}};
    kind.config.simd = simd;
    try {
      make_machine(kind.config);
      kinds.push_back(kind);
    } catch (const InputError&) {
      // The CPU lacks it.
    }
  }
  for (const Backend backend : {Backend::cell_emu, Backend::cell_sim}) {
    if (backend == Backend::cell_sim && program.image(name_of(backend)).empty()) {
      WARN("skipped on cell_sim: the program \"" << program.name()
                                                 << "\" has no machine code, which needs CELLTRACE_SPU_GXX");
      continue;
    }
    for (const auto& [schedule, config] :
         {std::pair{"free", free_running(1)}, std::pair{"lockstep", lockstep(1)},
          std::pair{"exploring", exploring(1, 11)}, std::pair{"with faults", exploring_with_faults(1, 12)}}) {
      kinds.push_back({std::string(name_of(backend)) + ", " + schedule, config});
      kinds.back().config.backend = backend;
    }
  }
  return kinds;
}

/// No program failed and no rule was broken.
inline void check_clean(const EmulatedRun& run) {
  INFO(run.report());
  CHECK(run.ok());
}

} // namespace celltrace::test
