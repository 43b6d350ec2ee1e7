// Pictures that are never in memory whole: bands of rows go out when they are finished, and are forgotten.
#pragma once

#include "celltrace/render.hpp"
#include "cli/command_line.hpp"
#include "cli/picture_job.hpp"
#include "cli/rows_file.hpp"

#include <filesystem>

namespace celltrace::cli {

/// Chooses RenderOptions::rows_at_once for a picture that is large, or that somebody reads while it is
/// rendered. Returns 0 for others, which are in memory whole. Films, surfaces in blocks and models other than
/// `shared` are always: throws InputError if they are too large for that.
int rows_at_once(const RenderRequest& request);

/// Does what render_picture() does, band by band.
PictureOutcome render_poster(Renderer& renderer, const RenderRequest& request,
                             const std::filesystem::path& path, RowsFile& kept, const RowCosts& costs,
                             const Progress& progress);

} // namespace celltrace::cli
