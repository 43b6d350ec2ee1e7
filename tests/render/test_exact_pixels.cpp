// Pictures of all scenes of the tests, pixel by pixel: other comparisons let small differences through.
//
// Where pictures are meant to change, CELLTRACE_WRITE_PIXELS=1 in the environment makes the test write what
// it finds.
#include "celltrace/pov.hpp"
#include "render/backends.hpp"
#include "render/scenes.hpp"

#include <algorithm>
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

namespace {

const fs::path kSource = CELLTRACE_SOURCE_DIR;
const fs::path kExpected = kSource / "tests/render/pixels.txt";

/// FNV-1a.
std::string hash_of(const Image& image) {
  std::uint64_t hash = 14695981039346656037u;
  for (const std::uint8_t byte : image.rgba)
    hash = (hash ^ byte) * 1099511628211u;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

std::string hash_of(const Scene& scene) {
  TestBackend backend;
  RenderOptions options = backend.options(160, 120, 2);
  return hash_of(render(scene, options).image);
}

std::vector<fs::path> files() {
  std::vector<fs::path> found;
  for (const char* const folder : {"tests/scenes", "examples/scenes"})
    for (const fs::directory_entry& entry : fs::directory_iterator(kSource / folder))
      if (entry.path().extension() == ".pov") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// By the names of scenes, in which blanks are underscores.
using Hashes = std::map<std::string, std::string>;

std::string as_key(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

Hashes found_hashes() {
  Hashes found;
  for (const NamedScene& named : scenes())
    found[as_key(named.name)] = hash_of(named.make());
  ParseOptions options;
  options.message = [](std::string_view) {};
  for (const fs::path& file : files())
    found[file.filename().string()] = hash_of(parse_file(file, options));
  return found;
}

} // namespace

#ifndef CELLTRACE_SLOW_BUILD
TEST_CASE("Pictures of all scenes are what they were, pixel by pixel") {
  const Hashes found = found_hashes();
  if (std::getenv("CELLTRACE_WRITE_PIXELS") != nullptr) {
    std::ofstream file(kExpected);
    for (const auto& [name, hash] : found)
      file << hash << ' ' << name << '\n';
  }
  Hashes expected;
  std::ifstream file(kExpected);
  for (std::string hash, name; file >> hash >> name;)
    expected[name] = hash;
  CHECK(expected.size() == found.size());
  for (const auto& [name, hash] : found) {
    CAPTURE(name);
    CHECK(hash == expected[name]);
  }
}
#endif
