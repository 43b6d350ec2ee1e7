// Choice of the searcher for a job: the one that the job's context belongs to, or the one with the fewest
// jobs. Kernel dialect.
#pragma once

#include "kernel/models/doorbell.hpp"
#include "kernel/models/search_record.hpp"

namespace celltrace::kernel::models {

template <class Spu> class JobSender {
public:
  JobSender(Spu& spu, const StageBlock& stage)
      : spu_(spu), stage_(stage), load_(spu.template allocate<uint8_t>(kMaxSearchers, 16)) {}

  /// Return the effective addresses of a context's job and of its searches.
  ea_t job(uint32_t context) const { return stage_.jobs + static_cast<ea_t>(context) * stage_.job_bytes; }
  ea_t search(uint32_t context, uint32_t index) const {
    return job(context) + sizeof(JobRecord) + static_cast<ea_t>(index) * sizeof(SearchRecord);
  }

  /// Sends the job of a context, which commands of `tag` are putting to main memory.
  void send(uint32_t context, OutgoingWord& word, uint32_t tag) {
    ++jobs_;
    sent_under_[context] = 1u << tag;
    if ((stage_.tasks & task::dispatch) == 0) {
      ring_behind(spu_, stage_.searcher[context], 1u << context, word, tag);
      return;
    }
    const uint32_t searcher = least_loaded();
    if (load_[searcher] == kJobsPerSearcher) {
      waiting_ |= 1u << context;
      return;
    }
    assign(context, searcher);
    word.value = 1u << context;
    spu_.putf(&word.value, spu_.addresses(stage_.first_searcher + searcher).in_mailbox, 4, tag);
  }
  /// Accounts for the answer to a context's job, and assigns a waiting job to the free searcher. Every put of
  /// waiting jobs is complete when `tags` are.
  void answered(uint32_t context, uint32_t tags) {
    if ((stage_.tasks & task::dispatch) == 0) return;
    const uint32_t searcher = assigned_[context];
    --load_[searcher];
    if (waiting_ == 0) return;
    const uint32_t next = static_cast<uint32_t>(__builtin_ctz(waiting_));
    waiting_ &= waiting_ - 1;
    assign(next, searcher);
    spu_.wait_all(tags);
    spu_.send_mailbox(stage_.first_searcher + searcher, 1u << next);
  }

  /// Waits until all puts of the context's last job are complete, so that its memory may be reused.
  void wait_until_sent(uint32_t context) {
    if (sent_under_[context] != 0) spu_.wait_all(sent_under_[context]);
  }

  uint64_t jobs() const { return jobs_; }

private:
  static constexpr uint32_t kMaxSearchers = 256;
  /// Jobs per searcher: one to work on, and one to fetch meanwhile.
  static constexpr uint32_t kJobsPerSearcher = 2;

  uint32_t least_loaded() {
    uint32_t least = next_;
    for (uint32_t i = 0, searcher = next_; i < stage_.searchers && load_[least] != 0; ++i) {
      if (load_[searcher] < load_[least]) least = searcher;
      searcher = searcher + 1 == stage_.searchers ? 0 : searcher + 1;
    }
    next_ = least + 1 == stage_.searchers ? 0 : least + 1;
    return least;
  }
  void assign(uint32_t context, uint32_t searcher) {
    assigned_[context] = static_cast<uint8_t>(searcher);
    ++load_[searcher];
  }

  Spu& spu_;
  const StageBlock& stage_;
  uint8_t* load_; ///< index: searcher; number of jobs
  uint8_t assigned_[kMaxContexts];
  uint32_t sent_under_[kMaxContexts] = {}; ///< index: context; tag groups
  uint32_t waiting_ = 0;                   ///< contexts whose jobs have no searcher yet
  uint32_t next_ = 0;                      ///< searcher to consider first
  uint64_t jobs_ = 0;
};

} // namespace celltrace::kernel::models
