// The SPU types of this build, and which of them a CPU can run.
#pragma once

#include "celltrace/spe/backend.hpp"
#include "celltrace/spe/program.hpp"
#include "celltrace/spe/types.hpp"

#include <string>
#include <vector>

namespace celltrace::native {

struct Spe;

/// A Spu instantiation as the machine handles it.
struct SpuType {
  SimdLevel simd;
  std::string key; ///< Spu::kKey
  bool (*supported)();
  /// Constructs the Spu on the stack and runs the kernel on it.
  void (*run)(Spe& spe, SpeProgram::Entry entry, ea_t argument);
};

/// Returns all types of this build, the widest first.
const std::vector<SpuType>& spu_types();

/// Returns the types that a machine may use: one, or for `automatic` all that the CPU supports. Throws
/// InputError for a level that the build or the CPU lacks.
std::vector<const SpuType*> usable_spu_types(SimdLevel simd);

} // namespace celltrace::native
