#include "cli/pov_switches.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

namespace celltrace::cli {

namespace {

enum class Meaning {
  scene,         // the scene's file
  output,        // the picture's file
  option,        // one of celltrace's own options, with this value
  number_option, // the same, the value being a number
  quality,       // 0..11: only those that trace everything are supported
  file_type,     // letter and bits a channel
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
    {"A", Meaning::refused_if_on, "antialiasing"},
    {"UA", Meaning::refused_if_on, "an alpha channel"},
    {"SR", Meaning::refused, "rendering a part of the rows"},
    {"ER", Meaning::refused, "rendering a part of the rows"},
    {"S", Meaning::refused, "rendering a part of the rows"},
    {"E", Meaning::refused, "rendering a part of the rows"},
    {"SC", Meaning::refused, "rendering a part of the columns"},
    {"EC", Meaning::refused, "rendering a part of the columns"},
    {"K", Meaning::refused, "animation"},
    {"KC", Meaning::refused, "animation"},
    {"KI", Meaning::refused, "animation"},
    {"KF", Meaning::refused, "animation"},
    {"KFI", Meaning::refused, "animation"},
    {"KFF", Meaning::refused, "animation"},
    {"SF", Meaning::refused, "animation"},
    {"EF", Meaning::refused, "animation"},
    {"UF", Meaning::refused, "field rendering"},
    {"UO", Meaning::refused, "field rendering"},
    {"HI", Meaning::refused, "including a header"},
    {"MV", Meaning::refused, "another language version"},
    {"AG", Meaning::ignored},
    {"AM", Meaning::ignored},
    {"B", Meaning::ignored},
    {"BP", Meaning::ignored},
    {"BS", Meaning::ignored},
    {"C", Meaning::ignored},
    {"D", Meaning::ignored_word},
    {"EP", Meaning::ignored},
    {"GA", Meaning::ignored_file},
    {"GD", Meaning::ignored_file},
    {"GF", Meaning::ignored_file},
    {"GR", Meaning::ignored_file},
    {"GS", Meaning::ignored_file},
    {"GW", Meaning::ignored_file},
    {"J", Meaning::ignored},
    {"MB", Meaning::ignored},
    {"P", Meaning::ignored},
    {"R", Meaning::ignored},
    {"SP", Meaning::ignored},
    {"SU", Meaning::ignored},
    {"UD", Meaning::ignored},
    {"UL", Meaning::ignored},
    {"UR", Meaning::ignored},
    {"UV", Meaning::ignored},
    {"V", Meaning::ignored},
    {"WL", Meaning::ignored},
    {"X", Meaning::ignored},
};

struct Setting {
  std::string_view name; // lower case
  std::string_view switch_name;
};

/// Settings that are the same as a switch. `declare` has none.
constexpr Setting kSettings[] = {
    {"input_file_name", "I"},    {"output_file_name", "O"}, {"width", "W"},      {"height", "H"},
    {"library_path", "L"},       {"work_threads", "WT"},    {"quality", "Q"},    {"output_file_type", "F"},
    {"antialias", "A"},          {"output_alpha", "UA"},    {"start_row", "SR"}, {"end_row", "ER"},
    {"start_column", "SC"},      {"end_column", "EC"},      {"clock", "K"},      {"sampling_method", "AM"},
    {"render_block_size", "BS"}, {"continue_trace", "C"},   {"display", "D"},    {"jitter", "J"},
    {"bounding", "MB"},          {"pause_when_done", "P"},  {"verbose", "V"},    {"warning_level", "WL"},
    {"test_abort", "X"},
};

std::string changed_case(std::string_view text, int (*change)(int)) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [change](unsigned char c) { return static_cast<char>(change(c)); });
  return result;
}

bool is_number(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) || c == '.'; });
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

bool takes_the_next_argument(std::string_view argument) {
  for (const std::string_view alone : {"-h", "--help", "--version", "--quiet", "--faults"})
    if (argument == alone) return false;
  return is_own_option(argument) && argument.find('=') == std::string_view::npos;
}

class Translator {
public:
  void argument(const std::string& text) {
    if (text.size() > 1 && (text[0] == '+' || text[0] == '-') && !is_own_option(text))
      switch_or_option(text);
    else if (const std::size_t equals = text.find('=');
             equals != std::string::npos && is_setting(text, equals))
      setting(text, text.substr(0, equals), text.substr(equals + 1));
    else
      pass(text);
  }

  void pass(const std::string& text) { result_.arguments.push_back(text); }

  Translation take() { return std::move(result_); }

private:
  /// Letters before the sign only: ./a=b.pov is a file.
  static bool is_setting(const std::string& text, std::size_t equals) {
    return text[0] != '-' && equals > 0 &&
           std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(equals),
                       [](unsigned char c) { return std::isalpha(c) || c == '_'; });
  }

  void switch_or_option(const std::string& text) {
    const Switch* found = find_switch(text);
    if (found) return apply(text, *found, text.substr(1 + found->name.size()), text[0] == '+');
    if (text[0] == '+') throw InputError("'" + text + "' is no switch of POV-Ray that is known here");
    pass(text); // the command line's own parser says what is wrong
  }

  void setting(const std::string& text, const std::string& name, const std::string& value) {
    const std::string lower = changed_case(name, std::tolower);
    if (lower == "declare") return option("--declare", value);
    const auto found = std::find_if(std::begin(kSettings), std::end(kSettings),
                                    [&](const Setting& s) { return s.name == lower; });
    if (found == std::end(kSettings))
      throw InputError("'" + text + "' is no setting of POV-Ray that is known here");
    const Switch& same = switch_named(found->switch_name);
    // What a switch says by its sign a setting says by its value.
    const bool by_sign = same.meaning == Meaning::refused_if_on || same.meaning == Meaning::ignored ||
                         same.meaning == Meaning::ignored_word;
    apply(text, same, by_sign ? "" : value, is_on(value));
  }

  void apply(const std::string& text, const Switch& s, const std::string& value, bool on) {
    switch (s.meaning) {
    case Meaning::scene:
      return pass(with_extension(needed(text, value, "a file name"), ".pov"));
    case Meaning::output:
      return option("-o", with_extension(needed(text, value, "a file name"), ".png"));
    case Meaning::option:
      return option(s.option_or_topic, needed(text, value, "a value"));
    case Meaning::number_option:
      return option(s.option_or_topic, needed_number(text, value));
    case Meaning::quality:
      return quality(text, needed_number(text, value));
    case Meaning::file_type:
      return file_type(text, changed_case(value, std::toupper), on);
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

  void option(std::string_view name, const std::string& value) {
    result_.arguments.emplace_back(name);
    result_.arguments.push_back(value);
  }

  void quality(const std::string& text, const std::string& value) {
    // 8 traces reflected and refracted rays and shadows; 9 to 11 are the same without media.
    for (const std::string_view full : {"8", "9", "10", "11"})
      if (value == full) return;
    refuse(text, "a quality other than 8 to 11");
  }

  void file_type(const std::string& text, const std::string& type, bool on) {
    if (!on) refuse(text, "rendering without a picture file");
    if (type.empty() || type == "N" || type == "N8") return;
    refuse(text,
           "a file type other than PNG with 8 bits a channel (an output name that ends in .ppm gives a PPM)");
  }

  void ignore(const std::string& text, bool well_formed) {
    if (!well_formed) throw InputError("'" + text + "' is no switch of POV-Ray that is known here");
    result_.notes.push_back("'" + text + "' has no effect here");
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

  Translation result_;
};

bool is_for_render(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return false;
  const std::string& first = arguments[0];
  return first != "compare" && first != "spu" && first != "replay" && first != "study" &&
         first != "--version" && first != "--help" && first != "-h";
}

} // namespace

Translation translate_pov_switches(const std::vector<std::string>& arguments) {
  if (!is_for_render(arguments)) return {arguments, {}};
  Translator translator;
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
