// The output of --man-page, which is installed as celltrace(1).
#pragma once

#include "cli/described_command.hpp"

#include <string>
#include <vector>

namespace celltrace::cli {

/// Returns the page in the man macros; `commands` come from describe().
std::string man_page(const std::vector<DescribedCommand>& commands);

} // namespace celltrace::cli
