// Rows of a picture in memory, and as bytes that are kept for a run that goes on.
#pragma once

#include "celltrace/image.hpp"
#include "celltrace/render.hpp"

#include <string>
#include <string_view>

namespace celltrace::cli {

/// A picture, or some rows of one, in each of the forms that are wanted; the others are empty.
struct PictureRows {
  Image image;
  ColourImage colours;
  FirstHits first_hits;
  BlockImage blocks;
};

/// Moves the pictures out of a result.
PictureRows rows_of(RenderResult&& result);

/// Returns a part of all forms as bytes that this computer understands; of blocks, whole rows of those that
/// begin in the part.
std::string bytes_of(const PictureRows& rows, const PictureRegion& part);
/// Puts back what bytes_of() gave. Returns false if these are not the bytes of such a part; it may have
/// changed then.
bool take_bytes(std::string_view bytes, PictureRows& rows, const PictureRegion& part);

/// Returns whether rays have reached all pixels of a part: where none has, alpha is 0.
bool has_all_pixels(const Image& image, const PictureRegion& part);

} // namespace celltrace::cli
