// Which SPE does what under a programming model other than the shared one.
#pragma once

#include "celltrace/render.hpp"
#include "kernel/models/stage_block.hpp"
#include "records/accelerator.hpp"

#include <cstdint>
#include <vector>

namespace celltrace {

/// What each SPE does, without addresses.
struct StagePlan {
  /// The program that an SPE runs.
  enum class Program { generator, searcher, shader };

  struct Spe {
    Program program;
    /// `first_row` and `row_step`, `contexts` and the like are set; effective addresses are 0.
    kernel::models::StageBlock orders;
    unsigned pipeline; ///< the number of the pipeline that it belongs to
  };

  std::vector<Spe> spes;
  unsigned pipelines = 1;
};

/// `model` is not Model::shared. Pipelines have 2 to 15 SPEs each: more SPEs make more of them, which take
/// the picture's rows of packets in turn. Throws InputError for fewer than 2 SPEs.
StagePlan plan_stages(Model model, kernel::AcceleratorKind accelerator, unsigned spes);

/// SPEs to ask a machine for (0: as many as it likes): the offload model's PPE is one more than the options
/// say.
unsigned machine_spes(const RenderOptions& options);

} // namespace celltrace
