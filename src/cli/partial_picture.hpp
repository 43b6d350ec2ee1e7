// A picture in memory whose rows are rendered bit by bit, so that it can be kept if rendering is stopped.
#pragma once

#include "celltrace/image.hpp"
#include "celltrace/render.hpp"
#include "cli/picture_rows.hpp"
#include "cli/row_costs.hpp"
#include "cli/rows_file.hpp"

#include <functional>
#include <vector>

namespace celltrace::cli {

/// A picture whose rows count from the top of the rendered region, in blocks of Renderer::kRowStep.
class PartialPicture {
public:
  PartialPicture() = default;
  /// Makes a picture without finished rows.
  explicit PartialPicture(const RenderOptions& options);

  const Image& image() const { return pictures_.image; }
  const ColourImage& colours() const { return pictures_.colours; } ///< empty unless RenderOptions::colours
  /// Returns the first hits; empty unless RenderOptions::first_hits.
  const FirstHits& first_hits() const { return pictures_.first_hits; }
  const BlockImage& blocks() const { return pictures_.blocks; } ///< empty unless RenderOptions::blocks
  int height() const { return region_.bottom - region_.top; }
  bool is_complete() const;
  bool is_empty() const; ///< no block is finished
  int missing_rows() const;
  /// Returns the share of the finished rows in the costs of all rows.
  double finished_share(const RowCosts& costs) const;

  /// A range of rows that are not finished; next() returns the first one.
  struct Rows {
    int top, bottom;
  };
  Rows next() const;
  /// Takes the result of rendering these rows, which may have been stopped; `keeps_parts` says whether pixels
  /// that were reached by then are final.
  void take(const RenderResult& result, const Rows& rows, bool keeps_parts);

  /// Appends the finished rows that are missing in the file.
  void append_to(RowsFile& file) const;
  /// Takes the rows of a file that belong to such a picture.
  void take(RowsFile& file);

private:
  Rows block_rows(std::size_t block) const;
  /// Returns the place of rows of the region in the picture.
  PictureRegion place_of(const Rows& rows) const;

  PictureRegion region_;
  PictureRows pictures_;
  std::vector<bool> finished_; ///< index: block
};

/// Renders the remaining rows of a picture: at once, or on threads of this computer in bands of rows that
/// take some seconds each. Calls `save` after each. The statistics are those of all rows rendered now.
/// `progress` gets shares of the time by `costs`. If it stops the rendering, the result is not complete;
/// image and colours stay empty.
RenderResult render_remaining(Renderer& renderer, const RenderOptions& options, PartialPicture& picture,
                              const RowCosts& costs, const Progress& progress,
                              const std::function<void()>& save);

} // namespace celltrace::cli
