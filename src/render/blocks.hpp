// Pictures in blocks of BC1: copies blocks that the SPEs have encoded, and encodes other pictures by the same
// function.
#pragma once

#include "celltrace/image.hpp"
#include "celltrace/render.hpp"
#include "memory/aligned_block.hpp"
#include "records/frame.hpp"

namespace celltrace {

/// Returns rows [top, bottom) of the blocks that the SPEs have written to the surface of `frame`; all other
/// rows are black. `top` is a multiple of 4.
BlockImage copy_blocks(const AlignedBlock& surface, const kernel::FrameBlock& frame, int top, int bottom);

} // namespace celltrace
