// Reads scenes in the POV-Ray scene language (POV-Ray 3.7's) into a Scene.
//
// Supported: the language itself (directives, macros, loops, strings, arrays, expressions), all cameras
// but mesh cameras, all light sources and light groups, spheres, boxes, planes, discs, cylinders, cones,
// tori, quadrics, superellipsoids, polygons, triangles, meshes, unions, CSG of triangles and of all that
// have an inside, as meshes with inside_vector do, with inverse and clipped_by, sky spheres, fogs, rainbows,
// and textures of everything that texture.hpp has: patterns with maps and lists, normals, layers, and the
// finish. Whatever else POV-Ray knows may be declared; where an object of the scene uses it, it is an error,
// "'blob' is not supported yet": one for each feature, all in one message. Or they are left out:
// ParseOptions::lenient.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "celltrace/error.hpp"
#include "celltrace/export.hpp"
#include "celltrace/scene.hpp"

namespace celltrace {

/// Bounds on what a scene may cost; passing one is a SceneError. Any may be raised: what has to end for other
/// reasons, such as objects inside objects, has limits of its own.
struct ParseLimits {
  std::uint64_t file_bytes = 1u << 30;           ///< of one file, at most 2^31 - 16
  std::uint64_t include_depth = 64;              ///< files open at once
  std::uint64_t macro_depth = 1000;              ///< macro calls open at once
  std::uint64_t nesting = 256;                   ///< brackets open at once
  std::uint64_t loop_iterations = 1'000'000'000; ///< of all #while and #for loops together
  std::uint64_t recorded_tokens = 4'000'000;     ///< in macro and loop bodies, 56 bytes each
  std::uint64_t tokens = 50'000'000'000;         ///< read in all, replays included
  std::uint64_t array_elements = 1'200'000; ///< of all arrays that there are at a time, about 100 bytes each
  std::uint64_t list_entries = 32'000'000;  ///< of one list, such as a mesh's vertices
  std::uint64_t string_bytes = 1u << 20;    ///< of one string
  std::uint64_t text_bytes = 256u << 20;    ///< of all strings made or declared
  std::uint64_t memory = std::uint64_t{2} << 30; ///< bytes of all objects and textures declared, not placed
  std::uint64_t seconds = 600;                   ///< of the parsing thread's processor time
  std::uint64_t open_files = 64;                 ///< by #fopen, at a time
  std::uint64_t written_bytes = 256u << 20;      ///< by #write, to all files
  std::uint64_t objects = 4'000'000;             ///< placed in the scene
  std::uint64_t triangles =
      32'000'000; ///< of all meshes, an instance not counted again unless it has patterns
  std::uint64_t map_entries = 16'000'000; ///< of all textures with patterns, as often as they are placed
};

/// A limit by the name that messages give it.
struct NamedLimit {
  const char* name; ///< as "loop-steps"
  std::uint64_t ParseLimits::*limit;
};
/// All of them.
CELLTRACE_EXPORT const std::vector<NamedLimit>& parse_limits();

/// What a scene knows of the animation that it is a frame of: clock_on, frame_number, initial_frame,
/// final_frame, initial_clock, final_clock and clock_delta. By default as POV-Ray has them for a still
/// picture.
struct AnimationFrame {
  bool clock_on = false;
  int number = 0;
  int initial_number = 0, final_number = 0;
  double initial_clock = 0, final_clock = 0;
  double clock_delta = 0; ///< from frame to frame
};

enum class FileUse { read, write };

/// Where an object of a Scene stands in its text. CSG is one object, but for unions that are no more than
/// their parts. The strings last as long as the call that has them.
struct ObjectOrigin {
  std::string_view kind; ///< the language's word, as "sphere"
  std::string_view name; ///< that it, or else the innermost object around it, was declared with; empty: none
  std::string_view file; ///< as messages name it
  std::uint32_t line = 1, column = 1; ///< of its first word, or of the `object` that refers to it, from 1
  std::string_view placed_file;
  std::uint32_t placed_line = 1; ///< of what places it in the scene: itself, what it is part of, or a name
};

struct ParseOptions {
  /// Searched for include files after the including file's folder and the scene's; POV-Ray's installed
  /// include folder comes last by itself.
  std::vector<std::filesystem::path> library_paths;
  /// A scene reads files only from its own folder, those above and these, and what is below them, wherever
  /// links lead.
  std::vector<std::filesystem::path> readable_folders;
  /// It writes files (#fopen) only in these and below. Names that are not absolute begin in the first one,
  /// which is also the first place where files are looked for. None: it writes nothing.
  std::vector<std::filesystem::path> writable_folders;
  /// Folder where names of files that are not absolute begin: the first place where files are looked for,
  /// and where they are written. Empty: the first of writable_folders.
  std::filesystem::path working_folder;
  /// Asked, from the parsing thread, whether the scene may read or write a file that the folders above do not
  /// let it. `file` is absolute and has no links, but need not exist if it is to be written. None: no.
  std::function<bool(const std::filesystem::path& file, FileUse use)> permits;
  int width = 640;  ///< image_width
  int height = 480; ///< image_height
  double clock = 0;
  AnimationFrame frame;
  /// Of the language, above 0 and below 1000: as if the scene began with #version. None: POV-Ray's rules for
  /// a scene without.
  std::optional<double> version;
  /// POV-Ray's level of quality at which the picture will be rendered (RenderOptions::quality): below 9
  /// media, photons and radiosity mean nothing.
  int quality = 9;
  /// Leaves out what is not supported, objects as a whole and else the feature, with one warning for each
  /// feature, instead of refusing the scene.
  bool lenient = false;
  /// Identifiers declared before the scene starts, as POV-Ray's Declare=name=value does.
  std::vector<std::pair<std::string, std::variant<double, std::string>>> declares;
  /// File that is read before the scene, as POV-Ray's Include_Header is; empty: none. It need not lie where
  /// the scene may read.
  std::filesystem::path header;
  /// Receives the text of #debug, #render and #statistics as it is, and "file:line:column: warning: text\n"
  /// for #warning, for what lenient reading leaves out and, with "note", for files found by another case of
  /// their names. Called by the parsing thread.
  std::function<void(std::string_view)> message;
  /// Hears of every note, warning and error as data, when it is found, from the parsing thread. Errors are
  /// thrown as well, at the end of the run.
  std::function<void(const Finding& finding)> finding;
  /// The application's own files: asked, from the parsing thread, for each file that a scene reads, by the
  /// name that the scene gives it, with slashes between folders. Its text is taken in place of a file's;
  /// nothing: the file system is searched.
  std::function<std::optional<std::string>(const std::string& name)> file;
  /// Hears again and again, from the parsing thread, how many bytes of the scene's own file have been read,
  /// and of how many. Neither included files nor loops move it on, but it is called while they are read. If
  /// it returns false, reading ends with Cancelled.
  std::function<bool(std::uint64_t bytes, std::uint64_t total)> progress;
  /// Hears of every file of the scene, from the parsing thread, when it is about to be read.
  std::function<void(const std::filesystem::path& path)> reads_file;
  /// Hears where each object of the scene comes from, from the parsing thread, when it is placed; `object` is
  /// its index in Scene::objects. None: nothing of that is kept.
  std::function<void(Index object, const ObjectOrigin& origin)> places_object;
  ParseLimits limits;
};

/// Throws SceneError for a fault of the scene: "file:line:column: error: text", followed by a line for every
/// file and macro the place was reached through. InputError if an option is unusable, Cancelled if `progress`
/// asked for it, OutOfMemory. What functions of `options` throw passes through. Writes nothing to any stream.
/// Safe to call from several threads at once.
CELLTRACE_EXPORT Scene parse_file(const std::filesystem::path& path, const ParseOptions& options = {});

/// The same for a scene in memory. `name` stands in messages; includes are looked for from the current
/// folder.
CELLTRACE_EXPORT Scene parse_string(std::string_view text, const ParseOptions& options = {},
                                    std::string name = "<string>");

/// "file:line:column: severity: text", without line and column if these are 0, and a line for each place that
/// it was reached by.
CELLTRACE_EXPORT std::string to_text(const Finding& finding);

/// A word that the language reserves; directives with their #.
struct Keyword {
  enum class Support {
    full,
    ignored, ///< read, and without effect on the picture
    none     ///< an error where an object or the scene uses it
  };
  std::string word;
  Support support;
};

/// All of them, in alphabetical order.
CELLTRACE_EXPORT std::vector<Keyword> keywords();

} // namespace celltrace
