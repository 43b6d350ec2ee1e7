// A picture whose rows are rendered bit by bit, and what is kept of one that is stopped in between.
#pragma once

#include "celltrace/image.hpp"
#include "celltrace/render.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

/// Rows count from the top of the region that is rendered, in blocks of Renderer::kRowStep.
class PartialPicture {
public:
  PartialPicture() = default;
  /// Nothing is finished.
  explicit PartialPicture(const RenderOptions& options);

  const Image& image() const { return image_; }
  const ColourImage& colours() const { return colours_; }     ///< empty unless RenderOptions::colours
  const FirstHits& first_hits() const { return first_hits_; } ///< empty unless RenderOptions::first_hits
  const BlockImage& blocks() const { return blocks_; }        ///< empty unless RenderOptions::blocks
  int height() const { return region_.bottom - region_.top; }
  bool is_complete() const;
  bool is_empty() const; ///< not a single block is finished
  int missing_rows() const;

  /// The first rows that are not finished, as many as follow each other.
  struct Rows {
    int top, bottom;
  };
  Rows next() const;
  /// What a render of these rows brought, which may have been broken off: `keeps_parts` says whether pixels
  /// that were reached then stay as they are.
  void take(const RenderResult& result, const Rows& rows, bool keeps_parts);

  /// The finished rows, as bytes that this computer understands.
  std::string to_bytes() const;
  /// False, and nothing happens: they are not those of such a picture.
  bool take_bytes(std::string_view bytes);

private:
  Rows block_rows(std::size_t block) const;
  bool has_all_pixels(const Image& image, const Rows& rows) const;

  PictureRegion region_;
  Image image_;
  ColourImage colours_;
  FirstHits first_hits_;
  BlockImage blocks_;
  std::vector<bool> finished_; ///< by block
};

/// What remains of a picture is rendered: at once, or on threads of this computer in bands of rows that take
/// some seconds each. After each `save` is called. The statistics are of all that was rendered now. Where
/// `progress` breaks it off, the result is not complete; image and colours stay empty.
RenderResult render_remaining(Renderer& renderer, const RenderOptions& options, PartialPicture& picture,
                              const Progress& progress, const std::function<void()>& save);

} // namespace celltrace::cli
