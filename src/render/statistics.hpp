// Reports of the SPEs become the statistics of a frame.
#pragma once

#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "kernel/records.hpp"

#include <span>

namespace celltrace {

/// Adds what the frame and the reports say; the seconds are the caller's.
void collect(RenderStatistics& statistics, const Machine& machine, const kernel::FrameBlock& frame,
             std::span<const kernel::ReportRecord> reports);

} // namespace celltrace
