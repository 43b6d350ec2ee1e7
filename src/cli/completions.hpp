// What --completions prints: what a shell needs to complete words of the command line.
#pragma once

#include "cli/described_command.hpp"

#include <string>
#include <vector>

namespace celltrace::cli {

/// `commands` as describe() returns them; `shell` is "bash", "zsh" or "fish". Throws InputError for another.
std::string completions(const std::vector<DescribedCommand>& commands, const std::string& shell);

} // namespace celltrace::cli
