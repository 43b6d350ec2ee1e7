// Writer of searches, which leave for main memory as one job: while jobs leave, the next one is written.
// Kernel dialect.
#pragma once

#include "kernel/models/job_sender.hpp"
#include "kernel/models/model_work.hpp"

namespace celltrace::kernel::models {

template <class Spu> class SearchWriter {
public:
  /// Tag groups of all puts.
  static constexpr uint32_t kTags = 0xFu << 10;

  SearchWriter(Spu& spu, JobSender<Spu>& sender)
      : spu_(spu), sender_(sender), sets_(spu.template allocate<Set>(kSets)) {}

  void begin(uint32_t context) {
    context_ = context;
    current_ = (current_ + 1) % kSets;
    count_ = 0;
    spu_.wait_all(1u << tag());
  }
  /// Returns room for the next search, whose question the caller writes.
  SearchRecord& next() {
    if (count_ != 0 && count_ % kRecords == 0) spu_.wait_all(1u << tag());
    return sets_[current_].searches[count_ % kRecords];
  }
  /// Puts the search that the caller has written.
  void put() {
    SearchRecord& search = sets_[current_].searches[count_ % kRecords];
    search.walked = 0;
    spu_.compute(model_work::kSearch);
    spu_.put(&search, sender_.search(context_, count_), search_part::question, tag());
    ++count_;
  }
  uint32_t count() const { return count_; }
  /// Sends the job, after put() of all its searches, of which there must be at least one.
  void send() {
    Set& set = sets_[current_];
    set.job.searches = count_;
    set.job.live = count_ >= 32 ? ~0u : (1u << count_) - 1;
    spu_.compute(model_work::kJob);
    spu_.put(&set.job, sender_.job(context_), sizeof(JobRecord), tag());
    sender_.send(context_, set.word, tag());
  }

private:
  static constexpr uint32_t kFirstTag = 10;
  static constexpr uint32_t kSets = 4;
  static constexpr uint32_t kRecords = 2;

  struct Set {
    JobRecord job;
    SearchRecord searches[kRecords];
    OutgoingWord word;
  };

  uint32_t tag() const { return kFirstTag + current_; }

  Spu& spu_;
  JobSender<Spu>& sender_;
  Set* sets_;
  uint32_t current_ = 0;
  uint32_t context_ = 0;
  uint32_t count_ = 0;
};

} // namespace celltrace::kernel::models
