// Films: writes frames one after the other to a file, a pipe, or ffmpeg.
#pragma once

#include "celltrace/image.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace celltrace::cli {

enum class FilmFormat {
  none,  ///< separate pictures
  y4m,   ///< YUV4MPEG2, uncompressed
  ffmpeg ///< written by the program ffmpeg, in the format of the file's extension
};

/// The number of frames per second, as a fraction.
struct FrameRate {
  unsigned frames = 25, seconds = 1;
};

/// Returns the format by the extension, in either case: .y4m; .mp4, .mkv, .mov, .webm.
FilmFormat film_format_of(const std::filesystem::path& path);

/// A film that is being written. The file gets its name in finish(), which can also be called for a film
/// without its last frames.
class Film {
public:
  virtual ~Film() = default;
  /// Adds a frame; all frames have the same size.
  virtual void add(const Image& frame) = 0;
  virtual void finish() = 0;
};

/// Opens a film; "-" is stdout, for y4m. Throws InputError if the file cannot be written or ffmpeg is
/// missing, as add() and finish() do for later errors. The process ignores SIGPIPE from then on.
std::unique_ptr<Film> open_film(const std::filesystem::path& path, FilmFormat format, FrameRate rate);

} // namespace celltrace::cli
