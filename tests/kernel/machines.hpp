// Machines of every SPU type that this host can run.
#pragma once

#include "celltrace/error.hpp"
#include "celltrace/spe/machine.hpp"

#include <memory>
#include <vector>

namespace celltrace::test {

inline std::vector<std::unique_ptr<Machine>> machines(unsigned spes = 1) {
  std::vector<std::unique_ptr<Machine>> usable;
  for (const char* simd : {"sse2", "avx2", "avx512", "neon64", "generic", ""}) {
    MachineConfig config;
    config.spes = spes;
    config.backend = *simd == '\0' ? "cell_emu" : "native";
    if (*simd != '\0') config.simd = simd;
    try {
      usable.push_back(make_machine(config));
    } catch (const InputError&) {
      continue; // not for this CPU
    }
    const std::string expected = *simd == '\0' ? "cell_emu" : "native." + std::string(simd);
    if (usable.back()->spu_key() != expected) throw Error("not the machine that was asked for: " + expected);
  }
  return usable;
}

} // namespace celltrace::test
