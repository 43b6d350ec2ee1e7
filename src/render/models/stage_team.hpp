// The SPEs of a machine at work on frames under a programming model other than the shared one: what the PPE
// says to them and hears from them.
#pragma once

#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "celltrace/spe/shared_records.hpp"
#include "memory/aligned_block.hpp"
#include "render/frame_fields.hpp"
#include "render/held_progress.hpp"
#include "render/models/stage_fields.hpp"
#include "render/models/stage_plan.hpp"

#include <vector>

namespace celltrace {

/// Runs the programs of the stages for a frame at a time. Throws SpeError as soon as one of them fails.
class StageTeam {
public:
  /// `frame` is one block, in the machine's byte order. It stays in place as long as the team lives; the SPEs
  /// see what it says when a frame begins. Throws InputError if the model does not go with the machine's
  /// number of SPEs.
  StageTeam(Machine& machine, SharedRecords<kernel::FrameBlock>& frame, Model model);

  /// Renders a frame; no program may be running. False if `progress` broke it off; what it throws passes
  /// through, the SPEs being ready for the next frame all the same. After SpeError it throws at every call.
  bool render_frame(const Progress& progress);

  /// What the stages did in the last frame.
  RenderStatistics::Stages counts() const;

private:
  bool render_frame_while(HeldProgress& held);
  /// Memory that depends on the frame, and its addresses in the orders.
  void prepare();
  void start();
  /// Reads all mail. Sleeps a little and returns false if there is none.
  bool receive();
  bool finished() const;
  void stop();
  void leave();
  void throw_if_stopped();

  Machine& machine_;
  SharedRecords<kernel::FrameBlock>& frame_;
  StagePlan plan_;
  SharedRecords<kernel::models::StageBlock> orders_;
  SharedRecords<kernel::models::StageReport> reports_;
  AlignedBlock jobs_, ray_stacks_; ///< the SPEs' own

  /// Of each pipeline: who reports to the PPE, and what it has reported.
  struct Pipeline {
    unsigned head = 0;
    std::uint32_t packets = 0;
    bool finished = false;
  };
  std::vector<Pipeline> pipelines_;
  bool failed_ = false;
};

} // namespace celltrace
