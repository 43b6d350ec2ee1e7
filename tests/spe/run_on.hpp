// Runs a generic lambda as a kernel on a machine of a given kind.
//
//   const std::string key = GENERATE(from_range(spu_keys()));
//   run_on(key, 2, [](auto& spu, ea_t argument) { ... }, to_ea(&control));
//
// Kernels here are host code: they may write what they found straight into host memory, which the test reads
// after the run. Every run requires that the SPU type it names really ran the kernel.
//
// A key names an SPU type, and for cell_emu a schedule too: "native.avx2", "cell_emu", "cell_emu.lockstep".
#pragma once

#include "backends/cell_emu/machine.hpp"
#include "backends/native/machine.hpp"
#include "backends/native/spu.hpp"
#include "celltrace/spe/emulated_spu.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <string>
#include <vector>

namespace celltrace::test {

constexpr const char* kLockstep = "cell_emu.lockstep";

inline std::string spu_type_of(const std::string& key) {
  return key == kLockstep ? cell_emu::Spu::kKey : key;
}

inline std::unique_ptr<Machine> machine_of(const std::string& key, unsigned spes, MachineConfig config = {}) {
  config.spes = spes;
  if (spu_type_of(key) == cell_emu::Spu::kKey) {
    if (key == kLockstep) config.emulation.schedule = Schedule::lockstep;
    return cell_emu::make_machine(config);
  }
  config.simd = simd_level_named(key.substr(key.find('.') + 1));
  return native::make_machine(config);
}

/// The kinds of machine that this host can run.
inline std::vector<std::string> spu_keys() {
  std::vector<std::string> keys;
  for (const char* key :
       {cell_emu::Spu::kKey, kLockstep, native::Spu<BaselineArch>::kKey, "native.avx2", "native.avx512"}) {
    try {
      machine_of(key, 1);
      keys.push_back(key);
    } catch (const InputError&) {
      // The CPU lacks it.
    }
  }
  return keys;
}

/// How often `Kernel` has been entered on `Spu`.
template <class Spu, class Kernel> inline std::atomic<unsigned> entries{0};

template <class Kernel> struct Counted {
  template <class Spu> void operator()(Spu& spu, ea_t argument) const {
    ++entries<Spu, Kernel>;
    Kernel{}(spu, argument);
  }
};

template <class Kernel> SpeProgram program_of(Kernel) {
  SpeProgram program("test");
  program.add<cell_emu::Spu>(Counted<Kernel>{});
  program.add<native::Spu<BaselineArch>>(Counted<Kernel>{});
#if defined(__x86_64__)
  program.add<native::Spu<xsimd::avx2>>(Counted<Kernel>{});
  program.add<native::Spu<xsimd::avx512dq>>(Counted<Kernel>{});
#endif
  return program;
}

template <class Kernel> unsigned entries_on(const std::string& key, Kernel) {
  if (spu_type_of(key) == cell_emu::Spu::kKey) return entries<cell_emu::Spu, Kernel>;
#if defined(__x86_64__)
  if (key == "native.avx2") return entries<native::Spu<xsimd::avx2>, Kernel>;
  if (key == "native.avx512") return entries<native::Spu<xsimd::avx512dq>, Kernel>;
#endif
  return entries<native::Spu<BaselineArch>, Kernel>;
}

/// Runs the kernel on every SPE of the machine while `ppe(machine)` plays the PPE, and waits for all. Throws
/// the first error in the order of the SPEs.
template <class Kernel, class Ppe>
void run_on(const std::string& key, Machine& machine, Kernel kernel, ea_t argument, Ppe ppe) {
  const unsigned before = entries_on(key, kernel);
  const SpeProgram program = program_of(kernel);
  for (unsigned spe = 0; spe < machine.spe_count(); ++spe)
    machine.start(spe, program, argument);
  ppe(machine);
  for (unsigned spe = 0; spe < machine.spe_count(); ++spe)
    machine.wait(spe);
  REQUIRE(std::string(machine.spu_key()) == spu_type_of(key));
  REQUIRE(entries_on(key, kernel) == before + machine.spe_count());
}

template <class Kernel>
std::unique_ptr<Machine> run_on(const std::string& key, unsigned spes, Kernel kernel, ea_t argument = 0) {
  std::unique_ptr<Machine> machine = machine_of(key, spes);
  run_on(key, *machine, kernel, argument, [](Machine&) {});
  return machine;
}

/// The error that a kernel ends with on SPE 0, or "" if it does not.
template <class Kernel> std::string error_on(const std::string& key, Kernel kernel, ea_t argument = 0) {
  try {
    run_on(key, 1, kernel, argument);
  } catch (const SpeError& error) {
    return error.what();
  }
  return "";
}

/// The object whose effective address a kernel got.
template <class T> T& at(ea_t argument) {
  return *reinterpret_cast<T*>(static_cast<std::uintptr_t>(argument));
}

} // namespace celltrace::test
