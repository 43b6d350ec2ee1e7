// Scenes named on a benchmark's command line, or some of the project's own.
#pragma once

#include <filesystem>
#include <vector>

/// What is left of the arguments after benchmark::Initialize(); without any, three files of the folder `own`.
inline std::vector<std::filesystem::path> scene_arguments(int argc, char** argv,
                                                          const std::filesystem::path& own) {
  if (argc == 1) return {own / "finishes.pov", own / "glass.pov", own / "mesh.pov"};
  return {argv + 1, argv + argc};
}
