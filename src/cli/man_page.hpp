// What --man-page prints, and what is installed as celltrace(1).
#pragma once

#include "cli/described_command.hpp"

#include <string>
#include <vector>

namespace celltrace::cli {

/// In the man macros; `commands` as describe() returns them.
std::string man_page(const std::vector<DescribedCommand>& commands);

} // namespace celltrace::cli
