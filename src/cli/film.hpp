// Films: frames one after the other into one file, a pipe, or ffmpeg.
#pragma once

#include "celltrace/image.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace celltrace::cli {

enum class FilmFormat {
  none,  ///< pictures
  y4m,   ///< YUV4MPEG2, uncompressed
  ffmpeg ///< what the program of this name makes of the file's extension
};

/// Frames a second, as a fraction.
struct FrameRate {
  unsigned frames = 25, seconds = 1;
};

/// By the extension, in either case: .y4m; .mp4, .mkv, .mov, .webm.
FilmFormat film_format_of(const std::filesystem::path& path);

/// A film that is being written. A file appears under its name when it is finished, or when a film without
/// its last frames is wanted all the same.
class Film {
public:
  virtual ~Film() = default;
  /// All frames have the same size.
  virtual void add(const Image& frame) = 0;
  virtual void finish() = 0;
};

/// "-" is stdout, for y4m. Throws InputError if the file cannot be written or ffmpeg is not there, as add()
/// and finish() do if something goes wrong later. From then on the process ignores SIGPIPE.
std::unique_ptr<Film> open_film(const std::filesystem::path& path, FilmFormat format, FrameRate rate);

} // namespace celltrace::cli
