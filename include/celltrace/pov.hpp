// Reads scenes in the language of POV-Ray 3.7 into a Scene.
//
// Supported: the language itself (directives, macros, loops, strings, arrays, expressions), all cameras
// except mesh cameras, all light sources and light groups, spheres, boxes, planes, discs, cylinders, cones,
// tori, quadrics, superellipsoids, polygons, triangles, meshes, bicubic patches, height fields, prisms, lathes, surfaces of revolution,
// blobs, polynomials, texts, unions, CSG of triangles and
// of all shapes that have an inside (including meshes with inside_vector) with inverse and clipped_by, sky
// spheres, fogs, rainbows, and all textures of texture.hpp: patterns with maps and lists, normals, layers and finishes.
// Other features of POV-Ray may be declared, but are errors if an object of the scene uses them ("'blob' is
// not supported yet"): one error for each feature, all in one message. ParseOptions::lenient leaves such
// features out instead.
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

/// Limits on the resources that reading a scene may use; a scene that exceeds a limit is a SceneError. Any
/// limit may be raised: recursions that would overflow the stack, such as objects inside objects, have fixed
/// limits of their own.
struct ParseLimits {
  std::uint64_t file_bytes = 1u << 30;           ///< bytes of one file, at most 2^31 - 16
  std::uint64_t include_depth = 64;              ///< files open at once
  std::uint64_t macro_depth = 1000;              ///< macro calls open at once
  std::uint64_t nesting = 256;                   ///< brackets open at once
  std::uint64_t loop_iterations = 1'000'000'000; ///< iterations of all #while and #for loops
  std::uint64_t recorded_tokens = 4'000'000;     ///< tokens in macro and loop bodies, 56 bytes each
  std::uint64_t tokens = 50'000'000'000;         ///< tokens read in all, replays included
  std::uint64_t array_elements = 1'200'000;      ///< elements of all arrays at one time, about 100 bytes each
  std::uint64_t list_entries = 32'000'000;       ///< entries of one list, such as a mesh's vertices
  std::uint64_t string_bytes = 1u << 20;         ///< bytes of one string
  std::uint64_t text_bytes = 256u << 20;         ///< bytes of all strings that the scene makes or declares
  /// Bytes of all objects and textures that are declared; placed objects do not count.
  std::uint64_t memory = std::uint64_t{2} << 30;
  std::uint64_t seconds = 600;              ///< seconds of the parsing thread's processor time
  std::uint64_t open_files = 64;            ///< files opened by #fopen at one time
  std::uint64_t written_bytes = 256u << 20; ///< bytes written by #write, to all files
  std::uint64_t objects = 4'000'000;        ///< objects placed in the scene
  std::uint64_t triangles =
      32'000'000; ///< triangles of all meshes; further instances of a mesh count only if they have patterns
  /// Entries of the maps of all textures with patterns; a texture counts each time that it is placed.
  std::uint64_t map_entries = 16'000'000;
};

/// A limit and its name in messages.
struct NamedLimit {
  const char* name; ///< for example "loop-steps"
  std::uint64_t ParseLimits::*limit;
};
/// Returns all limits.
CELLTRACE_EXPORT const std::vector<NamedLimit>& parse_limits();

/// The animation that a scene is a frame of: clock_on, frame_number, initial_frame, final_frame,
/// initial_clock, final_clock and clock_delta. The defaults are POV-Ray's for a still picture.
struct AnimationFrame {
  bool clock_on = false;
  int number = 0;
  int initial_number = 0, final_number = 0;
  double initial_clock = 0, final_clock = 0;
  double clock_delta = 0; ///< difference of the clock between frames
};

enum class FileUse { read, write };

/// The place of an object of a Scene in its text. A CSG is one object, but a plain union is as many objects
/// as it has parts. The strings are valid during the call that passes them.
struct ObjectOrigin {
  std::string_view kind; ///< the language's keyword, for example "sphere"
  /// Declared name of the object, or else of the innermost named object around it; empty: none.
  std::string_view name;
  std::string_view file; ///< file name as in messages
  /// Place of the object's first word, or of the word `object` in front of its name; both from 1.
  std::uint32_t line = 1, column = 1;
  std::string_view placed_file;
  /// Line of the statement that places the object in the scene: the object's own, that of an object around
  /// it, or that of a name that stands for it.
  std::uint32_t placed_line = 1;
};

struct ParseOptions {
  /// Folders in which include files are looked for after the folders of the including file and of the scene;
  /// POV-Ray's installed include folder is always searched last.
  std::vector<std::filesystem::path> library_paths;
  /// Folders that a scene may read from, with everything below, besides the scene's own folder,
  /// `library_paths` and `writable_folders`. Symbolic links are followed before the check.
  std::vector<std::filesystem::path> readable_folders;
  /// Folders that a scene may write files to (#fopen), with everything below. Relative names are relative to
  /// the first of these folders, where files are also looked for first. Empty: the scene may not write.
  std::vector<std::filesystem::path> writable_folders;
  /// Folder that relative file names are relative to: files are looked for here first, and written here.
  /// Empty: the first of writable_folders.
  std::filesystem::path working_folder;
  /// Returns whether the scene may read or write a file outside of the folders above. `file` is absolute and
  /// has no symbolic links; a file to be written need not exist. Called by the parsing thread. Empty: such
  /// files are forbidden.
  std::function<bool(const std::filesystem::path& file, FileUse use)> permits;
  int width = 640;  ///< image_width
  int height = 480; ///< image_height
  double clock = 0;
  AnimationFrame frame;
  /// Version of the language that a #version at the start of the scene would set, above 0 and below 1000.
  /// None: POV-Ray's rules for a scene without #version.
  std::optional<double> version;
  /// POV-Ray's level of quality at which the picture will be rendered (RenderOptions::quality). Below 9
  /// media, photons and radiosity have no effect.
  int quality = 9;
  /// True: unsupported features are left out, with one warning for each, instead of refusing the scene: the
  /// whole object if its type is unsupported, else the feature alone.
  bool lenient = false;
  /// Identifiers declared before the scene starts, as POV-Ray's Declare=name=value does.
  std::vector<std::pair<std::string, std::variant<double, std::string>>> declares;
  /// File that is read before the scene, as POV-Ray's Include_Header; empty: none. It may lie outside of the
  /// folders that the scene may read.
  std::filesystem::path header;
  /// Receives the text of #debug, #render and #statistics unchanged, and "file:line:column: warning: text\n"
  /// for #warning and for features that lenient reading leaves out. Also receives a line "file:line:column:
  /// note: text\n" for each file that is found only by ignoring the case of its name. Called by the parsing
  /// thread.
  std::function<void(std::string_view)> message;
  /// Receives every note, warning and error as a Finding, when it is found. Errors are thrown as well, at the
  /// end of the run. Called by the parsing thread.
  std::function<void(const Finding& finding)> finding;
  /// Provides the application's own files: called with the name by which the scene refers to a file, with
  /// slashes between folders. The returned text is read instead of a file; if nothing is returned, the file
  /// system is searched. Called by the parsing thread.
  std::function<std::optional<std::string>(const std::string& name)> file;
  /// Called again and again with the number of bytes of the scene's own file that have been read, and with
  /// the file's size. Included files and loops do not raise `bytes`, but the calls go on. If it returns
  /// false, reading ends with Cancelled. Called by the parsing thread.
  std::function<bool(std::uint64_t bytes, std::uint64_t total)> progress;
  /// Receives the path of every file of the scene before it is read. Called by the parsing thread.
  std::function<void(const std::filesystem::path& path)> reads_file;
  /// Receives the place in the text of each object when the object is placed in the scene; `object` is the
  /// index in Scene::objects. Called by the parsing thread. Empty: no places are kept.
  std::function<void(Index object, const ObjectOrigin& origin)> places_object;
  ParseLimits limits;
};

/// Reads a scene from a file. Throws SceneError for a fault of the scene: "file:line:column: error: text",
/// followed by a line for every file and macro that the place was reached through. Throws InputError if an
/// option is unusable, Cancelled if `progress` returns false, and OutOfMemory. Exceptions of functions in
/// `options` pass through. Writes to no stream. Safe to call from several threads at once.
CELLTRACE_EXPORT Scene parse_file(const std::filesystem::path& path, const ParseOptions& options = {});

/// Reads a scene from memory as parse_file() does from a file. Messages call the scene `name`; its folder is
/// the current folder.
CELLTRACE_EXPORT Scene parse_string(std::string_view text, const ParseOptions& options = {},
                                    std::string name = "<string>");

/// Returns "file:line:column: severity: text", without line and column if these are 0, and a line for each
/// include and macro on the way there.
CELLTRACE_EXPORT std::string to_text(const Finding& finding);

/// A word that the language reserves; directives include their #.
struct Keyword {
  enum class Support {
    full,
    ignored, ///< accepted, without effect on the picture
    none     ///< an error if an object or the scene uses it
  };
  std::string word;
  Support support;
};

/// Returns all keywords, in alphabetical order.
CELLTRACE_EXPORT std::vector<Keyword> keywords();

} // namespace celltrace
