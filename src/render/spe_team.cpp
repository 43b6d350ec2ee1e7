#include "render/spe_team.hpp"

#include "render/held_progress.hpp"
#include "render/tracer_program.hpp"

#include <algorithm>
#include <exception>
#include <numeric>
#include <utility>

namespace celltrace {

using namespace kernel;

SpeTeam::SpeTeam(Machine& machine, SharedRecords<FrameBlock>& frame, AcceleratorKind accelerator)
    : machine_(machine), frame_(frame), lines_(0, machine.byte_order()), members_(machine.spe_count()),
      accelerator_(accelerator) {
  for (unsigned spe = 0; spe < members_.size(); ++spe)
    members_[spe].spe = spe;
  assemble();
}

SpeTeam::~SpeTeam() {
  try {
    dismiss();
  } catch (const std::exception&) {
    // A failed SPE was reported by the call that noticed it; here it only has to stop.
    machine_.interrupt();
  }
}

void SpeTeam::assemble() {
  if (std::exchange(assembled_, true)) return;
  const bool by_grid = accelerator_ == AcceleratorKind::grid && !machine_.direct_memory();
  const SpeProgram program = by_grid ? grid_tracer_program() : tracer_program();
  for (unsigned spe = 0; spe < members_.size(); ++spe)
    machine_.start(spe, program, frame_.ea());
}

void SpeTeam::dismiss() {
  if (!std::exchange(assembled_, false)) return;
  signal_all(command::quit);
  for (unsigned spe = 0; spe < members_.size(); ++spe)
    machine_.wait(spe);
}

bool SpeTeam::prepare_frame(unsigned spes, const std::function<void()>& poll) {
  is_cancellable_ = static_cast<bool>(poll);
  for (Member& member : members_)
    member.answered = member.spe >= spes;
  signal_first(spes, command::prepare_frame);
  bool built = true;
  while (!all_answered()) {
    receive([&](Member& member, ReportKind kind, std::uint32_t) {
      if (kind == ReportKind::needs_memory) built = false;
      member.answered = member.answered || kind == ReportKind::prepared || kind == ReportKind::needs_memory;
    });
    if (poll) poll();
  }
  return built;
}

void SpeTeam::synchronize() {
  frame_[0].work_entries = kAllLines;
  command_synchronize();
}

void SpeTeam::synchronize(std::span<const std::uint32_t> lines) {
  lines_.assign(lines);
  frame_[0].work_memory[0] = lines_.ea();
  frame_[0].work_entries = static_cast<std::uint32_t>(lines.size());
  command_synchronize();
}

void SpeTeam::command_synchronize() {
  for (Member& member : members_)
    member.answered = false;
  signal_all(command::synchronize);
  while (!all_answered())
    receive_answers(ReportKind::synchronised);
}

bool SpeTeam::render_frame(StripTally& tally, const Progress& progress, const UnitDone& unit_done) {
  HeldProgress held(progress);
  is_cancellable_ = static_cast<bool>(progress);
  for (unsigned spe = 0; spe < members_.size(); ++spe)
    members_[spe] = Member{spe, 0, false};
  signal_all(command::render_frame);
  bool go_on = held.report(0);
  while (go_on && !tally.frame_complete()) {
    receive([&](Member& member, ReportKind kind, std::uint32_t count) {
      if (kind == ReportKind::unit) {
        ++member.units;
        held.call([&] { unit_done(count, member.spe); });
      }
      if (kind != ReportKind::progress && kind != ReportKind::idle) return;
      member.units = count;
      // Only an idle SPE has no request under way.
      if (kind == ReportKind::idle) tally.report(member.spe, count);
    });
    // Reports less than 1, which is for the finished frame.
    go_on = held.report(std::min(static_cast<double>(units_completed()) / tally.units(), 0.999));
  }
  end_frame(go_on);
  if (go_on) held.report(1);
  held.rethrow();
  return go_on;
}

void SpeTeam::signal_all(std::uint32_t commands) {
  signal_first(static_cast<unsigned>(members_.size()), commands);
}

void SpeTeam::signal_first(unsigned spes, std::uint32_t commands) {
  frame_.publish();
  for (unsigned spe = 0; spe < spes; ++spe)
    machine_.write_signal(spe, Signal::one, commands);
}

template <class Handle> bool SpeTeam::receive(Handle handle) {
  bool any = false;
  for (unsigned spe = 0; spe < members_.size(); ++spe) {
    if (const auto word = machine_.read_out_mailbox(spe)) {
      handle(members_[spe], report_kind(*word), report_count(*word));
      any = true;
    }
  }
  if (any) return true;
  throw_if_stopped();
  machine_.wait_for_mail(is_cancellable_ ? kCancellablePollInterval : kPollInterval);
  return false;
}

bool SpeTeam::receive_answers(ReportKind kind) {
  return receive(
      [&](Member& member, ReportKind report, std::uint32_t) { member.answered |= report == kind; });
}

bool SpeTeam::all_answered() const {
  return std::all_of(members_.begin(), members_.end(), [](const Member& member) { return member.answered; });
}

std::uint32_t SpeTeam::units_completed() const {
  return std::accumulate(members_.begin(), members_.end(), std::uint32_t{0},
                         [](std::uint32_t sum, const Member& member) { return sum + member.units; });
}

void SpeTeam::end_frame(bool complete) {
  const std::uint32_t over = strip_word::frame_over(frame_[0].epoch);
  const auto send_over = [&] {
    for (unsigned spe = 0; spe < members_.size(); ++spe)
      if (!members_[spe].answered && machine_.in_mailbox_space(spe) != 0)
        machine_.write_in_mailbox(spe, over);
  };
  send_over();
  while (!all_answered()) {
    // Repeats the message, because in the middle of a frame a mailbox may be full of neighbours' messages, or
    // a neighbour's message may replace this one.
    if (!receive_answers(ReportKind::finished) && !complete) send_over();
  }
  if (!complete) synchronize({}); // keeps cached lines, which are still valid
}

void SpeTeam::throw_if_stopped() {
  for (unsigned spe = 0; spe < members_.size(); ++spe) {
    if (machine_.running(spe)) continue;
    machine_.wait(spe);
    throw SpeError("SPE " + std::to_string(spe) + " left its program in the middle of its work");
  }
}

} // namespace celltrace
