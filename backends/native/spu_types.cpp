#include "backends/native/spu_types.hpp"

#include "backends/native/spu.hpp"

namespace celltrace::native {

namespace {

template <class Arch> SpuType spu_type(bool (*supported)()) {
  const std::string key = Spu<Arch>::kKey;
  return {simd_level_named(key.substr(key.find('.') + 1)), key, supported,
          [](Spe& spe, SpeProgram::Entry entry, ea_t argument) {
            Spu<Arch> spu(spe);
            entry(&spu, argument);
          }};
}

std::string names() {
  std::string list = name_of(SimdLevel::automatic);
  for (const SpuType& type : spu_types())
    list += std::string(", ") + name_of(type.simd);
  return list;
}

} // namespace

const std::vector<SpuType>& spu_types() {
  static const std::vector<SpuType> types = {
#ifdef CELLTRACE_HAS_NATIVE_AVX512
    spu_type<xsimd::avx512dq>([] {
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
             __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
             __builtin_cpu_supports("avx512vl");
    }),
#endif
#ifdef CELLTRACE_HAS_NATIVE_AVX2
    spu_type<xsimd::avx2>([]() -> bool { return __builtin_cpu_supports("avx2"); }),
#endif
#ifdef CELLTRACE_HAS_NATIVE_SSE2
    spu_type<xsimd::sse2>([] { return true; }),
#endif
#ifdef CELLTRACE_HAS_NATIVE_NEON64
    spu_type<xsimd::neon64>([] { return true; }),
#endif
#ifdef CELLTRACE_HAS_NATIVE_GENERIC
    spu_type<GenericArch>([] { return true; }),
#endif
  };
  return types;
}

std::vector<const SpuType*> usable_spu_types(SimdLevel simd) {
  std::vector<const SpuType*> usable;
  bool built = simd == SimdLevel::automatic;
  for (const SpuType& type : spu_types()) {
    if (simd != SimdLevel::automatic && simd != type.simd) continue;
    built = true;
    if (type.supported()) usable.push_back(&type);
  }
  const std::string name = "SIMD \"" + std::string(name_of(simd)) + "\"";
  if (!built) throw InputError("this build has no " + name + ", but " + names());
  if (usable.empty()) throw InputError("this CPU does not support " + name);
  return usable;
}

} // namespace celltrace::native
