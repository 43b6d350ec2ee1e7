// The command line as data, for pages and completions that are made of the same description as --help.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace celltrace::cli {

struct DescribedOption {
  std::vector<std::string> names; ///< "-o", "--output"; none for a positional argument
  std::string value;              ///< what stands for its value: "N", "FILE", "free|lockstep"; "" for a flag
  std::vector<std::string> choices; ///< the only words that it takes
  std::string limits;               ///< "1 to 65535"; "" where there are none, or words
  std::string description;
  std::string default_value;
  bool required = false;

  bool positional() const { return names.empty(); }
  bool takes_folder() const { return value.find("DIR") != value.npos; }
  /// By the conventions of this program: FILE, or a name with an extension.
  bool takes_file() const;
};

struct DescribedGroup {
  std::string title; ///< "" for what has no group of its own
  std::vector<DescribedOption> options;
};

struct DescribedCommand {
  std::string name; ///< "" for the program itself
  std::string description;
  std::string footer;
  std::vector<DescribedGroup> groups;
};

/// The program itself, then its commands. What has an empty group, which hides it from --help, is left out.
std::vector<DescribedCommand> describe(const CLI::App& app);

} // namespace celltrace::cli
