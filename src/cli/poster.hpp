// Renders pictures that are never completely in memory: finished bands of rows are written and freed.
#pragma once

#include "celltrace/render.hpp"
#include "cli/command_line.hpp"
#include "cli/picture_job.hpp"
#include "cli/rows_file.hpp"

#include <filesystem>

namespace celltrace::cli {

/// Chooses RenderOptions::rows_at_once for a picture that is large, or is read while it is rendered. Returns
/// 0 for others, which are completely in memory. Films, surfaces in blocks and models other than `shared`
/// always are: throws InputError if they are too large for that.
int rows_at_once(const RenderRequest& request);

/// Renders as render_picture() does, but band by band.
PictureOutcome render_poster(Renderer& renderer, const RenderRequest& request,
                             const std::filesystem::path& path, RowsFile& kept, const RowCosts& costs,
                             const Progress& progress);

} // namespace celltrace::cli
