// A picture in memory whose rows are rendered bit by bit, and what is kept of one that is stopped in between.
#pragma once

#include "celltrace/image.hpp"
#include "celltrace/render.hpp"
#include "cli/picture_rows.hpp"
#include "cli/row_costs.hpp"
#include "cli/rows_file.hpp"

#include <functional>
#include <vector>

namespace celltrace::cli {

/// Rows count from the top of the region that is rendered, in blocks of Renderer::kRowStep.
class PartialPicture {
public:
  PartialPicture() = default;
  /// Nothing is finished.
  explicit PartialPicture(const RenderOptions& options);

  const Image& image() const { return pictures_.image; }
  const ColourImage& colours() const { return pictures_.colours; } ///< empty unless RenderOptions::colours
  /// Empty unless RenderOptions::first_hits.
  const FirstHits& first_hits() const { return pictures_.first_hits; }
  const BlockImage& blocks() const { return pictures_.blocks; } ///< empty unless RenderOptions::blocks
  int height() const { return region_.bottom - region_.top; }
  bool is_complete() const;
  bool is_empty() const; ///< not a single block is finished
  int missing_rows() const;
  /// The share of all that rows take that the finished ones have taken.
  double finished_share(const RowCosts& costs) const;

  /// The first rows that are not finished, as many as follow each other.
  struct Rows {
    int top, bottom;
  };
  Rows next() const;
  /// What a render of these rows brought, which may have been broken off: `keeps_parts` says whether pixels
  /// that were reached then stay as they are.
  void take(const RenderResult& result, const Rows& rows, bool keeps_parts);

  /// Appends the finished rows that are not in the file yet.
  void append_to(RowsFile& file) const;
  /// Takes the rows of a file that are those of such a picture.
  void take(RowsFile& file);

private:
  Rows block_rows(std::size_t block) const;
  /// Where rows of the region are in the picture.
  PictureRegion place_of(const Rows& rows) const;

  PictureRegion region_;
  PictureRows pictures_;
  std::vector<bool> finished_; ///< by block
};

/// What remains of a picture is rendered: at once, or on threads of this computer in bands of rows that take
/// some seconds each. After each `save` is called. The statistics are of all that was rendered now.
/// `progress` hears of shares of the time by `costs`. Where it breaks off, the result is not complete; image
/// and colours stay empty.
RenderResult render_remaining(Renderer& renderer, const RenderOptions& options, PartialPicture& picture,
                              const RowCosts& costs, const Progress& progress,
                              const std::function<void()>& save);

} // namespace celltrace::cli
