#include "backends/native/spu_types.hpp"

#include "backends/native/spu.hpp"
#include "celltrace/error.hpp"

namespace celltrace::native {

namespace {

template <class Arch> SpuType spu_type(bool (*supported)()) {
  const std::string key = Spu<Arch>::kKey;
  return {key.substr(key.find('.') + 1), key, supported,
          [](Spe& spe, SpeProgram::Entry entry, ea_t argument) {
            Spu<Arch> spu(spe);
            entry(&spu, argument);
          }};
}

std::string names() {
  std::string list = "auto";
  for (const SpuType& type : spu_types())
    list += ", " + type.simd;
  return list;
}

} // namespace

const std::vector<SpuType>& spu_types() {
  static const std::vector<SpuType> types = {
#if defined(__x86_64__)
#ifdef CELLTRACE_WIDE_SIMD
    spu_type<xsimd::avx512dq>([] {
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
             __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
             __builtin_cpu_supports("avx512vl");
    }),
    spu_type<xsimd::avx2>([]() -> bool { return __builtin_cpu_supports("avx2"); }),
#endif
    spu_type<xsimd::sse2>([] { return true; }),
#elif defined(__aarch64__)
    spu_type<xsimd::neon64>([] { return true; }),
#endif
#ifdef CELLTRACE_GENERIC_SIMD
    spu_type<GenericArch>([] { return true; }),
#endif
  };
  return types;
}

std::vector<const SpuType*> usable_spu_types(const std::string& simd) {
  std::vector<const SpuType*> usable;
  bool known = simd == "auto";
  for (const SpuType& type : spu_types()) {
    if (simd != "auto" && simd != type.simd) continue;
    known = true;
    if (type.supported()) usable.push_back(&type);
  }
  if (!known) throw InputError("unknown SIMD \"" + simd + "\"; this build has " + names());
  if (usable.empty()) throw InputError("this CPU does not support SIMD \"" + simd + "\"");
  return usable;
}

} // namespace celltrace::native
