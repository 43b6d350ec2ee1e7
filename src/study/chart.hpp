// Charts as SVG.
#pragma once

#include "study/table.hpp"

#include <string>

namespace celltrace::study {

/// Returns a picture of 900x520 with title, axes, marks and a legend.
std::string draw(const std::string& title, const Chart& chart);

} // namespace celltrace::study
