#include "cli/povray_client.hpp"

#include "celltrace/version.hpp"
#include "cli/povray_conf.hpp"

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <memory>

namespace celltrace::cli {

namespace {

constexpr std::string_view kSwitchName = "--povray";

constexpr std::string_view kHelp =
    "povray SCENE.pov [switches] [FILE.ini]\n"
    "\n"
    "celltrace stands in for POV-Ray here. Frequent switches:\n"
    "  +Iscene.pov +Opicture.png   the scene, and the picture\n"
    "  +W640 +H480                 columns and rows\n"
    "  +FN +FP +FE +FH             PNG, PPM, OpenEXR, Radiance\n"
    "  +A0.3 -A                    antialiasing\n"
    "  +UA                         alpha\n"
    "  +L/path                     a folder with files to include\n"
    "  +KFF100                     an animation\n"
    "Settings of INI files such as Width=640 can stand here, too. `celltrace render --help` names "
    "celltrace's own\n"
    "options; CELLTRACE_OPTIONS in the environment has those that a program cannot pass.\n";

bool is_among(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

} // namespace

bool stands_in_for_povray(std::string_view program, const std::vector<std::string>& arguments) {
  bool stands_in = program.substr(program.rfind('/') + 1) == "povray";
  for (std::size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    const std::string_view argument = arguments[i];
    if (argument == kSwitchName && i + 1 < arguments.size())
      stands_in = arguments[i + 1] == "on";
    else if (argument.substr(0, kSwitchName.size() + 1) == "--povray=")
      stands_in = argument.substr(kSwitchName.size() + 1) == "on";
  }
  return stands_in;
}

std::optional<std::string> povray_information(const std::vector<std::string>& arguments) {
  // Programs look for "POV-Ray" and "Version" with a number after it.
  const std::string name =
      std::string("celltrace ") + version() + " (understands POV-Ray 3.7 scenes)\nLanguage Version 3.7\n";
  for (const std::string& argument : arguments) {
    if (argument == "--") break;
    if (is_among(argument, {"--version", "-version", "--V"})) return name;
    if (is_among(argument, {"--help", "-help", "-h", "-?"})) return name + '\n' + std::string(kHelp);
  }
  return std::nullopt;
}

std::vector<std::string> povray_defaults(const PovrayPlaces& places, std::vector<std::string>& notes) {
  std::vector<std::string> arguments = {std::string(kSwitchName), "on", "-W", "160", "-H", "120"};
  if (const auto ini = find_povray_ini(places, notes)) arguments.push_back("Include_INI=" + ini->string());
  return arguments;
}

void permit_as_povray(ParseOptions& options, const PovrayPlaces& places, std::vector<std::string>& warnings) {
  const auto confs = std::make_shared<const std::vector<PovrayConf>>(read_povray_confs(places, warnings));
  options.working_folder = ".";
  options.permits = [confs](const std::filesystem::path& file, FileUse use) {
    return std::all_of(confs->begin(), confs->end(),
                       [&](const PovrayConf& conf) { return conf.permits(file, use); });
  };
}

} // namespace celltrace::cli
