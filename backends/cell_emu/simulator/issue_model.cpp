#include "backends/cell_emu/simulator/issue_model.hpp"

#include <algorithm>
#include <numeric>

namespace celltrace::cell_emu {

using isa::Unit;

IssueModel::IssueModel(const TimingParameters& timing) : timing_(timing) {
  const auto set = [&](Unit unit, std::uint32_t latency) {
    latency_[static_cast<unsigned>(unit)] = static_cast<std::uint8_t>(std::min(latency, 255u));
  };
  set(Unit::fx2, timing.simple_fixed);
  set(Unit::fx3, timing.shift);
  set(Unit::fxb, timing.byte_operation);
  set(Unit::fp6, timing.float_operation);
  set(Unit::fp7, timing.float_conversion);
  set(Unit::fpd, timing.double_operation);
  set(Unit::ls, timing.load_store);
  set(Unit::shuf, timing.shuffle);
  set(Unit::br, timing.branch);
  set(Unit::spr, timing.channel_read);
}

std::uint64_t IssueModel::instructions() const {
  return issued_before_ + std::accumulate(units_.begin(), units_.end(), std::uint64_t{0});
}

void IssueModel::stall(StallReason reason, Cycle until) {
  stalls_[static_cast<unsigned>(reason)] += until - last_;
  recent_[static_cast<unsigned>(reason)] += until - last_;
  last_ = until;
}

void IssueModel::wait_for_operands(const isa::Instruction& instruction, Cycle ready) {
  unsigned slowest = 0;
  for (unsigned i = 1; i < 3; ++i)
    if (ready_[instruction.source[i]] > ready_[instruction.source[slowest]]) slowest = i;
  dependency_[static_cast<unsigned>(producer_[instruction.source[slowest]])] += ready - last_;
  stall(StallReason::dependency, ready);
}

void IssueModel::enter_line() {
  // The instructions of this line have not been fetched in time if loads and stores took the port in every
  // cycle since the last line.
  const Cycle passed = last_ - line_entered_;
  if (passed != 0 && line_accesses_ >= passed) stall(StallReason::prefetch_miss, last_ + timing_.fetch_miss);
  line_entered_ = last_;
  line_accesses_ = 0;
}

void IssueModel::branched(std::uint32_t pc, std::uint32_t next, bool taken) {
  const bool hinted = hint_.branch == pc && instructions() - hint_.instructions > timing_.hint_distance;
  if (hinted && last_ < hint_.issued + timing_.hint_latency)
    stall(StallReason::hint_target, hint_.issued + timing_.hint_latency);
  branch_taken_ += taken;
  if (next == (hinted ? hint_.target : pc + 4)) {
    hint_hit_ += hinted;
  } else {
    ++branch_miss_;
    stall(StallReason::branch_miss, last_ + timing_.branch_miss);
  }
  if (!taken) return;
  pair_ = kNoPair;
  line_entered_ = last_;
  line_accesses_ = 0;
}

void IssueModel::contend(std::uint64_t dma_lines) {
  const std::uint64_t cycles = last_ - taken_;
  if (cycles == 0) return;
  const std::uint64_t accesses = units_[static_cast<unsigned>(Unit::ls)];
  // The share of DMA lines that collide with a load or store is the share of cycles in which loads and stores
  // take the port.
  const std::uint64_t met = std::min(dma_lines * accesses / cycles, accesses);
  contention_ += met;
  last_ += met;
}

SpuCycles IssueModel::take() {
  const auto units = [&](Unit unit) { return units_[static_cast<unsigned>(unit)]; };
  const auto dependency = [&](Unit unit) { return dependency_[static_cast<unsigned>(unit)]; };
  const auto stalls = [&](StallReason reason) { return stalls_[static_cast<unsigned>(reason)]; };
  SpuCycles cycles;
  cycles.total_cycle = last_ - taken_;
  cycles.single_cycle = single_cycle_;
  cycles.dual_cycle = dual_cycle_;
  cycles.nop_cycle = nop_cycle_;
  cycles.stall_due_to_dependency = stalls(StallReason::dependency);
  cycles.stall_due_to_branch_miss = stalls(StallReason::branch_miss);
  cycles.stall_due_to_prefetch_miss = stalls(StallReason::prefetch_miss);
  cycles.stall_due_to_hint_target = stalls(StallReason::hint_target);
  cycles.stall_due_to_fp_resource = stalls(StallReason::fp_resource);
  cycles.stall_due_to_ls_contention = contention_;
  cycles.fx2 = units(Unit::fx2);
  cycles.fx3 = units(Unit::fx3);
  cycles.fxb = units(Unit::fxb);
  cycles.fp6 = units(Unit::fp6);
  cycles.fp7 = units(Unit::fp7);
  cycles.fpd = units(Unit::fpd);
  cycles.ls = units(Unit::ls);
  cycles.shuf = units(Unit::shuf);
  cycles.br = units(Unit::br);
  cycles.hbr = units(Unit::hbr);
  cycles.spr = units(Unit::spr);
  cycles.nop = units(Unit::nop) + units(Unit::lnop);
  cycles.dependency_fx2 = dependency(Unit::fx2);
  cycles.dependency_fx3 = dependency(Unit::fx3);
  cycles.dependency_fxb = dependency(Unit::fxb);
  cycles.dependency_fp6 = dependency(Unit::fp6);
  cycles.dependency_fp7 = dependency(Unit::fp7);
  cycles.dependency_fpd = dependency(Unit::fpd);
  cycles.dependency_ls = dependency(Unit::ls);
  cycles.dependency_shuf = dependency(Unit::shuf);
  cycles.dependency_br = dependency(Unit::br);
  cycles.dependency_spr = dependency(Unit::spr);
  cycles.branch_taken = branch_taken_;
  cycles.branch_taken_miss = branch_miss_;
  cycles.hint_hit = hint_hit_;
  issued_before_ = instructions();
  taken_ = last_;
  units_ = {};
  dependency_ = {};
  stalls_ = {};
  single_cycle_ = dual_cycle_ = nop_cycle_ = contention_ = branch_taken_ = branch_miss_ = hint_hit_ = 0;
  return cycles;
}

} // namespace celltrace::cell_emu
