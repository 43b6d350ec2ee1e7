// Scene files with POV-Ray's picture of each.
#pragma once

#include "celltrace/image.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace celltrace::test {

/// The .pov files of a folder in the order of their names; empty if there is no such folder.
std::vector<std::filesystem::path> scenes_in(const std::filesystem::path& folder);

/// POV-Ray's picture of a scene, 640x480 and not antialiased: the .png beside it, or one rendered now where
/// POV-Ray is installed; none otherwise.
std::optional<Image> pov_ray_picture(const std::filesystem::path& scene);

} // namespace celltrace::test
