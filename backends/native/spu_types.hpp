// The SPU types of this build, and the choice of types that the CPU can run.
#pragma once

#include "celltrace/spe/backend.hpp"
#include "celltrace/spe/program.hpp"
#include "celltrace/spe/types.hpp"

#include <string>
#include <vector>

namespace celltrace::native {

struct Spe;

/// An instantiation of Spu.
struct SpuType {
  SimdLevel simd;
  std::string key; ///< Spu::kKey
  bool (*supported)();
  /// Runs a kernel with an Spu object on the stack.
  void (*run)(Spe& spe, SpeProgram::Entry entry, ea_t argument);
};

/// Returns all types of this build, the widest first.
const std::vector<SpuType>& spu_types();

/// Returns the types that a machine may use: the type of a level, or for `automatic` all types that the CPU
/// supports. Throws InputError for a level that the build or the CPU lacks.
std::vector<const SpuType*> usable_spu_types(SimdLevel simd);

} // namespace celltrace::native
