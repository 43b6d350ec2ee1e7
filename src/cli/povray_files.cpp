#include "cli/povray_files.hpp"

#include <cstdlib>
#include <fstream>
#include <system_error>

namespace celltrace::cli {
namespace fs = std::filesystem;

namespace {

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string() : value;
}

/// Returns whether a file can be read; a folder can be opened, but not read.
bool can_be_read(const fs::path& file) {
  std::error_code ignored;
  return !fs::is_directory(file, ignored) && std::ifstream(file).is_open();
}

} // namespace

PovrayPlaces povray_places() {
  PovrayPlaces places;
  places.home = environment("HOME");
  places.ini = environment("POVINI");
  places.system_folders = {"/etc/povray/3.7", "/usr/local/etc/povray/3.7"};
  std::error_code ignored;
  const fs::path local = "/usr/local/share/povray-3.7";
  places.installation = fs::is_directory(local, ignored) ? local : "/usr/share/povray-3.7";
  return places;
}

std::optional<fs::path> find_povray_ini(const PovrayPlaces& places, std::vector<std::string>& notes) {
  std::vector<fs::path> candidates = {"./povray.ini"};
  if (!places.ini.empty()) {
    if (can_be_read(places.ini)) return places.ini;
    notes.push_back("POVINI: " + places.ini.string() + " cannot be read");
  }
  if (!places.home.empty()) candidates.push_back(places.home / ".povray/3.7/povray.ini");
  for (const fs::path& folder : places.system_folders)
    candidates.push_back(folder / "povray.ini");
  if (!places.home.empty()) candidates.push_back(places.home / ".povrayrc");
  for (const fs::path& file : candidates)
    if (can_be_read(file)) return file;
  return std::nullopt;
}

} // namespace celltrace::cli
