// The command line as values.
#pragma once

#include "celltrace/image.hpp"
#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "cli/film.hpp"
#include "cli/frame_numbers.hpp"
#include "cli/message_files.hpp"
#include "study/study.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace celltrace::cli {

/// The file name that stands for stdout.
inline constexpr char kStandardOutput[] = "-";

struct RenderRequest {
  std::filesystem::path scene;
  /// The file for the picture; by default the scene's name with .png, in the current folder. Empty: no
  /// picture is written. In an animation, the name from which those of its pictures are derived, or the film.
  /// "-": stdout.
  std::filesystem::path output;
  bool makes_folder = false; ///< creates the output's folder if it is missing
  FilmFormat film = FilmFormat::none;
  FrameRate frame_rate;
  ImageFormat format = ImageFormat::png; ///< format of pictures
  FileOptions file;                      ///< how pictures are stored; file.format equals `format`
  int bits = 8; ///< per channel of the picture: 8 or 16; OpenEXR 16 or 32; Radiance and blocks 8
  RenderOptions options;
  std::vector<std::filesystem::path> library_paths;
  std::vector<std::filesystem::path> readable_folders,
      writable_folders; ///< folders where the scene may read and write files
  ParseLimits limits;
  double most_seconds = 0; ///< limit on building and rendering, in animations also on reading; 0: none
  std::vector<std::pair<std::string, std::string>> declares; ///< name and value
  bool is_sandboxed = false;                                 ///< opens only files that the options name
  bool lenient = false;                                      ///< leaves unsupported features out
  std::filesystem::path header;                              ///< included before the scene; empty: none
  std::optional<double> language_version; ///< version for a scene that does not set its own
  std::optional<double> clock; ///< clock of a still picture; none: the clock is 0, and clock_on is false
  Animation animation;
  bool resume = false;               ///< continues a run that was stopped
  std::string stats;                 ///< file, "-" for stdout, empty for none
  std::filesystem::path trace;       ///< empty: none
  std::filesystem::path cache_trace; ///< empty: none
  bool quiet = false;
  std::optional<bool> verbose;       ///< progress for a program that reads stderr; none: the default
  bool stands_in_for_povray = false; ///< another program started this one as povray
  std::vector<std::string> notes;    ///< messages for the user
  MessageRequest messages;
};

struct CompareRequest {
  std::filesystem::path a;
  std::filesystem::path b;
  std::optional<double> min_psnr; ///< in dB
  std::optional<double> min_ssim;
  std::filesystem::path difference; ///< empty: none
  bool json = false;
};

struct SpuRequest {
  SpuRequest() {
    machine.backend = Backend::cell_sim;
    machine.spes = 1;
  }

  std::filesystem::path program;
  MachineConfig machine;       ///< without its output, input, profile and trace
  std::filesystem::path input; ///< empty: stdin of this program
  std::string stats;           ///< file, "-" for stdout, empty for none
  std::string profile;         ///< file, "-" for stdout, empty for none; JSON if it ends with .json
  bool profile_all = false;
  bool summary = false;
  std::filesystem::path trace; ///< empty: none
  bool quiet = false;
};

struct ReplayRequest {
  std::filesystem::path trace;
  std::vector<CacheConfig> shapes; ///< none: the recorded ones
  bool prefetches = true;          ///< false: replays as if the program had prefetched nothing
  bool json = false;
};

struct StudyRequest {
  study::StudyOptions options;
  std::filesystem::path out = "."; ///< folder for the files
  bool quiet = false;
};

struct ViewRequest {
  RenderRequest render;        ///< without its output
  std::filesystem::path font;  ///< empty: a font of the system
  std::filesystem::path state; ///< empty: none
  std::vector<std::string> keys;
};

/// A request for many scenes, each rendered as if alone, and a page with all pictures.
struct BatchRequest {
  std::vector<RenderRequest> renders; ///< renders with distinct outputs
  std::filesystem::path folder;       ///< folder for outputs and page
};

/// A request for a text such as that of --help or --version.
struct InformationRequest {
  std::string text;
  bool is_for_stderr = false; ///< otherwise for stdout
};

using Request = std::variant<RenderRequest, BatchRequest, ViewRequest, CompareRequest, SpuRequest,
                             ReplayRequest, StudyRequest, InformationRequest>;

/// Reads a command line (without the program's name) after translate_pov_switches(). Throws InputError for
/// arguments that are not valid, and for planned features that are missing.
Request parse_command_line(std::vector<std::string> arguments);

} // namespace celltrace::cli
