// A program that balances loads, without work behind them, by generalized dimension exchange on any system
// graph: each SPE is a node, neighbours exchange their loads by mailbox. Kernel dialect.
#pragma once

#include "celltrace/spe/spu.hpp"
#include "celltrace/spe/types.hpp"

#include <stdint.h>

namespace celltrace::test {

constexpr uint32_t kMaxNodes = 16;
/// A word in a mailbox has the sender above its load.
constexpr uint32_t kLoadBits = 24;
constexpr uint32_t kNoPartner = 0xFFFFFFFFu;

/// With whom a node exchanges, colour by colour of the edges.
struct alignas(128) PartnerRecord {
  uint32_t partner[kLineBytes / 4]; ///< id or kNoPartner
};
static_assert(sizeof(PartnerRecord) == 128, "crosses DMA");

struct alignas(16) LoadRecord {
  uint32_t load; ///< below 2^kLoadBits
  uint32_t unused[3];
};
static_assert(sizeof(LoadRecord) == 16, "crosses DMA");

struct alignas(16) SweepTask {
  ea_t partners; ///< PartnerRecord per SPE
  ea_t loads;    ///< LoadRecord per SPE: what it begins with, and behind those of all, what it has after each
                 ///< sweep
  uint32_t colours;
  uint32_t sweeps;
  uint32_t exchange_parameter; ///< lambda, 16-bit fixed point
  uint32_t unused;
};
static_assert(sizeof(SweepTask) == 32, "crosses DMA");

/// A neighbour sends the word of its next exchange with this node only once it has had this one's word of the
/// exchange before. So there are at most as many unread words as neighbours, and one more of that with which
/// this node is exchanging: mailboxes of four entries suffice for three neighbours.
template <class Spu> class SweepingNode {
public:
  SweepingNode(Spu& spu, ea_t argument)
      : spu_(spu), task_(*spu.template allocate<SweepTask>()),
        partners_(*spu.template allocate<PartnerRecord>()), record_(*spu.template allocate<LoadRecord>()) {
    fetch(&task_, argument, sizeof task_);
    fetch(&partners_, task_.partners + spu.id() * sizeof partners_, sizeof partners_);
    fetch(&record_, load_after(0), sizeof record_);
    for (uint32_t& load : early_)
      load = kNothing;
  }

  void run() {
    for (uint32_t sweep = 1; sweep <= task_.sweeps; ++sweep) {
      for (uint32_t colour = 0; colour < task_.colours; ++colour) {
        if (partners_.partner[colour] != kNoPartner) exchange(partners_.partner[colour]);
      }
      spu_.put(&record_, load_after(sweep), sizeof record_, kTag);
      spu_.wait_all(1u << kTag);
    }
  }

private:
  static constexpr uint32_t kTag = 0;
  static constexpr uint32_t kNothing = 0xFFFFFFFFu;

  ea_t load_after(uint32_t sweep) const {
    return task_.loads + (sweep * spu_.count() + spu_.id()) * sizeof(LoadRecord);
  }

  /// Both sides compute the same flow, from the greater load to the smaller.
  void exchange(uint32_t partner) {
    spu_.send_mailbox(partner, spu_.id() << kLoadBits | record_.load);
    const uint32_t other = receive(partner);
    if (record_.load > other)
      record_.load -= flow(record_.load - other);
    else
      record_.load += flow(other - record_.load);
  }
  uint32_t flow(uint32_t difference) const {
    return static_cast<uint32_t>(uint64_t{difference} * task_.exchange_parameter >> 16);
  }

  /// The partner's load. Words of others are for exchanges to come.
  uint32_t receive(uint32_t partner) {
    while (early_[partner] == kNothing) {
      const uint32_t word = spu_.read_in_mailbox();
      uint32_t& place = early_[word >> kLoadBits & (kMaxNodes - 1)];
      if (place != kNothing) spu_.halt(HaltCode::internal_error);
      place = word & ((1u << kLoadBits) - 1);
    }
    const uint32_t load = early_[partner];
    early_[partner] = kNothing;
    return load;
  }

  void fetch(void* ls, ea_t ea, uint32_t bytes) {
    spu_.get(ls, ea, bytes, kTag);
    spu_.wait_all(1u << kTag);
  }

  Spu& spu_;
  SweepTask& task_;
  PartnerRecord& partners_;
  LoadRecord& record_;
  uint32_t early_[kMaxNodes]; ///< by node: the load that it has sent for the next exchange, or kNothing
};

/// The program; `argument` is the ea of the SweepTask.
template <class Spu> void load_sweeps(Spu& spu, ea_t argument) {
  SweepingNode<Spu>(spu, argument).run();
}

} // namespace celltrace::test
