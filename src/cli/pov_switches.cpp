#include "cli/pov_switches.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>

namespace celltrace::cli {

namespace {

enum class Meaning {
  scene,         // the scene's file
  output,        // the picture's file
  option,        // one of celltrace's own options, with this value
  number_option, // the same, the value being a number
  on_or_off,     // one of celltrace's own options, which takes these words
  quality,       // 0..11, more counts as that
  file_type,     // letter and bits a channel
  antialias,     // on or off, and perhaps a threshold
  jitter,        // on or off, and perhaps an amount
  method,        // of antialiasing: 0 to 2, more counts as that
  depth,         // of antialiasing: 1 to 9, less and more count as these
  cyclic,        // animation, on or off
  resume,        // on or off
  ignored,       // no effect on the picture; no value or a number follows
  ignored_word,  // the same, letters follow
  ignored_file,  // the same, a file name may follow
  refused_if_on, // changes the picture if switched on
  refused        // changes the picture
};

struct Switch {
  std::string_view name; // upper case
  Meaning meaning;
  std::string_view option_or_topic = {};
};

constexpr Switch kSwitches[] = {
    {"I", Meaning::scene},
    {"O", Meaning::output},
    {"W", Meaning::number_option, "-W"},
    {"H", Meaning::number_option, "-H"},
    {"L", Meaning::option, "-L"},
    {"WT", Meaning::number_option, "--spes"},
    {"Q", Meaning::quality},
    {"F", Meaning::file_type},
    {"A", Meaning::antialias},
    {"AM", Meaning::method},
    {"R", Meaning::depth},
    {"J", Meaning::jitter},
    {"UA", Meaning::on_or_off, "--alpha"},
    {"SR", Meaning::number_option, "--start-row"},
    {"ER", Meaning::number_option, "--end-row"},
    {"SC", Meaning::number_option, "--start-column"},
    {"EC", Meaning::number_option, "--end-column"},
    {"K", Meaning::number_option, "--clock"},
    {"KC", Meaning::cyclic},
    {"KI", Meaning::number_option, "--initial-clock"},
    {"KF", Meaning::number_option, "--final-clock"},
    {"KFI", Meaning::number_option, "--initial-frame"},
    {"KFF", Meaning::number_option, "--final-frame"},
    {"SF", Meaning::number_option, "--start-frame"},
    {"EF", Meaning::number_option, "--end-frame"},
    {"STP", Meaning::number_option, "--frame-step"},
    {"UF", Meaning::refused, "field rendering"},
    {"UO", Meaning::refused, "field rendering"},
    {"HI", Meaning::refused, "including a header"},
    {"MV", Meaning::number_option, "--language-version"},
    {"AG", Meaning::number_option, "--antialias-gamma"},
    {"B", Meaning::ignored},
    {"BP", Meaning::ignored},
    {"BS", Meaning::ignored},
    {"C", Meaning::resume},
    {"D", Meaning::ignored_word},
    {"EP", Meaning::ignored},
    {"BM", Meaning::ignored},
    {"GA", Meaning::ignored_file},
    {"GD", Meaning::ignored_file},
    {"GF", Meaning::ignored_file},
    {"GI", Meaning::ignored_file},
    {"GR", Meaning::ignored_file},
    {"GS", Meaning::ignored_file},
    {"GW", Meaning::ignored_file},
    {"HR", Meaning::ignored},
    {"MB", Meaning::ignored},
    {"MI", Meaning::ignored},
    {"P", Meaning::ignored},
    {"RP", Meaning::ignored},
    {"SP", Meaning::ignored},
    {"SU", Meaning::ignored},
    {"TH", Meaning::ignored},
    {"UD", Meaning::ignored},
    {"UL", Meaning::ignored},
    {"UR", Meaning::ignored},
    {"UV", Meaning::ignored},
    {"V", Meaning::on_or_off, "--verbose"},
    {"WL", Meaning::ignored},
    {"X", Meaning::ignored},
};

struct Setting {
  std::string_view name; // lower case
  std::string_view switch_name;
};

/// Settings that are the same as a switch. `declare` and those of kSettingOptions have none.
constexpr Setting kSettings[] = {
    {"input_file_name", "I"},
    {"output_file_name", "O"},
    {"width", "W"},
    {"height", "H"},
    {"library_path", "L"},
    {"work_threads", "WT"},
    {"quality", "Q"},
    {"antialias", "A"},
    {"antialias_depth", "R"},
    {"sampling_method", "AM"},
    {"jitter", "J"},
    {"output_alpha", "UA"},
    {"start_row", "SR"},
    {"end_row", "ER"},
    {"start_column", "SC"},
    {"end_column", "EC"},
    {"clock", "K"},
    {"version", "MV"},
    {"include_header", "HI"},
    {"cyclic_animation", "KC"},
    {"initial_clock", "KI"},
    {"final_clock", "KF"},
    {"initial_frame", "KFI"},
    {"final_frame", "KFF"},
    {"subset_start_frame", "SF"},
    {"subset_end_frame", "EF"},
    {"frame_step", "STP"},
    {"field_render", "UF"},
    {"odd_field", "UO"},
    {"bounding", "MB"},
    {"bounding_method", "BM"},
    {"continue_trace", "C"},
    {"create_ini", "GI"},
    {"debug_console", "GD"},
    {"display", "D"},
    {"draw_vistas", "UD"},
    {"fatal_console", "GF"},
    {"high_reproducibility", "HR"},
    {"light_buffer", "UL"},
    {"max_image_buffer_memory", "MI"},
    {"pause_when_done", "P"},
    {"preview_end_size", "EP"},
    {"preview_start_size", "SP"},
    {"remove_bounds", "UR"},
    {"render_block_size", "BS"},
    {"render_console", "GR"},
    {"render_pattern", "RP"},
    {"split_unions", "SU"},
    {"statistic_console", "GS"},
    {"test_abort", "X"},
    {"verbose", "V"},
    {"vista_buffer", "UV"},
    {"warning_console", "GW"},
    {"warning_level", "WL"},
};

/// Settings that no switch says, as celltrace's own options.
constexpr Setting kSettingOptions[] = {
    {"antialias_threshold", "--antialias"},
    {"jitter_amount", "--antialias-jitter"},
    {"antialias_gamma", "--antialias-gamma"},
};

/// Settings that no switch says, without effect on the picture.
constexpr std::string_view kIgnoredSettings[] = {
    "all_console",
    "all_file",
    "append_file",
    "bounding_threshold",
    "buffer_output",
    "buffer_size",
    "create_continue_trace_log",
    "create_histogram",
    "debug_file",
    "display_gamma",
    "fatal_file",
    "histogram_grid_size",
    "histogram_name",
    "histogram_type",
    "palette",
    "render_file",
    "statistic_file",
    "test_abort_count",
    "video_mode",
    "warning_file",
};

std::string changed_case(std::string_view text, int (*change)(int)) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [change](unsigned char c) { return static_cast<char>(change(c)); });
  return result;
}

/// Digits with at most one dot, perhaps behind a minus.
bool is_number(std::string_view text) {
  if (!text.empty() && text[0] == '-') text.remove_prefix(1);
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); }) &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) || c == '.'; }) &&
         std::count(text.begin(), text.end(), '.') <= 1;
}

bool is_word(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c); });
}

bool is_on(std::string_view value) {
  const std::string text = changed_case(value, std::tolower);
  for (const std::string_view off : {"off", "false", "no", "0"})
    if (text == off) return false;
  return true;
}

/// POV-Ray adds the extension where a file name has none.
std::string with_extension(std::string_view file, const char* extension) {
  std::filesystem::path path(file);
  if (!path.has_extension() && path.has_filename()) path += extension;
  return path.string();
}

/// A switch with a longer name wins: +WT4 is no width.
const Switch* find_switch(std::string_view argument) {
  const std::string name = changed_case(argument.substr(1), std::toupper);
  const Switch* best = nullptr;
  for (const Switch& candidate : kSwitches)
    if (name.compare(0, candidate.name.size(), candidate.name) == 0 &&
        (!best || candidate.name.size() > best->name.size()))
      best = &candidate;
  return best;
}

const Switch& switch_named(std::string_view name) {
  return *std::find_if(std::begin(kSwitches), std::end(kSwitches),
                       [&](const Switch& s) { return s.name == name; });
}

bool is_own_option(std::string_view argument) {
  for (const std::string_view own : {"-o", "-W", "-H", "-L", "-h"})
    if (argument == own) return true;
  return argument.substr(0, 2) == "--";
}

double number_of(const std::string& text) {
  // What is_number() has passed begins with a number, or is dots.
  return std::strtod(text.c_str(), nullptr);
}

class Translator {
public:
  explicit Translator(const TextReader& read) : read_(read) {}

  void argument(const std::string& text) {
    if (text.size() > 1 && (text[0] == '+' || text[0] == '-') && !is_own_option(text))
      switch_or_option(text);
    else if (const std::size_t equals = text.find('=');
             equals != std::string::npos && is_setting(text, equals))
      setting(text, text.substr(0, equals), text.substr(equals + 1));
    else if (is_ini(text))
      ini(text);
    else
      file(text);
  }

  void pass(const std::string& text) { result_.arguments.push_back(text); }

  Translation take() {
    // What is said of antialiasing counts in the end, in whatever order.
    if (antialias_ && method_ != "0") {
      option("--antialias", threshold_);
      if (!method_.empty()) option("--antialias-method", method_);
      if (!depth_.empty()) option("--antialias-depth", depth_);
      if (jitter_ && number_of(jitter_amount_) > 0)
        option("--antialias-jitter", number_of(jitter_amount_) < 1 ? jitter_amount_ : "1");
      if (!gamma_.empty()) option("--antialias-gamma", gamma_);
    }
    if (resume_) result_.arguments.insert(result_.arguments.begin() + 1, "--resume"); // not behind a "--"
    return std::move(result_);
  }

private:
  /// INI files that are open at once.
  static constexpr int kMostIniFiles = 16;

  /// Letters before the sign only: ./a=b.pov is a file.
  static bool is_setting(const std::string& text, std::size_t equals) {
    return text[0] != '-' && equals > 0 &&
           std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(equals),
                       [](unsigned char c) { return std::isalpha(c) || c == '_'; });
  }

  /// NAME.ini or NAME.ini[SECTION].
  static bool is_ini(const std::string& text) {
    const std::string name = changed_case(text.substr(0, text.find('[')), std::tolower);
    return name.size() > 4 && name.compare(name.size() - 4, 4, ".ini") == 0;
  }

  void ini(const std::string& text) {
    const std::size_t bracket = text.find('[');
    const std::string name = text.substr(0, bracket);
    std::string section;
    if (bracket != std::string::npos) {
      if (text.back() != ']') throw InputError("'" + text + "': a section's name has to end with ]");
      section = text.substr(bracket + 1, text.size() - bracket - 2);
    }
    if (++open_ini_files_ > kMostIniFiles)
      throw InputError(name + ": INI files include each other more than " + std::to_string(kMostIniFiles) +
                       " deep");
    for (const IniEntry& entry : parse_ini(read_(name), section, name)) {
      try {
        argument(entry.text);
      } catch (const InputError& error) {
        const std::string what = error.what();
        // An error in a file that the entry includes has its place already.
        if (is_ini(entry.text) || what.compare(0, 1, "'") != 0) throw;
        throw InputError(name + ":" + std::to_string(entry.line) + ": " + what);
      }
    }
    --open_ini_files_;
  }

  /// The scene, or one of celltrace's own options. A scene that a switch has named is replaced.
  void file(const std::string& text) {
    if (is_own_option(text)) values_.clear(); // the order counts between such options and switches
    if (scene_ && !is_own_option(text))
      result_.arguments[*scene_] = text;
    else
      pass(text);
  }
  void scene(const std::string& name) {
    if (!scene_) {
      scene_ = result_.arguments.size();
      pass({});
    }
    result_.arguments[*scene_] = name;
  }

  void switch_or_option(const std::string& text) {
    const Switch* found = find_switch(text);
    if (found) return apply(text, *found, text.substr(1 + found->name.size()), text[0] == '+');
    if (text[0] == '+') unknown(text);
    pass(text); // the command line's own parser says what is wrong
  }

  void setting(const std::string& text, const std::string& name, const std::string& value) {
    const std::string lower = changed_case(name, std::tolower);
    const auto same_name = [&](const Setting& s) { return s.name == lower; };
    if (lower == "declare") return add_option("--declare", value);
    if (lower == "include_ini") return ini(needed(text, value, "a file name"));
    if (lower == "output_to_file") return output_to_file(is_on(value));
    if (lower == "bits_per_color") return bits_per_color(text, value);
    if (lower == "output_file_type") return file_type(text, changed_case(value, std::toupper));
    const auto own = std::find_if(std::begin(kSettingOptions), std::end(kSettingOptions), same_name);
    if (own != std::end(kSettingOptions)) {
      (own->switch_name == "--antialias"         ? threshold_
       : own->switch_name == "--antialias-gamma" ? gamma_
                                                 : jitter_amount_) = needed_number(text, value);
      return;
    }
    if (std::find(std::begin(kIgnoredSettings), std::end(kIgnoredSettings), lower) !=
        std::end(kIgnoredSettings))
      return ignore(text, true);
    const auto found = std::find_if(std::begin(kSettings), std::end(kSettings), same_name);
    if (found == std::end(kSettings))
      throw InputError("'" + text + "' is no setting of POV-Ray that is known here");
    const Switch& same = switch_named(found->switch_name);
    // What a switch says by its sign a setting says by its value.
    const bool by_sign = same.meaning == Meaning::refused_if_on || same.meaning == Meaning::ignored ||
                         same.meaning == Meaning::ignored_word || same.meaning == Meaning::ignored_file ||
                         same.meaning == Meaning::antialias || same.meaning == Meaning::jitter ||
                         same.meaning == Meaning::cyclic || same.meaning == Meaning::resume ||
                         same.meaning == Meaning::on_or_off;
    apply(text, same, by_sign ? "" : value, is_on(value));
  }

  void apply(const std::string& text, const Switch& s, const std::string& value, bool on) {
    switch (s.meaning) {
    case Meaning::scene:
      return scene(with_extension(needed(text, value, "a file name"), ".pov"));
    case Meaning::output:
      return option("-o", needed(text, value, "a file name"));
    case Meaning::option:
      return add_option(s.option_or_topic, needed(text, value, "a value"));
    case Meaning::number_option:
      return option(s.option_or_topic, needed_number(text, value));
    case Meaning::on_or_off:
      if (!value.empty()) unknown(text);
      return option(s.option_or_topic, on ? "on" : "off");
    case Meaning::quality:
      return quality(needed_number(text, value));
    case Meaning::file_type:
      output_to_file(on);
      return file_type(text, changed_case(value, std::toupper));
    case Meaning::antialias:
      antialias_ = on;
      if (!value.empty()) threshold_ = needed_number(text, value);
      return;
    case Meaning::jitter:
      jitter_ = on;
      if (!value.empty()) jitter_amount_ = needed_number(text, value);
      return;
    case Meaning::method:
      method_ = limited(needed_number(text, value), 0, 2);
      return;
    case Meaning::depth:
      depth_ = limited(needed_number(text, value), 1, 9);
      return;
    case Meaning::cyclic:
      if (!value.empty()) unknown(text);
      return option("--cyclic", on ? "on" : "off");
    case Meaning::resume:
      if (!value.empty()) unknown(text);
      resume_ = on;
      return;
    case Meaning::ignored:
      return ignore(text, value.empty() || is_number(value));
    case Meaning::ignored_word:
      return ignore(text, is_word(value));
    case Meaning::ignored_file:
      return ignore(text, true);
    case Meaning::refused_if_on:
      if (on) refuse(text, s.option_or_topic);
      return;
    case Meaning::refused:
      refuse(text, s.option_or_topic);
    }
  }

  void add_option(std::string_view name, const std::string& value) {
    result_.arguments.emplace_back(name);
    result_.arguments.push_back(value);
  }
  /// Of what is said more than once, the last counts.
  void option(std::string_view name, const std::string& value) {
    const auto said = values_.find(name);
    if (said != values_.end()) {
      result_.arguments[said->second] = value;
      return;
    }
    add_option(name, value);
    values_.emplace(name, result_.arguments.size() - 1);
  }

  /// A whole number; POV-Ray takes the nearest that there is.
  static std::string limited(const std::string& value, int least, int most) {
    return std::to_string(static_cast<int>(std::clamp(number_of(value), double(least), double(most))));
  }

  void quality(const std::string& value) { option("--quality", limited(value, 0, 11)); }

  void output_to_file(bool on) { option("--picture", on ? "on" : "off"); }

  void file_type(const std::string& text, const std::string& type) {
    if (type.empty()) return;
    const std::string bits = type.substr(1);
    const bool has_depths = type[0] == 'N' || type[0] == 'P';
    if ((!has_depths && type != "E" && type != "H") || (!bits.empty() && bits != "8" && bits != "16"))
      refuse(text, "a file type other than PNG and PPM with 8 or 16 bits a channel, OpenEXR and Radiance");
    option("--file-type", type[0] == 'N' ? "png" : type[0] == 'P' ? "ppm" : type[0] == 'E' ? "exr" : "hdr");
    if (!bits.empty()) option("--bits", bits);
  }

  void bits_per_color(const std::string& text, const std::string& bits) {
    if (bits != "8" && bits != "16") refuse(text, "a picture of other than 8 or 16 bits a channel");
    option("--bits", bits);
  }

  void ignore(const std::string& text, bool well_formed) {
    if (!well_formed) unknown(text);
    result_.notes.push_back("'" + text + "' has no effect here");
  }

  [[noreturn]] static void unknown(const std::string& text) {
    throw InputError("'" + text + "' is no switch of POV-Ray that is known here");
  }

  [[noreturn]] static void refuse(const std::string& text, std::string_view topic) {
    throw InputError("'" + text + "': " + std::string(topic) + " is not supported yet");
  }

  static const std::string& needed(const std::string& text, const std::string& value, const char* what) {
    if (value.empty()) throw InputError("'" + text + "' must be followed by " + what + ", without a space");
    return value;
  }

  static const std::string& needed_number(const std::string& text, const std::string& value) {
    if (!is_number(value)) throw InputError("'" + text + "' must be followed by a number, without a space");
    return value;
  }

  const TextReader& read_;
  Translation result_;
  std::map<std::string, std::size_t, std::less<>> values_; ///< of options: where they are in the result
  std::optional<std::size_t> scene_;                       ///< where the one that a switch has named is
  int open_ini_files_ = 0;
  // POV-Ray's defaults.
  bool antialias_ = false, jitter_ = true, resume_ = false;
  std::string threshold_ = "0.3", jitter_amount_ = "1";
  std::string method_, depth_, gamma_; ///< empty: not said
};

} // namespace

bool takes_the_next_argument(std::string_view argument) {
  for (const std::string_view alone :
       {"-h", "--help", "--version", "--quiet", "--faults", "--lenient", "--list-keywords", "--resume"})
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

Translation translate_pov_switches(const std::vector<std::string>& arguments, const TextReader& read) {
  if (!is_for_render(arguments)) return {arguments, {}};
  Translator translator(read);
  translator.pass("render");
  bool own_value = false;
  bool only_files = false;
  for (std::size_t i = arguments[0] == "render" ? 1 : 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (own_value || only_files)
      translator.pass(argument);
    else
      translator.argument(argument);
    only_files = only_files || (!own_value && argument == "--");
    own_value = !own_value && !only_files && takes_the_next_argument(argument);
  }
  return translator.take();
}

} // namespace celltrace::cli
