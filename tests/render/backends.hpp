// The SPU types that this host can run, as render options.
#pragma once

#include "celltrace/render.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace celltrace::test {

struct Backend {
  std::string backend, simd;

  std::string spu() const { return backend == "native" ? backend + "." + simd : backend; }
  RenderOptions options(int width, int height, unsigned spes) const {
    RenderOptions options;
    options.width = width;
    options.height = height;
    options.backend = backend;
    options.simd = simd;
    options.spes = spes;
    return options;
  }
};

/// Length of an edge of a picture, shorter where sanitizers make the kernels slow.
constexpr int pixels(int edge) {
#ifdef CELLTRACE_SLOW_BUILD
  return edge / 3;
#else
  return edge;
#endif
}

inline std::vector<Backend> backends() {
  std::vector<Backend> usable;
  for (const Backend& backend :
       {Backend{"native", "sse2"}, Backend{"native", "avx2"}, Backend{"native", "avx512"},
        Backend{"native", "neon64"}, Backend{"native", "generic"}, Backend{"cell_emu", "auto"}}) {
    try {
      Renderer renderer(backend.options(4, 4, 1));
      usable.push_back(backend);
    } catch (const InputError&) {
      // Not for this CPU.
    }
  }
  return usable;
}

/// What a Progress has heard of a job that was completed.
inline void check_completed(const std::vector<double>& fractions) {
  REQUIRE(fractions.size() >= 2);
  CHECK(fractions.front() == 0);
  CHECK(fractions.back() == 1);
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
}

} // namespace celltrace::test
