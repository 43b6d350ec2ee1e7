// The first stage: gives free contexts the next packets of primary rays, and detects the end of the frame.
// Kernel dialect.
#pragma once

#include "kernel/cameras/primary_rays.hpp"
#include "kernel/models/job_sender.hpp"
#include "kernel/models/model_work.hpp"
#include "records/report.hpp"

namespace celltrace::kernel::models {

template <class Spu> class PrimaryFeed {
public:
  using S = typename Spu::simd;

  PrimaryFeed(Spu& spu, const StageBlock& stage, const FrameBlock& frame, JobSender<Spu>& sender)
      : spu_(spu), stage_(stage), frame_(frame), sender_(sender), row_(stage.first_row),
        slots_(spu.template allocate<Slot>(kSlots)) {}

  /// Accepts a context that is free for the first time, or because its packet is complete.
  void release(uint32_t context) {
    const uint32_t bit = 1u << context;
    reported_ |= bit;
    if ((busy_ & bit) != 0) ++completed_;
    busy_ &= ~bit;
    if (row_ < frame_.packet_rows && !stopped_) {
      busy_ |= bit;
      issue(context);
    }
    report();
  }
  /// Stops issuing packets.
  void stop() {
    stopped_ = true;
    report();
  }

  /// Tag groups of all puts.
  static constexpr uint32_t kTags = 0xFu << 24;

private:
  static constexpr uint32_t kSlots = 4;
  static constexpr uint32_t kFirstTag = 24;

  /// A packet on its way to main memory.
  struct Slot {
    JobRecord job;
    SearchRecord search;
    OutgoingWord word;
  };

  void issue(uint32_t context) {
    spu_.compute(model_work::kJob);
    Slot& slot = slots_[slot_];
    const uint32_t tag = kFirstTag + slot_;
    slot_ = (slot_ + 1) % kSlots;
    spu_.wait_all(1u << tag);
    sender_.wait_until_sent(context);
    slot.job.searches = 1;
    slot.job.live = 1;
    slot.job.column = column_;
    slot.job.row = row_;
    slot.search.lanes = lanes_in_picture(frame_, column_, row_) &
                        make_primary_rays(spu_, frame_, column_, row_, slot.search.rays);
    slot.search.kind = static_cast<uint32_t>(SearchKind::closest);
    slot.search.primary = 1;
    slot.search.reflected = 0;
    spu_.put(&slot.job, sender_.job(context), sizeof(JobRecord) + search_part::question, tag);
    sender_.send(context, slot.word, tag);
    if (++column_ == frame_.packet_columns) {
      column_ = 0;
      row_ += stage_.row_step;
    }
  }

  /// Tells the PPE how far the frame is, if the PPE listens, and when the frame is complete. A frame is
  /// complete only after every shader has reported: nothing may ring in an SPE that has left.
  void report() {
    const bool all_issued = stopped_ || row_ >= frame_.packet_rows;
    const bool complete = all_issued && busy_ == 0 && (reported_ & stage_.announced) == stage_.announced;
    if (complete && !finished_) {
      finished_ = true;
      spu_.write_out_mailbox(make_report(ReportKind::finished, completed_));
    } else if (!finished_ && (completed_ & 15) == 0 && spu_.out_mailbox_count() != 0) {
      spu_.write_out_mailbox(make_report(ReportKind::progress, completed_));
    }
  }

  Spu& spu_;
  const StageBlock& stage_;
  const FrameBlock& frame_;
  JobSender<Spu>& sender_;
  uint32_t column_ = 0;
  uint32_t row_;
  Slot* slots_;
  uint32_t slot_ = 0;
  uint32_t reported_ = 0; ///< contexts that have reported
  uint32_t busy_ = 0;
  uint32_t completed_ = 0; ///< number of packets
  bool stopped_ = false;
  bool finished_ = false;
};

} // namespace celltrace::kernel::models
