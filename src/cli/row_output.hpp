// Writes a picture while it is rendered: to a file, which gets its name at the end, or to a stream.
#pragma once

#include "cli/command_line.hpp"
#include "cli/picture_rows.hpp"
#include "image/file.hpp"
#include "image/row_writer.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

namespace celltrace::cli {

/// A picture file or stream that takes the rows of the region from the top on; pixels around the region are
/// blank: black, or transparent in pictures with alpha. Errors are InputErrors with the name of the file.
class RowOutput {
public:
  /// Opens the file, or nothing if `path` is empty. Rows above the region are written with the first ones.
  RowOutput(const RenderRequest& request, const std::filesystem::path& path);

  /// Appends all of `rows`, which are as wide as the region.
  void write(const PictureRows& rows);
  void write_blank(int count);
  /// Writes the rows below the region; then a file gets its name.
  void finish();

private:
  template <class Work> void naming_the_file(Work work);
  void open(const std::optional<double>& gamma);
  void put(const PictureRows& rows);
  void put_blank(int count);
  void make_blank_row();

  const RenderRequest& request_;
  std::filesystem::path path_;
  PictureRegion region_;
  std::optional<image::OutputFile> file_; ///< none: stdout, or no output
  std::FILE* stream_ = nullptr;           ///< null: no output
  bool flows_ = false;                    ///< rows should arrive at once
  std::unique_ptr<image::RowWriter> writer_;
  PictureRows blank_; ///< one row
};

} // namespace celltrace::cli
