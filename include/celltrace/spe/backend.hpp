// The backends that run SPE programs, and the host's SIMD instructions for them.
#pragma once

#include "celltrace/error.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace celltrace {

/// A machine that runs the SPEs' programs.
enum class Backend : unsigned char {
  native,   ///< threads of the host, which access memory directly
  cell_emu, ///< an emulated Cell; its programs are compiled for the host
  cell_sim, ///< the same Cell, but its SPUs execute machine code; needs a build with a compiler for the SPU
};
constexpr Backend kBackends[] = {Backend::native, Backend::cell_emu, Backend::cell_sim};

/// SIMD instructions of `native`. make_machine() throws for a level that the build or the CPU lacks.
enum class SimdLevel : unsigned char {
  automatic, ///< the widest level that the CPU and the program support
  sse2,
  avx2,
  avx512,  ///< AVX-512 with CD, DQ, BW and VL
  neon64,  ///< NEON of AArch64
  generic, ///< the compiler's vector extensions, for any CPU
};
constexpr SimdLevel kSimdLevels[] = {SimdLevel::automatic, SimdLevel::sse2,   SimdLevel::avx2,
                                     SimdLevel::avx512,    SimdLevel::neon64, SimdLevel::generic};

/// Return the name on the command line; "unknown" for values outside of the enumeration.
constexpr const char* name_of(Backend backend) {
  switch (backend) {
  case Backend::native:
    return "native";
  case Backend::cell_emu:
    return "cell_emu";
  case Backend::cell_sim:
    return "cell_sim";
  }
  return "unknown";
}
constexpr const char* name_of(SimdLevel level) {
  switch (level) {
  case SimdLevel::automatic:
    return "auto";
  case SimdLevel::sse2:
    return "sse2";
  case SimdLevel::avx2:
    return "avx2";
  case SimdLevel::avx512:
    return "avx512";
  case SimdLevel::neon64:
    return "neon64";
  case SimdLevel::generic:
    return "generic";
  }
  return "unknown";
}

namespace detail {

template <class Enumeration, std::size_t N>
Enumeration named(const char* what, const Enumeration (&all)[N], std::string_view name) {
  std::string names;
  for (const Enumeration each : all) {
    if (name == name_of(each)) return each;
    names += (names.empty() ? "" : ", ") + std::string(name_of(each));
  }
  throw InputError("unknown " + std::string(what) + " \"" + std::string(name) + "\"; there are " + names);
}

} // namespace detail

/// Return the enumerator whose name_of() is `name`. Throw InputError, listing all names, if no enumerator has
/// this name. Safe to call from any thread.
inline Backend backend_named(std::string_view name) {
  return detail::named("backend", kBackends, name);
}
inline SimdLevel simd_level_named(std::string_view name) {
  return detail::named("SIMD", kSimdLevels, name);
}

} // namespace celltrace
