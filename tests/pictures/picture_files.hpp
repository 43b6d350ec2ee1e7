// Scene files to render.
#pragma once

#include <filesystem>
#include <vector>

namespace celltrace::test {

/// The .pov files of a folder in the order of their names; empty if there is no such folder.
std::vector<std::filesystem::path> scenes_in(const std::filesystem::path& folder);

} // namespace celltrace::test
