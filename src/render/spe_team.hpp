// The SPEs of a machine at work on frames: what the PPE says to them and hears from them.
#pragma once

#include "celltrace/balance/strip_tally.hpp"
#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "celltrace/spe/shared_records.hpp"
#include "render/frame_fields.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace celltrace {

/// Runs the tracer on every SPE of a machine. Throws SpeError as soon as one of them fails.
class SpeTeam {
public:
  /// `frame` is one block, in the machine's byte order. It stays in place as long as the team lives; with
  /// every command the SPEs see what it says then.
  SpeTeam(Machine& machine, SharedRecords<kernel::FrameBlock>& frame,
          kernel::AcceleratorKind accelerator = kernel::AcceleratorKind::bvh);
  /// Lets the SPEs leave their program; none may be inside a frame, unless it has failed.
  ~SpeTeam();
  SpeTeam(const SpeTeam&) = delete;
  SpeTeam& operator=(const SpeTeam&) = delete;

  /// Lets the SPEs leave, so that they can run something else; assemble() brings back those that have left.
  void dismiss();
  void assemble();

  /// The first `spes` SPEs build the accelerator, or take the frame block's step in building it; `look` is
  /// called now and then, and must not throw. False if they need more room than the frame block offers.
  bool prepare_frame(unsigned spes, const std::function<void()>& look);
  /// Every SPE forgets what is in its mailbox, and fetches lines of the image again that it has cached.
  void synchronize();
  /// The same, but of lines only those at these offsets.
  void synchronize(std::span<const std::uint32_t> lines);
  /// Hears the number of a unit whose pixels are in main memory, and which SPE completed it.
  using UnitDone = std::function<void(std::uint32_t unit, unsigned spe)>;
  /// All SPEs render; what each completed is in `tally`. `unit_done` is called if the frame block asks for
  /// kEachUnit. False if `progress` broke the frame off; what either function throws does, too, and passes
  /// through, the SPEs being ready for the next frame all the same.
  bool render_frame(StripTally& tally, const Progress& progress, const UnitDone& unit_done = {});

private:
  struct Member {
    unsigned spe = 0;
    std::uint32_t units = 0; ///< completed, as last heard
    bool answered = false;   ///< the report that a command ends with has come
  };

  /// What the frame block says of lines is there.
  void command_synchronize();
  void signal_first(unsigned spes, std::uint32_t commands);
  void signal_all(std::uint32_t commands);
  /// Reads all mail; calls `handle(member, kind, count)`. Sleeps a little and returns false if there is none.
  template <class Handle> bool receive(Handle handle);
  /// As receive(), marking the members that report `kind`.
  bool receive_answers(kernel::ReportKind kind);
  bool all_answered() const;
  std::uint32_t units_completed() const;
  void end_frame(bool complete);
  void throw_if_stopped();

  Machine& machine_;
  SharedRecords<kernel::FrameBlock>& frame_;
  SharedRecords<std::uint32_t> lines_; ///< that are out of date, as the SPEs read them
  std::vector<Member> members_;
  const kernel::AcceleratorKind accelerator_;
  bool assembled_ = false;
  bool asks_ = false; ///< whether somebody may break the frame off
};

} // namespace celltrace
