#include "cli/used_files.hpp"

#include "celltrace/error.hpp"
#include "image/file.hpp"

#include <compare>
#include <csignal>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

namespace celltrace::cli {
namespace fs = std::filesystem;

namespace {

/// The identity of a file, whatever its name.
struct Identity {
  dev_t device = 0;
  ino_t file = 0;
  fs::path path; ///< used if the file does not exist yet

  auto operator<=>(const Identity&) const = default;
};

/// Returns the identity; nothing for a device, which may stand for any number of files.
std::optional<Identity> identity_of(const fs::path& path) {
  struct stat status;
  const bool is_there =
      path == kStandardOutput ? fstat(STDOUT_FILENO, &status) == 0 : stat(path.c_str(), &status) == 0;
  if (!is_there) return Identity{0, 0, image::follow_links(fs::absolute(path))};
  if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)) return {};
  return Identity{status.st_dev, status.st_ino, {}};
}

struct UsedFile {
  std::string what;
  fs::path path;
};

/// A set of files by identity.
class UsedFiles {
public:
  /// Adds a file. Returns the file with the same identity if there is one already, which is kept instead.
  std::optional<UsedFile> add(const std::string& what, const fs::path& path) {
    const auto identity = identity_of(path);
    if (!identity) return {};
    const auto [first, is_new] = files_.emplace(*identity, UsedFile{what, path});
    if (is_new) return {};
    return first->second;
  }

private:
  std::map<Identity, UsedFile> files_;
};

std::string conflict(const UsedFile& file, const UsedFile& other) {
  const std::string names =
      file.path == other.path ? file.path.string() : file.path.string() + " is " + other.path.string();
  return names + ": " + other.what + " and " + file.what + " cannot be the same file";
}

std::vector<fs::path> pictures_of(const RenderRequest& request) {
  if (request.output.empty()) return {};
  if (!request.animation.is_on() || request.film != FilmFormat::none) return {request.output};
  std::vector<fs::path> pictures;
  for (const int frame : frames_to_render(request.animation))
    pictures.push_back(picture_of(request.output, request.animation, frame));
  return pictures;
}

void prepare_report(const fs::path& path) {
  if (path == kStandardOutput) return;
  if (image::is_stream(path)) std::signal(SIGPIPE, SIG_IGN);
  try {
    image::check_output(path);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

} // namespace

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string() + ": cannot be made: " + error.message());
}

bool prepare_outputs(RenderRequest& request) {
  if (request.makes_folder && !request.output.empty()) make_folder(request.output.parent_path());
  if (request.output == kStandardOutput || (!request.output.empty() && image::is_stream(request.output)))
    std::signal(SIGPIPE, SIG_IGN);
  fs::path stats = request.stats;
  const std::pair<const char*, fs::path*> reports[] = {
      {"the statistics", &stats}, {"the trace", &request.trace}, {"the cache trace", &request.cache_trace}};
  if (stats.empty() && request.trace.empty() && request.cache_trace.empty()) return true;
  UsedFiles pictures, others;
  for (const fs::path& picture : pictures_of(request))
    pictures.add("the picture", picture);
  others.add("the scene", request.scene);
  bool has_all = true;
  for (const auto& [what, path] : reports) {
    if (path->empty()) continue;
    if (const auto picture = pictures.add(what, *path); picture && picture->what == "the picture") {
      std::cerr << "celltrace: error: " << conflict({what, *path}, *picture) << ": " << what
                << " will not be written\n";
      path->clear();
      has_all = false;
      continue;
    }
    if (const auto other = others.add(what, *path)) throw InputError(conflict({what, *path}, *other));
    prepare_report(*path);
  }
  request.stats = stats.string();
  return has_all;
}

} // namespace celltrace::cli
