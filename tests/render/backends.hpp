// The SPU types that this host can run, as render options.
#pragma once

#include "celltrace/render.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace celltrace::test {

struct TestBackend {
  Backend backend = Backend::native;
  SimdLevel simd = SimdLevel::automatic;

  /// Key of its type of SPU.
  std::string spu() const {
    const std::string name = name_of(backend);
    return backend == Backend::native ? name + "." + name_of(simd) : name;
  }
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

inline std::vector<TestBackend> backends() {
  std::vector<TestBackend> usable;
  std::vector<TestBackend> all;
  for (const SimdLevel simd : kSimdLevels)
    if (simd != SimdLevel::automatic) all.push_back({Backend::native, simd});
  all.push_back({Backend::cell_emu});
  for (const TestBackend& backend : all) {
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
