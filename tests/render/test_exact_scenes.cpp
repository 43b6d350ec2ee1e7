// All scenes of the tests, exactly: the pixels of their pictures, the bytes of their images, and how much
// there is to do for them. Other comparisons let small differences through.
//
// Where one of these is meant to change, CELLTRACE_WRITE_EXPECTED=1 in the environment makes the test write
// what it finds.
#include "celltrace/pov.hpp"
#include "render/backends.hpp"
#include "render/image_bytes.hpp"
#include "render/scenes.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;
namespace fs = std::filesystem;

#ifndef CELLTRACE_SLOW_BUILD

namespace {

const fs::path kSource = CELLTRACE_SOURCE_DIR;
const fs::path kExpected = kSource / "tests/render/expected_scenes.txt";

struct Exact {
  std::string pixels; ///< a hash
  std::string image;  ///< a hash of the scene image's bytes
  /// Rays of all kinds, tests of packets, visits and nodes of the BVH.
  std::string counts;
};

Exact exact(const Scene& scene) {
  // One SPE: with several the counts depend on which of them has a packet.
  const RenderResult result = render(scene, TestBackend().options(160, 120, 1));
  const RenderStatistics& s = result.statistics;
  std::uint64_t tests = 0;
  for (const auto& [shape, count] : s.packet_tests)
    tests += count;
  std::string counts;
  for (const std::uint64_t count :
       {s.objects, s.shadow_rays, s.reflection_rays, s.refraction_rays, tests, s.accelerator_visits,
        std::uint64_t{s.bvh_nodes}, s.accelerator_list_entries})
    counts += (counts.empty() ? "" : ",") + std::to_string(count);
  return {hash_of(result.image.rgba), hash_of(bytes_of(SceneImage(scene))), counts};
}

/// By the names of scenes, in which blanks are underscores.
using AllExact = std::map<std::string, Exact>;

AllExact found_scenes() {
  AllExact found;
  for (const NamedScene& named : scenes()) {
    std::string name = named.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    found[name] = exact(named.make());
  }
  ParseOptions options;
  options.message = [](std::string_view) {};
  for (const char* const folder : {"tests/scenes", "examples/scenes"})
    for (const fs::directory_entry& entry : fs::directory_iterator(kSource / folder))
      if (entry.path().extension() == ".pov")
        found[entry.path().filename().string()] = exact(parse_file(entry.path(), options));
  return found;
}

} // namespace

TEST_CASE("All scenes have the pixels, images and counts that they had") {
  const AllExact found = found_scenes();
  if (std::getenv("CELLTRACE_WRITE_EXPECTED") != nullptr) {
    std::ofstream file(kExpected);
    for (const auto& [name, all] : found)
      file << all.pixels << ' ' << all.image << ' ' << all.counts << ' ' << name << '\n';
  }
  AllExact expected;
  std::ifstream file(kExpected);
  Exact all;
  for (std::string name; file >> all.pixels >> all.image >> all.counts >> name;)
    expected[name] = all;
  CHECK(expected.size() == found.size());
  for (const auto& [name, is] : found) {
    CAPTURE(name);
    CHECK(is.pixels == expected[name].pixels);
    CHECK(is.counts == expected[name].counts);
    // Where single precision's bytes lie the other way round, images are others.
    if (std::endian::native == std::endian::little) CHECK(is.image == expected[name].image);
  }
}

#endif
