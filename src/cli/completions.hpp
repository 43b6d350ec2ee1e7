// The output of --completions, with which a shell completes words of the command line.
#pragma once

#include "cli/described_command.hpp"

#include <string>
#include <vector>

namespace celltrace::cli {

/// Returns the completions. `commands` come from describe(); `shell` is "bash", "zsh" or "fish". Throws
/// InputError for any other shell.
std::string completions(const std::vector<DescribedCommand>& commands, const std::string& shell);

} // namespace celltrace::cli
