// Lists the fields of the records that a stage and the PPE share, so that celltrace/spe/byte_order.hpp can
// convert them for SPEs of another byte order.
#pragma once

#include "celltrace/spe/byte_order.hpp"
#include "kernel/models/stage_block.hpp"

namespace celltrace::kernel::models {

FieldList<&StageBlock::frame, &StageBlock::jobs, &StageBlock::report, &StageBlock::ray_stack,
          &StageBlock::job_bytes, &StageBlock::stack_nodes, &StageBlock::tasks, &StageBlock::contexts,
          &StageBlock::announced, &StageBlock::generator, &StageBlock::first_row, &StageBlock::row_step,
          &StageBlock::first_searcher, &StageBlock::searchers, &StageBlock::searcher, &StageBlock::tester,
          &StageBlock::shader, &StageBlock::unused>
fields_of(const StageBlock&);

FieldList<&StageReport::jobs, &StageReport::searches, &StageReport::primary_hits,
          &StageReport::primary_returned, &StageReport::primary_hits_returned, &StageReport::returns,
          &StageReport::unused>
fields_of(const StageReport&);

} // namespace celltrace::kernel::models
