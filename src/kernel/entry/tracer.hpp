// The tracer's programs. Kernel dialect.
#pragma once

#include "kernel/entry/strategies.hpp"
#include "kernel/program/tracer.hpp"

namespace celltrace::kernel {

// Programs that the PPE starts; `argument` is the effective address of the FrameBlock.

/// Renders with a BVH; where code takes no local store, with the accelerator that the frame asks for.
template <class Spu> void tracer(Spu& spu, ea_t argument) {
  Tracer<Spu, Strategy<Spu>::kAccelerators>(spu, argument).run();
}
/// Renders with a uniform grid, which it also builds.
template <class Spu> void grid_tracer(Spu& spu, ea_t argument) {
  Tracer<Spu, kGridOnly>(spu, argument).run();
}

} // namespace celltrace::kernel
