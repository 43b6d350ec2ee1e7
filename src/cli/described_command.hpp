// The command line as data, from which --help, pages and completions are made.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace celltrace::cli {

struct DescribedOption {
  std::vector<std::string> names;   ///< "-o", "--output"; none for a positional argument
  std::string value;                ///< placeholder of its value: "N", "FILE", "free|lockstep"; "" for a flag
  std::vector<std::string> choices; ///< the only words allowed
  std::string limits;               ///< "1 to 65535"; "" if there are none, or if it takes words
  std::string description;
  std::string default_value;
  bool required = false;

  bool positional() const { return names.empty(); }
  bool takes_folder() const { return value.find("DIR") != value.npos; }
  /// Returns whether the value is a file by the conventions of this program: FILE, or a name with an
  /// extension.
  bool takes_file() const;
};

struct DescribedGroup {
  std::string title; ///< "" for options without a group
  std::vector<DescribedOption> options;
};

struct DescribedCommand {
  std::string name; ///< "" for the program itself
  std::string description;
  std::string footer;
  std::vector<DescribedGroup> groups;
};

/// Returns the program itself, followed by its commands. Options in an empty group, which hides them from
/// --help, are left out.
std::vector<DescribedCommand> describe(const CLI::App& app);

} // namespace celltrace::cli
