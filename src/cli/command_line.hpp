// What the user asked for: the command line as values.
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

/// As the name of a file.
inline constexpr char kStandardOutput[] = "-";

struct RenderRequest {
  std::filesystem::path scene;
  /// By default the scene's name with .png, in the current folder. Empty: no picture is written. Of an
  /// animation, the name that those of its pictures are made of, or the film. "-": stdout.
  std::filesystem::path output;
  bool makes_folder = false; ///< that of the output, if it is not there
  FilmFormat film = FilmFormat::none;
  FrameRate frame_rate;
  ImageFormat format = ImageFormat::png; ///< of pictures
  FileOptions file;                      ///< how pictures are stored; its format is the one above
  int bits = 8; ///< a channel of the picture: 8 or 16, of OpenEXR 16 or 32, of Radiance's and blocks 8
  RenderOptions options;
  std::vector<std::filesystem::path> library_paths;
  std::vector<std::filesystem::path> readable_folders, writable_folders; ///< of the scene
  ParseLimits limits;
  double most_seconds = 0; ///< of building and rendering, in animations of reading, too; 0: no limit
  std::vector<std::pair<std::string, std::string>> declares; ///< name and value
  bool is_sandboxed = false;                                 ///< opens nothing but what the options name
  bool lenient = false;                                      ///< leave out what of the scene is not supported
  std::filesystem::path header;                              ///< included before the scene; empty: none
  std::optional<double> language_version;                    ///< of a scene that does not say its own
  std::optional<double> clock;                               ///< of a still picture; none: 0, and not on
  Animation animation;
  bool resume = false;               ///< a run that was stopped goes on
  std::string stats;                 ///< file, "-" for stdout, empty for none
  std::filesystem::path trace;       ///< empty: none
  std::filesystem::path cache_trace; ///< empty: none
  bool quiet = false;
  std::optional<bool> verbose;       ///< progress for a program that reads stderr; none: not said
  bool stands_in_for_povray = false; ///< another program takes this one for povray
  std::vector<std::string> notes;    ///< for people
  MessageRequest messages;
};

struct CompareRequest {
  std::filesystem::path a;
  std::filesystem::path b;
  std::optional<double> min_psnr; ///< dB
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
  MachineConfig machine;       ///< without where output, input, profile and trace go
  std::filesystem::path input; ///< empty: this program's own
  std::string stats;           ///< file, "-" for stdout, empty for none
  std::string profile;         ///< the same; JSON if it ends with .json
  bool profile_all = false;
  bool summary = false;
  std::filesystem::path trace; ///< empty: none
  bool quiet = false;
};

struct ReplayRequest {
  std::filesystem::path trace;
  std::vector<CacheConfig> shapes; ///< none: as recorded
  bool prefetches = true;          ///< false: as if the program had made none
  bool json = false;
};

struct StudyRequest {
  study::StudyOptions options;
  std::filesystem::path out = "."; ///< folder of the files
  bool quiet = false;
};

struct ViewRequest {
  RenderRequest render;        ///< without its output
  std::filesystem::path font;  ///< empty: one of the system's
  std::filesystem::path state; ///< empty: none
  std::vector<std::string> keys;
};

/// Many scenes, each rendered as if alone, and a page with all pictures.
struct BatchRequest {
  std::vector<RenderRequest> renders; ///< no two of them have the same output
  std::filesystem::path folder;       ///< of outputs and page
};

/// A text such as that of --help or --version.
struct InformationRequest {
  std::string text;
  bool is_for_stderr = false; ///< for stdout otherwise
};

using Request = std::variant<RenderRequest, BatchRequest, ViewRequest, CompareRequest, SpuRequest,
                             ReplayRequest, StudyRequest, InformationRequest>;

/// Reads a command line (without the program's name) after translate_pov_switches(). Throws InputError for
/// whatever does not fit, and for what the program is to have and has not yet.
Request parse_command_line(std::vector<std::string> arguments);

} // namespace celltrace::cli
