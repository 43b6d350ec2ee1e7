// The manual page and the completions, as the program prints them.
#include "cli/program_run.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

using namespace celltrace::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::vector<std::string> kCommands = {"render", "compare", "spu", "replay", "study"};

std::string output_of(const std::vector<std::string>& arguments) {
  const TemporaryFolder folder;
  const Outcome outcome = celltrace_run(folder, arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  return outcome.out;
}

/// The long options that --help names at the beginning of a line.
std::set<std::string> options_of(const std::string& help) {
  std::set<std::string> names;
  const std::regex option("\n +(?:-[A-Za-z], )?(--[a-z][a-z-]*)");
  for (std::sregex_iterator found(help.begin(), help.end(), option), end; found != end; ++found)
    names.insert((*found)[1]);
  return names;
}

std::string without_backslashes(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), '\\'), text.end());
  return text;
}

/// What a shell prints when it runs `script`; empty where there is no such shell.
std::string shell(const std::string& name, const std::string& script) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "script", out = folder.path() / "out";
  std::ofstream(file) << "cd " << folder.path().string() << '\n' << script;
  const int code = std::system((name + " " + file.string() + " > " + out.string() + " 2>&1").c_str());
  std::stringstream text;
  text << std::ifstream(out).rdbuf();
  CAPTURE(text.str());
  CHECK(code == 0);
  return text.str();
}

bool has_shell(const std::string& name) {
  if (std::system(("command -v " + name + " >/dev/null").c_str()) == 0) return true;
  WARN("skipped: there is no " + name);
  return false;
}

} // namespace

TEST_CASE("the manual page has every option that --help has") {
  const std::string page = without_backslashes(output_of({"--man-page"}));
  CHECK_THAT(page, StartsWith(".TH CELLTRACE 1"));
  std::size_t options = 0;
  for (const std::string& command : kCommands) {
    const std::size_t begin = page.find(".SH CELLTRACE " + [&] {
      std::string upper = command;
      for (char& c : upper)
        c = static_cast<char>(std::toupper(c));
      return upper;
    }());
    REQUIRE(begin != page.npos);
    const std::string section = page.substr(begin, page.find("\n.SH ", begin) - begin);
    for (const std::string& option : options_of(output_of({command, "--help"}))) {
      CAPTURE(command, option);
      CHECK_THAT(section, Contains("fB" + option + "fR"));
      ++options;
    }
  }
  CHECK(options > 60);
}

TEST_CASE("the manual page has examples, whose options there are") {
  const std::string page = without_backslashes(output_of({"--man-page"}));
  const std::size_t begin = page.find(".SH EXAMPLES");
  REQUIRE(begin != page.npos);
  const std::string section = page.substr(begin, page.find("\n.SH ", begin) - begin);
  const std::string known = output_of({"render", "--help"}) + output_of({"compare", "--help"});
  const std::regex option("--?[A-Za-z][a-z-]*(?= )");
  int options = 0;
  for (std::sregex_iterator at(section.begin(), section.end(), option), end; at != end; ++at, ++options)
    CHECK_THAT(known, Contains(' ' + at->str()));
  CHECK(options >= 9);
}

TEST_CASE("the synopsis of the documentation has every command that --help has") {
  std::istringstream help(output_of({"--help"}));
  const std::string page = read_bytes(CELLTRACE_SOURCE_DIR "/docs/program.md");
  const std::string synopsis = page.substr(0, page.find("## render"));
  int commands = 0;
  bool is_command = false;
  for (std::string line; std::getline(help, line);) {
    std::smatch name;
    if (line.rfind("Commands", 0) == 0) is_command = true;
    if (!is_command || !std::regex_search(line, name, std::regex("^  ([a-z]+) "))) continue;
    CAPTURE(name[1]);
    CHECK_THAT(synopsis, Contains("celltrace " + name[1].str()) || Contains("[" + name[1].str() + "]"));
    ++commands;
  }
  CHECK(commands >= 5);
  CHECK_THAT(synopsis, Contains("celltrace view") && Contains("(viewer.md)"));
}

TEST_CASE("the manual page is one that man reads") {
  if (!has_shell("man")) return;
  const std::string page = output_of({"--man-page"});
  const std::string printed =
      shell("bash", "man --warnings -E UTF-8 -l -Tutf8 -P cat - <<'END' 2>&1\n" + page + "END\n");
  // Letters that are bold or underlined are printed over others.
  std::string text;
  for (const char c : printed)
    if (c == '\b')
      text.pop_back();
    else
      text += c;
  CHECK_THAT(text, Contains("SYNOPSIS"));
  CHECK_THAT(text, !Contains("warning:"));
}

TEST_CASE("bash completes commands, options, choices and files") {
  if (!has_shell("bash")) return;
  const std::string script = output_of({"--completions", "bash"});
  const auto complete = [&](const std::string& line) {
    return shell("bash",
                 script + "compopt() { :; }\ntouch scene.pov\nCOMP_WORDS=(" + line +
                     ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_celltrace\necho \"${COMPREPLY[@]}\"\n");
  };
  CHECK_THAT(complete("celltrace ren"), StartsWith("render"));
  CHECK(complete("celltrace render --backend cell_") == "cell_emu cell_sim\n");
  CHECK(complete("celltrace scene.pov --max-l") == "--max-level\n");
  CHECK(complete("celltrace compare --min-p") == "--min-psnr\n");
  CHECK_THAT(complete("celltrace --vers"), StartsWith("--version"));
  CHECK_THAT(complete("celltrace render scene.p"), StartsWith("scene.pov"));
}

TEST_CASE("zsh and fish take their completions") {
  for (const std::string name : {"zsh", "fish"}) {
    const std::string script = output_of({"--completions", name});
    for (const std::string& command : kCommands)
      CHECK_THAT(script, Contains(command));
    CHECK_THAT(script, Contains("backend") && Contains("native cell_emu cell_sim"));
    if (!has_shell(name)) continue;
    // zsh's is the body of a function that only completing calls.
    CHECK(shell(name, name == "zsh" ? "f() {\n" + script + "}\n" : script).empty());
  }
}

TEST_CASE("an unknown shell has no completions") {
  const TemporaryFolder folder;
  const Outcome outcome = celltrace_run(folder, {"--completions", "csh"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("csh"));
}
