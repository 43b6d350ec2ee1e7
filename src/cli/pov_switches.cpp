#include "cli/pov_switches.hpp"

#include "celltrace/error.hpp"
#include "cli/pov_faults.hpp"

#include <filesystem>
#include <optional>

namespace celltrace::cli {

namespace {

/// An error with the place in an INI file.
class PlacedError : public InputError {
public:
  using InputError::InputError;
};

bool is_own_option(std::string_view argument) {
  for (const std::string_view own : {"-o", "-W", "-H", "-L", "-h"})
    if (argument == own) return true;
  return argument.substr(0, 2) == "--";
}

bool has_extension(const std::string& file) {
  const std::filesystem::path path(file);
  return path.has_extension() || !path.has_filename();
}

/// The name of an INI file, and of one of its sections.
struct IniName {
  explicit IniName(const std::string& text) : file(text) {
    const std::size_t bracket = text.find('[');
    if (bracket == text.npos) return;
    names_section = true;
    is_closed = text.back() == ']';
    file = text.substr(0, bracket);
    section = text.substr(bracket + 1, text.size() - bracket - (is_closed ? 2 : 1));
  }

  std::string file, section;
  bool names_section = false, is_closed = true;
};

class Translator {
public:
  explicit Translator(const PovFiles& files) : files_(files) {}

  void pass(const std::string& argument) { out_.pass(argument); }

  void argument(const std::string& text) {
    if (is_own_option(text) || text.empty()) return out_.pass(text);
    // A name with blanks is a single file if there is such a file.
    if (text.find(' ') != text.npos && files_.exists(text)) return file(text);
    for (const PovEntry& entry : split_argument(text))
      apply(entry);
  }

  /// Adds a folder of -L.
  void folder(const std::string& name) { folders_.push_back(name); }
  /// Records the value of -o.
  void output(const std::string& name) {
    std::error_code ignored;
    output_is_folder_ = ends_with(name, "/") || std::filesystem::is_directory(name, ignored);
  }

  Translation take() {
    if (!scene_) return out_.take();
    if (output_is_folder_ && plain_scenes_.size() > 1) {
      // A folder has room for many pictures. Without a folder the last name counts, as in POV-Ray.
      out_.fill(scene_place_, plain_scenes_.front());
      std::for_each(plain_scenes_.begin() + 1, plain_scenes_.end(),
                    [this](const auto& name) { out_.pass(name); });
      return out_.take();
    }
    if (plain_scenes_.size() > 1)
      out_.note("of " + std::to_string(plain_scenes_.size()) + " scenes the last one is rendered, " +
                shown(*scene_) + "; -o DIR/ renders each");
    // A name without an extension is first tried with .pov, then without.
    std::string name = *scene_;
    if (std::error_code ignored; std::filesystem::is_directory(name, ignored))
      while (name.size() > 1 && name.back() == '/')
        name.pop_back();
    const std::string dos_name = name + ".POV", full_name = name + ".pov";
    const Names names =
        has_extension(name) ? Names{name, full_name, dos_name} : Names{full_name, dos_name, name};
    std::optional<std::string> file = found_here(names);
    if (!file && (file = found_in_folders(names)) && !out_.has_any_option({"-o", "--output", "--pov-output"}))
      out_.option("--pov-output", "./"); // as in POV-Ray, the picture does not go into a library folder
    std::error_code ignored;
    const bool is_complete = has_extension(name) || std::filesystem::is_directory(name, ignored);
    out_.fill(scene_place_, file.value_or(is_complete ? name : full_name));
    return out_.take();
  }

private:
  /// Limit on INI files that are open at once.
  static constexpr int kMostIniFiles = 16;

  void apply(const PovEntry& entry) {
    if (entry.kind == PovEntry::Kind::file) {
      const bool has_sign = entry.value[0] == '+' || entry.value[0] == '-';
      if (has_sign && !entry.in_quotes && !is_own_option(entry.value))
        throw InputError(shown(entry.text) + " is no switch of POV-Ray that is known here");
      return file(entry.value);
    }
    if (!entry.setting) return out_.apply(entry);
    const bool names_something =
        entry.setting->action == Action::declare || !takes_blanks(entry.setting->action);
    if (entry.kind == PovEntry::Kind::setting && entry.value.empty() && !names_something)
      return out_.note(shown(entry.text) + " has no effect: it names nothing");
    const auto value = [&entry](const char* what) {
      if (entry.value.empty()) throw InputError(shown(entry.text) + " needs " + what);
      return entry.value;
    };
    switch (entry.setting->action) {
    case Action::scene:
      return scene(value("a file name"));
    case Action::include_ini:
      return ini(IniName(value("a file name")));
    case Action::folder:
      folders_.push_back(value("the name of a folder"));
      return out_.add_option("-L", entry.value);
    case Action::header:
      return out_.option("--header",
                         found({value("a file name"), entry.value + ".inc"}).value_or(entry.value));
    default:
      return out_.apply(entry);
    }
  }

  /// Handles a scene, an INI file, or one of celltrace's own options.
  void file(const std::string& text) {
    if (is_own_option(text)) return out_.pass(text);
    const IniName name(text);
    if (ends_with(name.file, ".ini") || (name.names_section && found({name.file, name.file + ".ini"})))
      return ini(name);
    if (!ends_with(text, ".pov") && is_ini_without_its_extension(text)) return ini(name);
    plain_scenes_.push_back(text);
    scene(text);
  }

  bool is_ini_without_its_extension(const std::string& text) const {
    if (!has_extension(text)) return found({text + ".ini"}).has_value();
    const std::optional<std::string> there = found({text});
    return there && looks_like_ini(files_.read(*there));
  }

  void ini(const IniName& name) {
    if (!name.is_closed)
      throw InputError(shown(name.file + '[' + name.section) + ": a section's name has to end with ]");
    const std::string file = found({name.file, name.file + ".ini"}).value_or(name.file);
    if (++open_ini_files_ > kMostIniFiles)
      throw InputError(file + ": INI files include each other more than " + std::to_string(kMostIniFiles) +
                       " deep");
    const std::string text = files_.read(file);
    const IniLines ini = parse_ini(text, name.section);
    if (!ini.has_section) out_.note(file + " has no section [" + name.section + ']');
    for (const IniLine& line : ini.lines)
      ini_line(file, line);
    --open_ini_files_;
  }

  void ini_line(const std::string& file, const IniLine& line) {
    try {
      for (const PovEntry& entry : split_ini_line(line.text))
        apply(entry);
    } catch (const PlacedError&) {
      throw;
    } catch (const InputError& error) {
      throw PlacedError(file + ':' + std::to_string(line.number) + ": " + error.what());
    }
  }

  void scene(const std::string& name) {
    if (!scene_) scene_place_ = out_.reserve();
    scene_ = name;
  }

  using Names = std::vector<std::string>;

  /// Returns the first of these files that exists, in the current folder or in a library folder.
  std::optional<std::string> found(const Names& names) const {
    const std::optional<std::string> file = found_here(names);
    return file ? file : found_in_folders(names);
  }
  std::optional<std::string> found_here(const Names& names) const {
    for (const std::string& name : names)
      if (files_.exists(name)) return name;
    return std::nullopt;
  }
  std::optional<std::string> found_in_folders(const Names& names) const {
    for (const std::string& folder : folders_)
      for (const std::string& name : names)
        if (const std::string path = (std::filesystem::path(folder) / name).string(); files_.exists(path))
          return path;
    return std::nullopt;
  }

  const PovFiles& files_;
  PovTranslation out_;
  std::vector<std::string> folders_; ///< folders of -L so far
  std::optional<std::string> scene_;
  std::vector<std::string> plain_scenes_; ///< named without a switch or a setting
  bool output_is_folder_ = false;
  std::size_t scene_place_ = 0; ///< index among the arguments
  int open_ini_files_ = 0;
};

} // namespace

PovFiles real_files() {
  PovFiles files;
  files.exists = [](const std::string& name) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(name, error);
    return std::filesystem::exists(status) && !std::filesystem::is_directory(status);
  };
  return files;
}

bool takes_the_next_argument(std::string_view argument) {
  for (const std::string_view alone : {"-h", "--help", "--version", "--quiet", "--faults", "--lenient",
                                       "--list-keywords", "--resume", "--sandbox"})
    if (argument == alone) return false;
  return is_own_option(argument) && argument.find('=') == std::string_view::npos;
}

bool is_for_render(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return false;
  const std::string& first = arguments[0];
  return first != "compare" && first != "spu" && first != "replay" && first != "study" && first != "view" &&
         first != "--version" && first != "--list-keywords" && first != "--man-page" &&
         first != "--completions" && first != "--help" && first != "-h";
}

Translation translate_pov_switches(const std::vector<std::string>& arguments, const PovFiles& files) {
  if (!is_for_render(arguments)) return {arguments, {}};
  Translator translator(files);
  translator.pass("render");
  bool own_value = false;
  bool only_files = false;
  for (std::size_t i = arguments[0] == "render" ? 1 : 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (own_value || only_files)
      translator.pass(argument);
    else
      translator.argument(argument);
    if (own_value && (arguments[i - 1] == "-L" || arguments[i - 1] == "--library"))
      translator.folder(argument);
    if (own_value && (arguments[i - 1] == "-o" || arguments[i - 1] == "--output"))
      translator.output(argument);
    only_files = only_files || (!own_value && argument == "--");
    own_value = !own_value && !only_files && takes_the_next_argument(argument);
  }
  return translator.take();
}

} // namespace celltrace::cli
