// What is measured and how, as the command line says it.
#pragma once

#include "stopwatch.hpp"

#include <cstddef>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

namespace celltrace::compare {

struct Settings {
  int runs = 5; ///< rounds in which all that is compared takes its turn
  std::vector<unsigned> threads = {1, 2};
  int size = 1024;                ///< pixels a side of models' pictures
  int width = 1280, height = 960; ///< of scene files' pictures
  std::vector<std::size_t> primitives = {10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000};
  double sample_seconds = 0.2; ///< frames are repeated until a sample has lasted that long
  bool processor_clock = false;
  std::filesystem::path models, scenes; ///< folders; without if they do not exist
  std::regex only{""};                  ///< found in "measure/scene" of what is measured

  bool wanted(const std::string& measure, const std::string& scene) const {
    return std::regex_search(measure + "/" + scene, only);
  }
  /// The clock to judge by.
  double operator()(const Seconds& seconds) const {
    return processor_clock ? seconds.processor : seconds.wall;
  }
};

} // namespace celltrace::compare
