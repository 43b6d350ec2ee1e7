// Machines of every SPU type that this host can run.
#pragma once

#include "celltrace/error.hpp"
#include "celltrace/spe/machine.hpp"

#include <memory>
#include <vector>

namespace celltrace::test {

inline std::vector<std::unique_ptr<Machine>> machines(unsigned spes = 1) {
  std::vector<std::unique_ptr<Machine>> usable;
  for (const SimdLevel simd : kSimdLevels) {
    MachineConfig config;
    config.spes = spes;
    config.simd = simd;
    if (simd == SimdLevel::automatic) config.backend = Backend::cell_emu;
    try {
      usable.push_back(make_machine(config));
    } catch (const InputError&) {
      continue; // not for this CPU
    }
    const std::string backend = name_of(config.backend);
    const std::string expected = config.backend == Backend::native ? backend + "." + name_of(simd) : backend;
    if (usable.back()->spu_key() != expected) throw Error("not the machine that was asked for: " + expected);
  }
  return usable;
}

} // namespace celltrace::test
