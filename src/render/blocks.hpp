// Pictures in blocks of BC1: those that left the SPEs so, and others, which the PPE's side encodes by the
// same function.
#pragma once

#include "celltrace/image.hpp"
#include "celltrace/render.hpp"
#include "memory/aligned_block.hpp"
#include "records/frame.hpp"

namespace celltrace {

/// Rows [top, bottom) of what the SPEs have put to the surface of `frame`; the rest is black. `top` is a
/// multiple of 4.
BlockImage copy_blocks(const AlignedBlock& surface, const kernel::FrameBlock& frame, int top, int bottom);

} // namespace celltrace
