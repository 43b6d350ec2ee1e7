// The SPEs of a machine that render frames, and the messages between them and the PPE.
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

/// Runs the tracer on every SPE of a machine. Throws SpeError as soon as an SPE fails.
class SpeTeam {
public:
  /// Starts the SPEs. `frame` is one block in the machine's byte order; it must stay in place while the team
  /// lives. With every command the SPEs read the current contents of `frame`.
  SpeTeam(Machine& machine, SharedRecords<kernel::FrameBlock>& frame,
          kernel::AcceleratorKind accelerator = kernel::AcceleratorKind::bvh);
  /// Makes the SPEs leave their program; no SPE may be inside a frame, unless it has failed.
  ~SpeTeam();
  SpeTeam(const SpeTeam&) = delete;
  SpeTeam& operator=(const SpeTeam&) = delete;

  /// Makes the SPEs leave their program, so that they can run another program; assemble() starts the tracer
  /// again.
  void dismiss();
  void assemble();

  /// Makes the first `spes` SPEs build the accelerator, or do the frame block's step of building it; `poll`
  /// is called now and then, and must not throw. Returns false if the SPEs need more room than the frame
  /// block offers.
  bool prepare_frame(unsigned spes, const std::function<void()>& poll);
  /// Makes every SPE discard the messages in its mailbox, and fetch all cached lines of the image again.
  void synchronize();
  /// Makes every SPE discard the messages in its mailbox, and fetch the cached lines at these offsets again.
  void synchronize(std::span<const std::uint32_t> lines);
  /// A function that gets the number of a completed unit, whose pixels are in main memory, and the SPE that
  /// completed the unit.
  using UnitDone = std::function<void(std::uint32_t unit, unsigned spe)>;
  /// Renders a frame on all SPEs; `tally` gets the units that each SPE has completed. `unit_done` is called
  /// if the frame block asks for kEachUnit. Returns false if `progress` ended the frame. An exception of
  /// either function ends the frame, too, and passes through. In any case the SPEs are ready for the next
  /// frame.
  bool render_frame(StripTally& tally, const Progress& progress, const UnitDone& unit_done = {});

private:
  struct Member {
    unsigned spe = 0;
    std::uint32_t units = 0; ///< completed units, as last reported
    bool answered = false;   ///< true if the report that ends a command has arrived
  };

  /// Sends the command of synchronize(), once the frame block describes the lines.
  void command_synchronize();
  void signal_first(unsigned spes, std::uint32_t commands);
  void signal_all(std::uint32_t commands);
  /// Reads all mail; calls `handle(member, kind, count)` for each message. If there is no mail, sleeps a
  /// little and returns false.
  template <class Handle> bool receive(Handle handle);
  /// Reads mail as receive() does, and marks the members that report `kind`.
  bool receive_answers(kernel::ReportKind kind);
  bool all_answered() const;
  std::uint32_t units_completed() const;
  void end_frame(bool complete);
  void throw_if_stopped();

  Machine& machine_;
  SharedRecords<kernel::FrameBlock>& frame_;
  SharedRecords<std::uint32_t> lines_; ///< changed lines, in the SPEs' byte order
  std::vector<Member> members_;
  const kernel::AcceleratorKind accelerator_;
  bool assembled_ = false;
  bool is_cancellable_ = false; ///< true if a caller may end the frame
};

} // namespace celltrace
