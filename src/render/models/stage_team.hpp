// The SPEs of a machine that render frames under a programming model other than the shared one, and the
// messages between them and the PPE.
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

/// Runs the programs of the stages, one frame at a time. Throws SpeError as soon as a program fails.
class StageTeam {
public:
  /// Plans the stages. `frame` is one block in the machine's byte order; it must stay in place while the team
  /// lives. The SPEs read its contents when a frame begins. Throws InputError if the model does not support
  /// the machine's number of SPEs.
  StageTeam(Machine& machine, SharedRecords<kernel::FrameBlock>& frame, Model model);

  /// Renders a frame; no program may be running. Returns false if `progress` ended the frame; exceptions of
  /// `progress` pass through. In both cases the SPEs are ready for the next frame. After a SpeError every
  /// call throws.
  bool render_frame(const Progress& progress);

  /// Returns the statistics of the stages in the last frame.
  RenderStatistics::Stages counts() const;

private:
  bool render_frame_while(HeldProgress& held);
  /// Allocates memory that depends on the frame, and sets its addresses in the orders.
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
  AlignedBlock jobs_, ray_stacks_; ///< memory for the jobs and the ray stacks of all contexts

  /// The state of a pipeline: the SPE that reports to the PPE, and its reports.
  struct Pipeline {
    unsigned head = 0;
    std::uint32_t packets = 0;
    bool finished = false;
  };
  std::vector<Pipeline> pipelines_;
  bool failed_ = false;
};

} // namespace celltrace
