// Reports of the SPEs become the statistics of a frame.
#pragma once

#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "records/frame.hpp"
#include "records/report.hpp"

#include <span>
#include <vector>

namespace celltrace {

/// What the SPEs of a machine do from one moment to another.
class SpeMeter {
public:
  /// From now on.
  explicit SpeMeter(const Machine& machine);

  /// By SPE, until now. The local store's peak is that since the machine was made.
  std::vector<SpeStatistics> read() const;

private:
  const Machine& machine_;
  std::vector<SpeStatistics> start_;
};

/// The greatest total_cycle.
std::uint64_t elapsed_cycles(std::span<const SpeStatistics> spes);

/// Adds up what each SPE says of several frames.
void add(std::span<kernel::ReportRecord> sum, std::span<const kernel::ReportRecord> reports);

/// Adds what the frame, the reports and `spes` (what the machine's SPEs did in the frame) say. The schedule,
/// which has to be there already, decides what the imbalance is of; the rest is the caller's.
void collect(RenderStatistics& statistics, const Machine& machine, const kernel::FrameBlock& frame,
             std::span<const kernel::ReportRecord> reports, std::span<const SpeStatistics> spes);

} // namespace celltrace
