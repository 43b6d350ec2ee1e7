// The program of an SPE that searches: takes jobs from main memory record by record, while the next record is
// fetched, and passes them on. Kernel dialect.
#pragma once

#include "kernel/entry/strategies.hpp"
#include "kernel/models/doorbell.hpp"
#include "kernel/models/search_stages.hpp"
#include "kernel/models/stage.hpp"

namespace celltrace::kernel::models {

template <class Spu> class Searcher {
public:
  Searcher(Spu& spu, ea_t block)
      : spu_(spu), stage_(spu, block), orders_(stage_.orders()), doorbell_(spu, orders_),
        scene_(spu, cache_config(stage_.frame()), stage_.frame().image),
        slots_(spu.template allocate<Slot>(2)), whole_(scene_, stage_.frame()), walk_(scene_, stage_.frame()),
        tests_(scene_, stage_.frame()) {}

  void run() {
    Item item;
    bool ahead = false; // true while `item` is being fetched
    while (ahead || wait_for_job(item)) {
      if (!ahead) fetch(item);
      Slot& slot = slots_[current_];
      spu_.wait_all(1u << (kFirstGetTag + current_));
      if (item.index == 0) {
        spu_.compute(model_work::kJob);
        job_ = slot.job;
        live_ = 0;
      }
      const Item present = item;
      const bool last = !next_search(item);
      current_ ^= 1;
      ahead = !last || next_job(item);
      if (ahead) fetch(item);
      current_ ^= 1;
      work(present, slot);
      if (last) hand_on(present.context, slot);
      current_ ^= 1;
    }
    spu_.wait_all(1u << kPutTag);
    scene_.cache().settle();
    report();
  }

private:
  static constexpr uint32_t kFirstGetTag = 8;
  /// Tag of all puts: an SPE that is rung after the last record of a job finds all records in main memory.
  static constexpr uint32_t kPutTag = 10;

  struct Slot {
    JobRecord job;
    SearchRecord search;
    OutgoingWord word;
  };
  struct Item {
    uint32_t context = 0, index = 0;
  };

  ea_t place_of(const Item& item) const {
    return orders_.jobs + static_cast<ea_t>(item.context) * orders_.job_bytes + sizeof(JobRecord) +
           static_cast<ea_t>(item.index) * sizeof(SearchRecord);
  }
  /// Returns true in the split pipeline, where records travel with the positions of their rays.
  bool split() const { return stage_.has(task::walk | task::test); }

  /// Waits for the first search of a job. Returns false if the frame is over.
  bool wait_for_job(Item& item) {
    while (!next_job(item)) {
      if (doorbell_.take(bell::quit)) return false;
      doorbell_.wait();
    }
    return true;
  }
  bool next_job(Item& item) {
    doorbell_.poll();
    item.index = 0;
    return doorbell_.take_context(item.context);
  }
  bool next_search(Item& item) const {
    while (++item.index < job_.searches) {
      if (!split() || (job_.live >> bit_of(item.index) & 1) != 0) return true;
    }
    return false;
  }
  static uint32_t bit_of(uint32_t index) { return index < 31 ? index : 31; }

  void fetch(const Item& item) {
    Slot& slot = slots_[current_];
    // Earlier puts from this slot have to be complete, and so have puts to the source, if the job was here
    // before.
    spu_.wait_all(1u << kPutTag);
    const uint32_t head = item.index == 0 ? static_cast<uint32_t>(sizeof(JobRecord)) : 0u;
    const uint32_t bytes = split() ? static_cast<uint32_t>(sizeof(SearchRecord)) : search_part::question;
    uint8_t* const to = reinterpret_cast<uint8_t*>(&slot.search) - head;
    spu_.get(to, place_of(item) - head, head + bytes, kFirstGetTag + current_);
  }

  void work(const Item& item, Slot& slot) {
    SearchRecord& search = slot.search;
    if (split() && (job_.live >> bit_of(item.index) & 1) == 0) return;
    spu_.compute(model_work::kSearch);
    ++searches_;
    if (!split())
      whole_.run(search);
    else if (walking())
      walk_.run(search, [&](SearchRecord& first) { tests_.test_unbounded(first); });
    else
      tests_.run(search);
    const bool over = !split() || search.pending == 0;
    if (over)
      count_primary(search, stage_.stage_report());
    else
      live_ |= 1u << bit_of(item.index);
    uint8_t* const from = reinterpret_cast<uint8_t*>(&search) + search_part::answer_offset;
    spu_.put(from, place_of(item) + search_part::answer_offset,
             split() ? search_part::progress : search_part::answer, kPutTag);
  }
  bool walking() const { return static_cast<JobStage>(job_.stage) == JobStage::walk; }

  /// Hands a job to the next SPE: rays in voxels to the tester, rays without a hit there back to the walker,
  /// and answers to the shader.
  void hand_on(uint32_t context, Slot& slot) {
    ++stage_.stage_report().jobs;
    uint32_t to = orders_.shader[context];
    if (live_ != 0) {
      to = walking() ? orders_.tester[context] : orders_.searcher[context];
      slot.job = job_;
      slot.job.live = live_;
      slot.job.stage = static_cast<uint32_t>(walking() ? JobStage::test : JobStage::walk);
      spu_.put(&slot.job, place_of({context, 0}) - sizeof(JobRecord), sizeof(JobRecord), kPutTag);
    }
    ring_behind(spu_, to, 1u << context, slot.word, kPutTag);
  }

  void report() {
    StageReport& stage_report = stage_.stage_report();
    stage_report.searches = searches_;
    stage_report.returns = tests_.returns();
    ReportRecord& report = stage_.report();
    const TraversalCounters& counters = split() ? tests_.counters() : whole_.counters();
    for (uint32_t kind = 0; kind < kObjectKinds; ++kind)
      report.tests[kind] = counters.tests[kind];
    report.accelerator_visits = split() ? walk_.voxels() : counters.visits;
    stage_.add_cache(scene_);
    stage_.send_reports();
  }

  Spu& spu_;
  Stage<Spu> stage_;
  const StageBlock& orders_;
  Doorbell<Spu> doorbell_;
  SceneAccess<Spu> scene_;
  Slot* slots_;
  uint32_t current_ = 0;
  JobRecord job_;
  uint32_t live_ = 0;
  uint64_t searches_ = 0;
  WholeSearch<Spu> whole_;
  GridWalk<Spu> walk_;
  VoxelTests<Spu> tests_;
};

/// Runs the program; `argument` is the effective address of the SPE's StageBlock.
template <class Spu> void searcher(Spu& spu, ea_t argument) {
  Searcher<Spu>(spu, argument).run();
}

} // namespace celltrace::kernel::models
