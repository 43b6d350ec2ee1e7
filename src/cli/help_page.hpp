// The output of --help: the command line in 80 columns.
#pragma once

#include "cli/described_command.hpp"

#include <string>

namespace celltrace::cli {

/// Returns the help of a command or, with `commands`, that of the program, which lists the commands. A line
/// has at most 80 characters, unless a name or a value is longer.
std::string help_page(const DescribedCommand& command, const std::vector<DescribedCommand>& commands = {});

} // namespace celltrace::cli
