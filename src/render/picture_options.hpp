// Pictures as RenderOptions ask for them, and whether they can be made.
#pragma once

#include "celltrace/render.hpp"

namespace celltrace {

/// Pixels, size and limits: throws InputError for options out of range.
void check(const RenderOptions& options);

/// `options` with what `given` says of pictures: their size and kind, and who hears of them.
RenderOptions with_picture_of(RenderOptions options, const RenderOptions& given);
/// Whether colours leave the SPEs as numbers.
bool brings_colours(const RenderOptions& options);
/// The part of the picture that is rendered.
PictureRegion region_of(const RenderOptions& options);

} // namespace celltrace
