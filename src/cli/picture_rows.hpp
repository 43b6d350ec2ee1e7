// Rows of a picture, in memory and as bytes that are kept for a continued run.
#pragma once

#include "celltrace/image.hpp"
#include "celltrace/render.hpp"

#include <string>
#include <string_view>

namespace celltrace::cli {

/// A picture, or some rows of one, in each requested form; the other forms are empty.
struct PictureRows {
  Image image;
  ColourImage colours;
  FirstHits first_hits;
  BlockImage blocks;
};

/// Moves the pictures out of a result.
PictureRows rows_of(RenderResult&& result);

/// Returns a part of all forms as bytes in this computer's format; of blocks, whole rows of those that begin
/// in the part.
std::string bytes_of(const PictureRows& rows, const PictureRegion& part);
/// Restores a part from bytes_of(). Returns false if the bytes do not belong to such a part, which may be
/// overwritten then.
bool take_bytes(std::string_view bytes, PictureRows& rows, const PictureRegion& part);

/// Returns whether rays have reached all pixels of a part; other pixels have alpha 0.
bool has_all_pixels(const Image& image, const PictureRegion& part);

} // namespace celltrace::cli
