// libFuzzer target: whatever parses can be rendered.
#include "celltrace/error.hpp"
#include "celltrace/render.hpp"
#include "fuzz/limits.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>

using namespace celltrace;

namespace {

constexpr std::size_t kMostObjects = 500;
constexpr std::chrono::seconds kMostTime{2};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    Scene scene = parse_string({reinterpret_cast<const char*>(data), size}, test::fuzzing_options());
    if (scene.objects.size() > kMostObjects) return 0;
    scene.max_trace_level = std::min(scene.max_trace_level, 4);
    RenderOptions options;
    options.width = options.height = 16;
    options.spes = 1;
    const auto end = std::chrono::steady_clock::now() + kMostTime;
    const auto in_time = [end](double) { return std::chrono::steady_clock::now() < end; };
    options.build_progress = in_time;
    const RenderResult result = render(scene, options, in_time);
    if (result.image.rgba.size() != 16 * 16 * 4) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
