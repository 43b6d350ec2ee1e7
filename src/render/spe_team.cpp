#include "render/spe_team.hpp"

#include "celltrace/balance/strip.hpp"
#include "render/tracer_program.hpp"

#include <algorithm>
#include <exception>

namespace celltrace {

using namespace kernel;

SpeTeam::SpeTeam(Machine& machine, const FrameBlock& frame)
    : machine_(machine), frame_(frame), members_(machine.spe_count()) {
  const SpeProgram program = tracer_program();
  for (unsigned spe = 0; spe < members_.size(); ++spe) machine_.start(spe, program, to_ea(&frame_));
}

SpeTeam::~SpeTeam() {
  try {
    signal_all(command::quit);
    for (unsigned spe = 0; spe < members_.size(); ++spe) machine_.wait(spe);
  } catch (const std::exception&) {
    // An SPE that failed has been reported by the call that met it; here it only has to be gone.
    machine_.interrupt();
  }
}

bool SpeTeam::prepare_frame() {
  members_[0].answered = false;
  machine_.write_signal(0, Signal::one, command::prepare_frame);
  bool built = false;
  while (!members_[0].answered)
    receive([&](Member& member, ReportKind kind, std::uint32_t) {
      built = kind == ReportKind::prepared;
      member.answered = built || kind == ReportKind::needs_memory;
    });
  return built;
}

void SpeTeam::synchronize() {
  for (Member& member : members_) member.answered = false;
  signal_all(command::synchronize);
  await(ReportKind::synchronised);
}

bool SpeTeam::render_frame(const Progress& progress) {
  std::fill(members_.begin(), members_.end(), Member());
  signal_all(command::render_frame);
  std::exception_ptr failure;
  const auto ask = [&](double fraction) {
    try {
      return !progress || progress(fraction);
    } catch (...) {
      failure = std::current_exception();
      return false;
    }
  };
  double reported = 0;
  bool go_on = ask(0);
  while (go_on) {
    std::uint32_t rows = 0;
    bool idle = true;
    for (const Member& member : members_) {
      rows += member.rows;
      idle = idle && member.idle;
    }
    if (idle && rows == frame_.packet_rows) break;
    // 1 is kept for the finished frame.
    const double fraction = std::min(static_cast<double>(rows) / frame_.packet_rows, 0.999);
    reported = std::max(reported, fraction);
    go_on = ask(reported);
    if (!go_on) break;
    receive([](Member& member, ReportKind kind, std::uint32_t count) {
      if (kind != ReportKind::progress && kind != ReportKind::idle) return;
      member.rows = count;
      member.idle = member.idle || kind == ReportKind::idle;
    });
  }
  declare_over();
  await(ReportKind::finished);
  // Words of a frame that was broken off are still in the mailboxes.
  if (!go_on) synchronize();
  if (go_on) ask(1);
  if (failure) std::rethrow_exception(failure);
  return go_on;
}

void SpeTeam::signal_all(std::uint32_t commands) {
  for (unsigned spe = 0; spe < members_.size(); ++spe) machine_.write_signal(spe, Signal::one, commands);
}

template <class Handle>
void SpeTeam::receive(Handle handle) {
  bool any = false;
  for (unsigned spe = 0; spe < members_.size(); ++spe) {
    if (const auto word = machine_.read_out_mailbox(spe)) {
      handle(members_[spe], report_kind(*word), report_count(*word));
      any = true;
    }
  }
  if (any) return;
  throw_if_stopped();
  machine_.wait_for_mail(std::chrono::milliseconds(50));
}

void SpeTeam::await(ReportKind kind) {
  const auto answered = [](const Member& member) { return member.answered; };
  while (!std::all_of(members_.begin(), members_.end(), answered))
    receive([&](Member& member, ReportKind report, std::uint32_t) { member.answered |= report == kind; });
}

void SpeTeam::declare_over() {
  const std::uint32_t word = strip_word::kFromPpe | strip_word::make(frame_.epoch, false, {0, 0});
  for (unsigned spe = 0; spe < members_.size(); ++spe) machine_.write_in_mailbox(spe, word);
}

void SpeTeam::throw_if_stopped() {
  for (unsigned spe = 0; spe < members_.size(); ++spe) {
    if (machine_.running(spe)) continue;
    machine_.wait(spe);
    throw SpeError("SPE " + std::to_string(spe) + " left its program in the middle of its work");
  }
}

} // namespace celltrace
