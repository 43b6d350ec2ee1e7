// Common parts of all programs of a pipeline: orders, scene, reports. Kernel dialect.
#pragma once

#include "kernel/models/stage_block.hpp"
#include "kernel/scene_access.hpp"

namespace celltrace::kernel::models {

template <class Spu> class Stage {
public:
  /// Fetches the orders; `block` is the effective address of the StageBlock.
  Stage(Spu& spu, ea_t block)
      : spu_(spu), orders_(*spu.template allocate<StageBlock>()),
        frame_(*spu.template allocate<FrameBlock>()), report_(*spu.template allocate<ReportRecord>()),
        stage_report_(*spu.template allocate<StageReport>()) {
    fetch(&orders_, block, sizeof(StageBlock));
    fetch(&frame_, orders_.frame, sizeof(FrameBlock));
  }

  const StageBlock& orders() const { return orders_; }
  const FrameBlock& frame() const { return frame_; }
  ReportRecord& report() { return report_; }
  StageReport& stage_report() { return stage_report_; }
  bool has(uint32_t tasks) const { return (orders_.tasks & tasks) != 0; }

  /// Adds the counters of the software cache to the report.
  void add_cache(SceneAccess<Spu>& scene) {
    for (uint32_t kind = 0; kind < kDataKinds; ++kind) {
      const CacheCounters counters = scene.cache().counters(static_cast<DataKind>(kind));
      report_.cache_hits[kind] += counters.hits;
      report_.cache_misses[kind] += counters.misses;
    }
  }
  void send_reports() {
    spu_.put(&report_, frame_.reports + spu_.id() * sizeof(ReportRecord), sizeof(ReportRecord), kTag);
    spu_.put(&stage_report_, orders_.report, sizeof(StageReport), kTag);
    spu_.wait_all(1u << kTag);
  }

private:
  static constexpr uint32_t kTag = 0;

  void fetch(void* ls, ea_t ea, uint32_t bytes) {
    spu_.get(ls, ea, bytes, kTag);
    spu_.wait_all(1u << kTag);
  }

  Spu& spu_;
  StageBlock& orders_;
  FrameBlock& frame_;
  ReportRecord& report_;
  StageReport& stage_report_;
};

} // namespace celltrace::kernel::models
