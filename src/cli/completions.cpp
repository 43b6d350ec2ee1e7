#include "cli/completions.hpp"

#include "celltrace/error.hpp"

namespace celltrace::cli {

namespace {

using Commands = std::vector<DescribedCommand>;

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : separator) + word;
  return text;
}

template <class Visit> void for_each_option(const DescribedCommand& command, Visit visit) {
  for (const DescribedGroup& group : command.groups)
    for (const DescribedOption& option : group.options)
      if (!option.positional()) visit(option);
}

/// Returns a text in single quotes, as all shells accept it.
std::string in_quotes(const std::string& text) {
  std::string out = "'";
  for (const char c : text)
    out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string command_names(const Commands& commands) {
  std::vector<std::string> names;
  for (auto command = commands.begin() + 1; command != commands.end(); ++command)
    names.push_back(command->name);
  return joined(names, " ");
}

// --- bash ---

std::string bash_values(const DescribedOption& option) {
  if (!option.choices.empty())
    return "COMPREPLY=($(compgen -W " + in_quotes(joined(option.choices, " ")) + " -- \"$word\"))";
  if (option.takes_folder()) return "compopt -o filenames; COMPREPLY=($(compgen -d -- \"$word\"))";
  if (option.takes_file()) return "compopt -o filenames; COMPREPLY=($(compgen -f -- \"$word\"))";
  return "COMPREPLY=()";
}

void add_bash_command(std::string& script, const DescribedCommand& command) {
  const std::string label = command.name.empty() ? "none" : command.name;
  std::vector<std::string> names;
  std::string values;
  for_each_option(command, [&](const DescribedOption& option) {
    names.insert(names.end(), option.names.begin(), option.names.end());
    if (!option.value.empty())
      values += "      " + joined(option.names, "|") + ") " + bash_values(option) + "; return ;;\n";
  });
  script += "  " + label + ")\n    options=" + in_quotes(joined(names, " ")) + '\n';
  if (!values.empty()) script += "    case \"$before\" in\n" + values + "    esac\n";
  script += "    ;;\n";
}

std::string bash_completions(const Commands& commands) {
  const std::string names = command_names(commands);
  std::string script =
      "# bash completion for celltrace\n"
      "_celltrace() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=none options i\n"
      "  if ((COMP_CWORD > 1)); then command=render; fi\n"
      "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
      "    case \" " +
      names +
      " \" in\n"
      "    *\" ${COMP_WORDS[i]} \"*) command=${COMP_WORDS[i]}; break ;;\n"
      "    esac\n"
      "  done\n"
      "  case \"$command\" in\n";
  for (const DescribedCommand& command : commands)
    add_bash_command(script, command);
  script += "  esac\n"
            "  case \"$word\" in\n"
            "  -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
            "  *)\n"
            "    compopt -o filenames 2>/dev/null\n"
            "    COMPREPLY=($(compgen -f -- \"$word\"))\n"
            "    if ((COMP_CWORD == 1)); then COMPREPLY+=($(compgen -W '" +
            names +
            "' -- \"$word\")); fi\n"
            "    ;;\n"
            "  esac\n"
            "}\n"
            "complete -F _celltrace celltrace\n";
  return script;
}

// --- zsh ---

std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_values(const DescribedOption& option) {
  if (option.value.empty()) return "";
  std::string text = ":" + zsh_text(option.value) + ":";
  if (!option.choices.empty()) return text + "(" + joined(option.choices, " ") + ")";
  if (option.takes_folder()) return text + "_files -/";
  return option.takes_file() ? text + "_files" : text;
}

void add_zsh_options(std::string& script, const DescribedCommand& command) {
  for_each_option(command, [&](const DescribedOption& option) {
    for (const std::string& name : option.names)
      script += " \\\n      " +
                in_quotes("*" + name + "[" + zsh_text(option.description) + "]" + zsh_values(option));
  });
}

std::string zsh_completions(const Commands& commands) {
  std::string script = "#compdef celltrace\n"
                       "_celltrace() {\n"
                       "  local -a commands\n"
                       "  commands=(\n";
  for (auto command = commands.begin() + 1; command != commands.end(); ++command)
    script += "    " + in_quotes(command->name + ":" + zsh_text(command->description)) + '\n';
  script += "  )\n"
            "  if ((CURRENT == 2)) && [[ $words[2] != -* ]]; then\n"
            "    _describe command commands\n"
            "    _files\n"
            "    return\n"
            "  fi\n"
            "  case $words[2] in\n";
  for (auto command = commands.begin() + 1; command != commands.end(); ++command) {
    script += "  " + command->name + ")\n    _arguments";
    add_zsh_options(script, *command);
    script += " \\\n      '*:file:_files'\n    ;;\n";
  }
  script += "  -*)\n    _arguments";
  add_zsh_options(script, commands.front());
  script += "\n    ;;\n"
            "  *) _files ;;\n"
            "  esac\n"
            "}\n"
            "_celltrace \"$@\"\n";
  return script;
}

// --- fish ---

std::string fish_options(const DescribedCommand& command, const std::string& condition) {
  std::string script;
  for_each_option(command, [&](const DescribedOption& option) {
    script += "complete -c celltrace -n " + in_quotes(condition);
    for (const std::string& name : option.names)
      script += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (!option.choices.empty())
      script += " -x -a " + in_quotes(joined(option.choices, " "));
    else if (option.takes_folder())
      script += " -x -a '(__fish_complete_directories)'";
    else if (option.takes_file())
      script += " -r -F";
    else if (!option.value.empty())
      script += " -x";
    script += " -d " + in_quotes(option.description) + '\n';
  });
  return script;
}

std::string fish_completions(const Commands& commands) {
  std::string script = "# fish completion for celltrace\n";
  for (auto command = commands.begin() + 1; command != commands.end(); ++command)
    script += "complete -c celltrace -n __fish_use_subcommand -a " + command->name + " -d " +
              in_quotes(command->description) + '\n';
  script += fish_options(commands.front(), "__fish_use_subcommand");
  for (auto command = commands.begin() + 1; command != commands.end(); ++command)
    script += fish_options(*command, "__fish_seen_subcommand_from " + command->name);
  return script;
}

} // namespace

std::string completions(const Commands& commands, const std::string& shell) {
  if (shell == "bash") return bash_completions(commands);
  if (shell == "zsh") return zsh_completions(commands);
  if (shell == "fish") return fish_completions(commands);
  throw InputError("--completions: '" + shell + "' is none of bash, zsh, fish");
}

} // namespace celltrace::cli
