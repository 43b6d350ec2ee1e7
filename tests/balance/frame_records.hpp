// A frame's records in main memory, for programs that take the tracer's frame block, on the host.
#pragma once

#include "work_report.hpp"

#include "celltrace/balance/strip_tally.hpp"
#include "celltrace/spe/shared_records.hpp"
#include "render/frame_fields.hpp"

#include <bit>
#include <cstdint>
#include <vector>

namespace celltrace::test {

FieldList<&WorkReport::units, &WorkReport::exchanges, &WorkReport::units_received, &WorkReport::steps>
fields_of(const WorkReport&);

class FrameRecords {
public:
  /// `steps`: of each unit.
  FrameRecords(unsigned spes, const std::vector<std::uint32_t>& steps, std::endian order)
      : block(1, order), reports(spes, order), marks(steps.size(), order), units_(steps.size(), order),
        strips_(spes, order) {
    for (std::size_t unit = 0; unit < steps.size(); ++unit)
      units_[unit].bundles = steps[unit];
    units_.publish();
    block[0].units = units_.ea();
    block[0].costs = marks.ea();
    block[0].strips = strips_.ea();
    block[0].reports = reports.ea();
    block[0].unit_count = static_cast<std::uint32_t>(steps.size());
  }

  /// Before the SPEs are told of a frame. `lambda` in parts of 2^-16.
  void begin(const std::vector<UnitRange>& strips, std::uint32_t lambda) {
    for (std::size_t spe = 0; spe < strips.size(); ++spe)
      strips_[spe] = {strips[spe].first, strips[spe].first + strips[spe].count, {}};
    strips_.publish();
    reports.clear();
    marks.clear();
    ++block[0].epoch;
    block[0].exchange_parameter = lambda;
    block.publish();
  }
  /// Once all have left it.
  void end() {
    reports.fetch();
    marks.fetch();
  }

  SharedRecords<kernel::FrameBlock> block;
  SharedRecords<WorkReport> reports;  ///< by SPE
  SharedRecords<std::uint32_t> marks; ///< by unit: what the program wrote in place of its cost

private:
  SharedRecords<kernel::UnitRecord> units_;
  SharedRecords<kernel::StripRecord> strips_;
};

} // namespace celltrace::test
