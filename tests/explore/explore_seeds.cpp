// Renders scenes on an emulated Cell under many seeds: each draws the interleaving of the SPEs, when DMA
// moves and completes, which SPEs are slow or pause, and how long words take. The picture has to be native's
// every time, with no rule broken, no deadlock, and every row rendered once.
//
//   explore_seeds [--seeds N] [--first N] [--width N] [--height N] SCENE.pov...
//
// Exit code 1 with the seed that failed, which fails again whenever it is given as --first N --seeds 1.
#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

namespace {

using namespace celltrace;

struct Settings {
  std::vector<std::string> scenes;
  std::uint64_t first = 1;
  std::uint64_t seeds = 100;
  int width = 64;
  int height = 48;
};

/// What is wrong with the run of one seed; empty: nothing.
std::string fault_of(const Scene& scene, const RenderOptions& common, const Image& expected,
                     std::uint64_t seed) {
  std::string broken;
  RenderOptions options = common;
  options.backend = Backend::cell_emu;
  options.spes = static_cast<unsigned>(2 + seed % 7);
  options.emulation.schedule = Schedule::lockstep;
  options.emulation.explore = true;
  options.emulation.seed = seed;
  options.emulation.transfers = TransferTime::random;
  options.emulation.faults = Faults::mixed();
  options.diagnostic = [&](const Diagnostic& diagnostic) { broken += diagnostic.text + "\n"; };
  try {
    const RenderResult result = render(scene, options);
    const Comparison difference = compare_images(result.image, expected);
    if (difference.differing_pixels != 0)
      broken += std::to_string(difference.differing_pixels) + " pixels differ\n";
    const auto& spes = result.statistics.spes;
    const std::uint32_t packets = std::accumulate(
        spes.begin(), spes.end(), 0u, [](std::uint32_t sum, const auto& spe) { return sum + spe.packets; });
    const auto in_picture = static_cast<std::uint32_t>((options.width + 3) / 4 * ((options.height + 3) / 4));
    if (packets != in_picture)
      broken += std::to_string(packets) + " packets rendered, not " + std::to_string(in_picture) + "\n";
  } catch (const Error& error) {
    broken += error.what();
  }
  return broken;
}

bool explore(const std::string& path, const Settings& settings) {
  const Scene scene = parse_file(path);
  RenderOptions options;
  options.width = settings.width;
  options.height = settings.height;
  const Image expected = render(scene, options).image;
  for (std::uint64_t seed = settings.first; seed < settings.first + settings.seeds; ++seed) {
    const std::string fault = fault_of(scene, options, expected, seed);
    if (fault.empty()) continue;
    std::fprintf(stderr, "%s, seed %llu:\n%s\n", path.c_str(), static_cast<unsigned long long>(seed),
                 fault.c_str());
    return false;
  }
  std::printf(
      "%s: %llu seeds from %llu on: the same picture, no diagnostic, no deadlock, every packet once\n",
      path.c_str(), static_cast<unsigned long long>(settings.seeds),
      static_cast<unsigned long long>(settings.first));
  std::fflush(stdout);
  return true;
}

} // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app("Renders scenes on an emulated Cell under many seeds");
  app.add_option("scenes", settings.scenes, "Scenes to render")->required()->check(CLI::ExistingFile);
  app.add_option("--first", settings.first, "First seed")->capture_default_str();
  app.add_option("--seeds", settings.seeds, "Number of seeds")->capture_default_str();
  app.add_option("--width", settings.width, "Pixels")->check(CLI::Range(1, 4096))->capture_default_str();
  app.add_option("--height", settings.height, "Pixels")->check(CLI::Range(1, 4096))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  bool good = true;
  for (const std::string& scene : settings.scenes) {
    try {
      good = explore(scene, settings) && good;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      good = false;
    }
  }
  return good ? 0 : 1;
}
