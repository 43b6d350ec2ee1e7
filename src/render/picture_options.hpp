// Checks of the pictures that RenderOptions ask for.
#pragma once

#include "celltrace/render.hpp"

namespace celltrace {

/// Checks pixels, size and limits. Throws InputError for options out of range.
void check(const RenderOptions& options);

/// Returns `options` with the picture of `given`: its size, its kind and the function that is told of its
/// blocks.
RenderOptions with_picture_of(RenderOptions options, const RenderOptions& given);
/// Returns whether the SPEs write colours as numbers.
bool brings_colours(const RenderOptions& options);
PictureRegion region_of(const RenderOptions& options);

} // namespace celltrace
