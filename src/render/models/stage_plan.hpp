// Assigns programs to SPEs under a programming model other than the shared one.
#pragma once

#include "celltrace/render.hpp"
#include "kernel/models/stage_block.hpp"
#include "records/accelerator.hpp"

#include <cstdint>
#include <vector>

namespace celltrace {

/// The program and the orders of each SPE, without addresses.
struct StagePlan {
  /// The program that an SPE runs.
  enum class Program { generator, searcher, shader };

  struct Spe {
    Program program;
    /// The orders, with `first_row`, `row_step`, `contexts` and similar fields set; effective addresses are
    /// 0.
    kernel::models::StageBlock orders;
    unsigned pipeline; ///< index of the SPE's pipeline
  };

  std::vector<Spe> spes;
  unsigned pipelines = 1;
};

/// Returns the plan for a model other than Model::shared. Pipelines have 2 to 15 SPEs each; more SPEs make
/// more pipelines, which take turns in the picture's rows of packets. Throws InputError for fewer than 2
/// SPEs.
StagePlan plan_stages(Model model, kernel::AcceleratorKind accelerator, unsigned spes);

/// Returns the number of SPEs that a machine needs; 0 lets the machine choose. In the offload model this is
/// one more than the options say, for the PPE's part.
unsigned machine_spes(const RenderOptions& options);

} // namespace celltrace
