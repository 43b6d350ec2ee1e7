#include "cli/man_page.hpp"

#include "celltrace/version.hpp"

#include <cctype>

namespace celltrace::cli {

namespace {

/// Returns a text escaped for troff: it has no requests and escapes, and its dashes are the ASCII ones.
std::string quoted(const std::string& text) {
  std::string out;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    line_begins = c == '\n';
  }
  return out;
}

std::string bold(const std::string& text) {
  return "\\fB" + quoted(text) + "\\fR";
}
std::string italic(const std::string& text) {
  return "\\fI" + quoted(text) + "\\fR";
}

std::string upper_case(std::string text) {
  for (char& c : text)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string with_full_stop(const std::string& text) {
  return text.empty() || text.back() == '.' ? text : text + '.';
}

void add_synopsis(std::string& page, const DescribedCommand& command) {
  page += ".br\n" + bold("celltrace " + command.name);
  for (const DescribedGroup& group : command.groups)
    for (const DescribedOption& option : group.options)
      if (option.positional())
        page += ' ' + (option.required ? italic(option.value) : '[' + italic(option.value) + "...]");
  page += " [" + italic("options") + "]\n";
}

void add_option(std::string& page, const DescribedOption& option) {
  page += ".TP\n";
  std::string names;
  for (const std::string& name : option.names)
    names += (names.empty() ? "" : ", ") + bold(name);
  if (!option.value.empty()) names += (names.empty() ? "" : " ") + italic(option.value);
  page += names + '\n' + quoted(with_full_stop(option.description)) + '\n';
  if (!option.default_value.empty()) page += "Default: " + quoted(option.default_value) + ".\n";
}

void add_options(std::string& page, const DescribedCommand& command) {
  for (const DescribedGroup& group : command.groups) {
    if (group.options.empty()) continue;
    if (!group.title.empty()) page += ".SS " + quoted(group.title) + '\n';
    for (const DescribedOption& option : group.options)
      add_option(page, option);
  }
}

struct Example {
  const char *command, *what;
};
constexpr Example kExamples[] = {
    {"celltrace scene.pov -W 800 -H 600 --antialias 0.3", "Renders the scene into scene.png."},
    {"celltrace +Iscene.pov +W800 +H600 +A0.3 -J", "The same by POV-Ray's switches."},
    {"celltrace scenes/*.pov -o pictures/ --lenient",
     "Renders many scenes without what is not supported of them, with a page of all pictures."},
    {"celltrace scene.pov --final-frame 100 -o film.mp4", "Renders an animation."},
    {"celltrace scene.pov -W 8000 -H 6000 --resume", "Finishes an interrupted picture."},
    {"celltrace view scene.pov", "Opens a window in which to look around."},
    {"celltrace compare a.png b.png --min-psnr 40", "Measures the difference between two pictures."},
};

void add_examples(std::string& page) {
  page += ".SH EXAMPLES\n";
  for (const Example& example : kExamples)
    page += ".TP\n" + bold(example.command) + '\n' + quoted(example.what) + '\n';
}

} // namespace

std::string man_page(const std::vector<DescribedCommand>& commands) {
  const DescribedCommand& program = commands.front();
  std::string page = ".TH CELLTRACE 1 \"\" \"celltrace " CELLTRACE_VERSION_STRING "\" \"User Commands\"\n"
                     ".SH NAME\ncelltrace \\- ray\\-trace POV\\-Ray scenes, and run SPU programs\n"
                     ".SH SYNOPSIS\n.nh\n" +
                     bold("celltrace ") + italic("SCENE.pov") + " [" + italic("options") + "]\n";
  for (auto command = commands.begin() + 1; command != commands.end(); ++command)
    add_synopsis(page, *command);
  page +=
      ".br\n" + bold("celltrace --help") + " | " + bold("--version") + " | " + bold("--list-keywords") +
      "\n.hy\n.SH DESCRIPTION\n" + quoted(program.description) +
      "\n.PP\nProgress and notes go to the standard error output, results to files or the standard output.\n"
      ".PP\n" +
      quoted(program.footer) + "\n.SH OPTIONS\n";
  add_options(page, program);
  for (auto command = commands.begin() + 1; command != commands.end(); ++command) {
    page += ".SH CELLTRACE " + upper_case(command->name) + '\n' +
            quoted(with_full_stop(command->description)) + '\n';
    if (!command->footer.empty()) page += ".PP\n" + quoted(command->footer) + '\n';
    add_options(page, *command);
  }
  page += ".SH EXIT STATUS\n"
          ".TP\n.B 0\nDone.\n"
          ".TP\n.B 1\nAn error, or\n.B compare\nbelow a limit that it was given.\n"
          ".TP\n.B 2\nInterrupted; the part of the picture that is done is kept.\n"
          ".PP\n.B celltrace spu\nexits as the program does that it runs; 124, 125 and 130 are its own.\n";
  add_examples(page);
  return page + ".SH SEE ALSO\n.BR povray (1)\n";
}

} // namespace celltrace::cli
