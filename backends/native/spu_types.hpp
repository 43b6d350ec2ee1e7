// The SPU types of this build and which of them a CPU can run.
#pragma once

#include "celltrace/spe/program.hpp"
#include "celltrace/spe/types.hpp"

#include <string>
#include <vector>

namespace celltrace::native {

struct Spe;

/// A Spu instantiation as the machine handles it.
struct SpuType {
  std::string simd; ///< as in MachineConfig::simd
  std::string key;  ///< Spu::kKey
  bool (*supported)();
  /// Constructs the Spu on the stack and runs the kernel on it.
  void (*run)(Spe& spe, SpeProgram::Entry entry, ea_t argument);
};

/// All of this build, the widest first.
const std::vector<SpuType>& spu_types();

/// Those a machine may use: one that was named, or all that the CPU supports for "auto". Throws InputError
/// for a name that is unknown or that the CPU lacks.
std::vector<const SpuType*> usable_spu_types(const std::string& simd);

} // namespace celltrace::native
