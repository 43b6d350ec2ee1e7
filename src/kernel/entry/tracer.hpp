// The tracer's programs. Kernel dialect.
#pragma once

#include "kernel/entry/strategies.hpp"
#include "kernel/program/tracer.hpp"

namespace celltrace::kernel {

// The programs as the PPE starts them; `argument` is the ea of the FrameBlock.

/// Finds objects by a BVH; where code takes no local store, by what the frame asks for.
template <class Spu> void tracer(Spu& spu, ea_t argument) {
  Tracer<Spu, Strategy<Spu>::kAccelerators>(spu, argument).run();
}
/// By a uniform grid, which it also builds.
template <class Spu> void grid_tracer(Spu& spu, ea_t argument) {
  Tracer<Spu, kGridOnly>(spu, argument).run();
}

} // namespace celltrace::kernel
