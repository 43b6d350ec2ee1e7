// IssueModel computes the cycles in which an SPU issues instructions: in order, at most two a cycle, with the
// latencies of TimingParameters.
//
//   fetch group   Two instructions at an 8-byte boundary. They issue together if the first goes to the even
//                 pipe, the second to the odd one, and the operands of both are there; the next group issues
//                 only when both have issued.
//   dependency    A result can be used when its unit's latency has passed.
//   branches      Fall through unless a hint predicts otherwise. A wrong prediction costs `branch_miss`.
//                 A hint counts for its branch `hint_distance` instructions later; if `hint_latency` has
//                 not passed, the branch waits for it.
//   double        Keeps both pipes for `double_issue_block` cycles.
//   fetch         32 instructions at a time, when neither a load nor a store takes the local store's only
//                 port: if they take it in every cycle, the next 32 instructions come late.
//   DMA           Takes the port for a cycle a line, before loads and stores.
//
// Source: IBM SDK 3.0 programming tutorial (pipelines, dual issue, hints, priorities of the local store's
// port). The buffers of the fetch unit are not modelled line by line.
#pragma once

#include "backends/cell_emu/cycle.hpp"
#include "backends/cell_emu/isa/instruction.hpp"
#include "celltrace/spe/timing.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace celltrace::cell_emu {

/// The reason why an instruction did not issue earlier.
enum class StallReason : std::uint8_t { dependency, branch_miss, prefetch_miss, hint_target, fp_resource };
constexpr unsigned kStallReasons = static_cast<unsigned>(StallReason::fp_resource) + 1;

/// The model of one SPU. Thread safety: none.
class IssueModel {
public:
  explicit IssueModel(const TimingParameters& timing);

  /// Issues the instruction at `pc`, the next instruction that the program executes.
  void issue(const isa::Instruction& instruction, std::uint32_t pc) {
    const unsigned unit = static_cast<unsigned>(instruction.unit);
    ++units_[unit];
    if ((pc & (kFetchBytes - 1)) == 0) enter_line();
    const Cycle ready = std::max(std::max(ready_[instruction.source[0]], ready_[instruction.source[1]]),
                                 ready_[instruction.source[2]]);
    const bool nop = instruction.unit == isa::Unit::nop || instruction.unit == isa::Unit::lnop;
    if (pc == pair_ && ready <= last_ && !isa::is_even(instruction.unit)) {
      // The instruction issues together with the instruction before.
      dual_cycle_ += !nop && !last_is_nop_;
      single_cycle_ += static_cast<std::uint64_t>(!nop && last_is_nop_) - (!nop && !last_is_nop_);
      nop_cycle_ -= !nop && last_is_nop_;
      pair_ = kNoPair;
    } else {
      ++last_;
      if (ready > last_) [[unlikely]]
        wait_for_operands(instruction, ready);
      if (blocked_ > last_) [[unlikely]]
        stall(StallReason::fp_resource, blocked_);
      single_cycle_ += !nop;
      nop_cycle_ += nop;
      last_is_nop_ = nop;
      pair_ = (pc & 4) == 0 && isa::is_even(instruction.unit) ? pc + 4 : kNoPair;
    }
    line_accesses_ += instruction.unit == isa::Unit::ls;
    if (instruction.unit == isa::Unit::fpd) [[unlikely]]
      blocked_ = last_ + 1 + timing_.double_issue_block;
    ready_[instruction.target] = last_ + latency_[unit];
    producer_[instruction.target] = instruction.unit;
    ready_[isa::kNoRegister] = 0;
  }

  /// Notes that the branch at `pc` has continued at `next`. Call this after issue() of every branch, also if
  /// the branch was not taken.
  void branched(std::uint32_t pc, std::uint32_t next, bool taken);
  /// Notes a hint that the branch at `branch` goes to `target`.
  void hint(std::uint32_t branch, std::uint32_t target) { hint_ = {branch, target, last_, instructions()}; }
  /// Advances by cycles in which the SPU waited, such as at a channel. take() does not count these cycles.
  void pass(Cycle cycles) {
    last_ += cycles;
    taken_ += cycles;
  }
  /// Notes that DMA has moved `dma_lines` lines through the local store's port since the last take().
  void contend(std::uint64_t dma_lines);

  /// Returns the counts since the last take().
  SpuCycles take();

  /// Returns the cycle of the last issue, which is the same for two instructions that issue together.
  Cycle last() const { return last_; }
  /// Returns the cycles that were lost for this reason since the last forget_recent(), for a profile.
  Cycle recent(StallReason reason) const { return recent_[static_cast<unsigned>(reason)]; }
  void forget_recent() { recent_ = {}; }

private:
  static constexpr unsigned kUnits = static_cast<unsigned>(isa::Unit::lnop) + 1;
  static constexpr std::uint32_t kFetchBytes = 128;
  static constexpr std::uint32_t kNoPair = ~0u;

  struct Hint {
    std::uint32_t branch = kNoPair;
    std::uint32_t target = 0;
    Cycle issued = 0;
    std::uint64_t instructions = 0;
  };

  void wait_for_operands(const isa::Instruction& instruction, Cycle ready);
  void enter_line();
  void stall(StallReason reason, Cycle until);
  std::uint64_t instructions() const;

  const TimingParameters timing_;
  std::array<std::uint8_t, kUnits> latency_{};
  /// By register: cycle from which on its value can be used; the last element is for kNoRegister.
  std::array<Cycle, 129> ready_{};
  std::array<isa::Unit, 129> producer_{};
  Cycle last_ = 0;
  Cycle blocked_ = 0;
  /// Address of the instruction that may issue together with the last one, or kNoPair.
  std::uint32_t pair_ = kNoPair;
  bool last_is_nop_ = false;
  Cycle line_entered_ = 0;
  std::uint64_t line_accesses_ = 0; ///< loads and stores since line_entered_
  Hint hint_;

  Cycle taken_ = 0; ///< cycle up to which take() has counted
  std::array<std::uint64_t, kUnits> units_{};
  std::array<std::uint64_t, kUnits> dependency_{}; ///< stalls, by the unit whose result was waited for
  std::array<Cycle, kStallReasons> stalls_{};      ///< by StallReason
  std::array<Cycle, kStallReasons> recent_{};      ///< stalls that a profile has not seen yet
  std::uint64_t issued_before_ = 0;                ///< instructions that take() has counted
  std::uint64_t single_cycle_ = 0, dual_cycle_ = 0, nop_cycle_ = 0;
  std::uint64_t contention_ = 0, branch_taken_ = 0, branch_miss_ = 0, hint_hit_ = 0;
};

} // namespace celltrace::cell_emu
