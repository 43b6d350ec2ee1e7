// Computes the statistics of a frame from the reports of the SPEs.
#pragma once

#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "records/frame.hpp"
#include "records/report.hpp"

#include <span>
#include <vector>

namespace celltrace {

/// Measures the work of a machine's SPEs between two moments.
class SpeMeter {
public:
  /// Starts the measurement.
  explicit SpeMeter(const Machine& machine);

  /// Returns the statistics since the start, by SPE. The local store's peak is the highest since the machine
  /// was made.
  std::vector<SpeStatistics> read() const;

private:
  const Machine& machine_;
  std::vector<SpeStatistics> start_;
};

/// Returns the greatest total_cycle.
std::uint64_t elapsed_cycles(std::span<const SpeStatistics> spes);

/// Adds the reports of each SPE to its sum over several frames.
void add(std::span<kernel::ReportRecord> sum, std::span<const kernel::ReportRecord> reports);

/// Adds the numbers of the frame, of the reports, and of `spes`, the work of the machine's SPEs in the frame.
/// The schedule in `statistics` must be set, as it decides how imbalance is measured; the caller sets all
/// other fields.
void collect(RenderStatistics& statistics, const Machine& machine, const kernel::FrameBlock& frame,
             std::span<const kernel::ReportRecord> reports, std::span<const SpeStatistics> spes);

} // namespace celltrace
