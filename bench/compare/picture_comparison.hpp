// celltrace beside POV-Ray on scene files.
#pragma once

#include "report.hpp"
#include "settings.hpp"

#include <filesystem>

namespace celltrace::compare {

/// Adds the figures of a scene file: trace time, whole process, and how alike the pictures are. A scene that
/// one of the two cannot render is noted.
void compare_picture(const std::filesystem::path& scene, const Settings& settings, Report& report);

} // namespace celltrace::compare
