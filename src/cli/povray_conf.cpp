#include "cli/povray_conf.hpp"

#include "celltrace/error.hpp"
#include "cli/blanks.hpp"
#include "cli/ini_file.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <system_error>

namespace celltrace::cli {
namespace fs = std::filesystem;

namespace {

/// The permissions on a system without POV-Ray.
constexpr std::string_view kDefaultConf = "[File I/O Security]\n"
                                          "restricted\n"
                                          "[Permitted Paths]\n"
                                          "read* = %INSTALLDIR%/include\n"
                                          "read* = /usr/share/doc/povray/examples\n"
                                          "read* = /etc/povray\n"
                                          "read* = %HOME%\n"
                                          "read+write* = /tmp\n"
                                          "read+write = .\n";

struct Permission {
  std::string_view name;
  bool with_folders_below, may_be_written;
};
constexpr Permission kPermissions[] = {
    {"read", false, false}, {"read*", true, false}, {"read+write", false, true}, {"read+write*", true, true}};

struct SecurityName {
  std::string_view name;
  FileSecurity security;
};
constexpr SecurityName kSecurities[] = {{"none", FileSecurity::none},
                                        {"read-only", FileSecurity::read_only},
                                        {"restricted", FileSecurity::restricted}};

/// Returns a line without its comment, which begins with a semicolon outside of quotes.
std::string_view without_comment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0)
      quote = c == quote ? char{0} : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == ';')
      return line.substr(0, i);
  }
  return line;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

class ConfReader {
public:
  ConfReader(const std::string& name, const PovrayPlaces& places, std::vector<std::string>& warnings)
      : name_(name), places_(places), warnings_(warnings) {}

  PovrayConf read(std::string_view text) {
    for (line_ = 1; !text.empty(); ++line_) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view line = trimmed(without_comment(text.substr(0, end)));
      text.remove_prefix(std::min(end + 1, text.size()));
      if (!line.empty()) entry(line);
    }
    if (security_) conf_.security = *security_;
    return std::move(conf_);
  }

private:
  enum class Section { files, shell, paths, unknown };

  void entry(std::string_view line) {
    if (line[0] == '[') return section(line);
    switch (section_) {
    case Section::files:
      return security(line);
    case Section::paths:
      return path(line);
    case Section::shell: // this program runs no commands
    case Section::unknown:
      return;
    }
  }

  void section(std::string_view line) {
    const std::size_t end = line.find(']');
    const std::string name =
        end == line.npos ? std::string() : lower(trimmed(line.substr(1, end == 0 ? 0 : end - 1)));
    section_ = name == "file i/o security"   ? Section::files
               : name == "shellout security" ? Section::shell
               : name == "permitted paths"   ? Section::paths
                                             : Section::unknown;
    if (section_ == Section::unknown) warn("there is no such section; its lines are left out");
  }

  void security(std::string_view line) {
    const std::string value = lower(line);
    const auto* const known = std::find_if(std::begin(kSecurities), std::end(kSecurities),
                                           [&](const SecurityName& each) { return each.name == value; });
    if (known == std::end(kSecurities))
      warn("'" + std::string(line) + "' is none of none, read-only and restricted: files are restricted");
    const FileSecurity wanted = known == std::end(kSecurities) ? FileSecurity::restricted : known->security;
    security_ = std::max(security_.value_or(wanted), wanted);
  }

  void path(std::string_view line) {
    const std::size_t equals = line.find('=');
    std::string name(line.substr(0, equals));
    name.erase(std::remove_if(name.begin(), name.end(), is_blank), name.end());
    const auto* const known = std::find_if(std::begin(kPermissions), std::end(kPermissions),
                                           [&](const Permission& each) { return each.name == name; });
    if (equals == line.npos || known == std::end(kPermissions))
      return warn("'" + std::string(line) + "' is no read, read*, read+write or read+write* = FOLDER");
    const std::optional<std::string> folder = folder_of(trimmed(line.substr(equals + 1)));
    if (!folder) return;
    std::error_code error;
    const fs::path canonical = fs::canonical(*folder, error);
    if (error || !fs::is_directory(canonical, error)) return;
    conf_.folders.push_back({canonical, known->with_folders_below, known->may_be_written});
  }

  /// Returns a folder; nothing, after a warning, if the value names no folder, or an ambiguous one.
  std::optional<std::string> folder_of(std::string_view value) {
    if (!value.empty() && (value[0] == '"' || value[0] == '\'')) {
      const std::size_t end = value.find(value[0], 1);
      if (end == value.npos) return refuse("a quote is not closed");
      if (end + 1 != value.size()) return refuse("something follows the folder");
      value = value.substr(1, end - 1);
    } else if (std::any_of(value.begin(), value.end(), is_blank)) {
      return refuse("a folder whose name has blanks has to be in quotes");
    }
    std::string folder(value);
    if (!expand(folder, "%INSTALLDIR%", places_.installation) || !expand(folder, "%HOME%", places_.home))
      return std::nullopt; // refers to a place that does not exist
    if (folder.empty()) return refuse("the folder is missing");
    return folder;
  }

  /// Expands a word; returns false if the folder refers to a place that does not exist.
  static bool expand(std::string& folder, std::string_view word, const fs::path& place) {
    const std::size_t at = folder.find(word);
    if (at == folder.npos) return true;
    folder.replace(at, word.size(), place.string());
    return !place.empty();
  }

  std::nullopt_t refuse(const char* text) {
    warn(text);
    return std::nullopt;
  }
  void warn(const std::string& text) {
    warnings_.push_back(name_ + ':' + std::to_string(line_) + ": " + text);
  }

  const std::string& name_;
  const PovrayPlaces& places_;
  std::vector<std::string>& warnings_;
  PovrayConf conf_;
  std::optional<FileSecurity> security_;
  Section section_ = Section::unknown;
  int line_ = 0;
};

/// Returns the contents of a file; nothing if there is no such file.
std::optional<PovrayConf> read_conf(const fs::path& file, const PovrayPlaces& places,
                                    std::vector<std::string>& warnings) {
  std::error_code error;
  if (fs::status(file, error).type() == fs::file_type::not_found) return std::nullopt;
  std::string text;
  try {
    text = read_ini_text(file.string());
  } catch (const InputError& unreadable) {
    warnings.push_back(unreadable.what());
    return PovrayConf();
  }
  return parse_povray_conf(text, file.string(), places, warnings);
}

} // namespace

bool PovrayConf::permits(const fs::path& file, FileUse use) const {
  if (security == FileSecurity::none || (security == FileSecurity::read_only && use == FileUse::read))
    return true;
  return std::any_of(folders.begin(), folders.end(), [&](const PermittedFolder& each) {
    if (use == FileUse::write && !each.may_be_written) return false;
    if (!each.with_folders_below) return file.parent_path() == each.folder;
    const fs::path& folder = each.folder;
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
  });
}

PovrayConf parse_povray_conf(std::string_view text, const std::string& name, const PovrayPlaces& places,
                             std::vector<std::string>& warnings) {
  return ConfReader(name, places, warnings).read(text);
}

std::vector<PovrayConf> read_povray_confs(const PovrayPlaces& places, std::vector<std::string>& warnings) {
  std::vector<PovrayConf> confs;
  for (const fs::path& folder : places.system_folders)
    if (std::optional<PovrayConf> system = read_conf(folder / "povray.conf", places, warnings)) {
      confs.push_back(std::move(*system));
      break;
    }
  if (!places.home.empty())
    if (std::optional<PovrayConf> own = read_conf(places.home / ".povray/3.7/povray.conf", places, warnings))
      confs.push_back(std::move(*own));
  if (confs.empty()) confs.push_back(parse_povray_conf(kDefaultConf, "povray.conf", places, warnings));
  return confs;
}

} // namespace celltrace::cli
