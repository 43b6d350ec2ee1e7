// Surfaces as seen by the rays of a packet. Kernel dialect.
#pragma once

#include "kernel/packet.hpp"

namespace celltrace::kernel {

/// A surface as seen by sixteen rays.
template <class S> struct Surfaces {
  V3<S> point, normal;      ///< normal flipped toward the viewer
  V3<S> direction;          ///< of the rays that arrive
  const WordLanes* objects; ///< what the points lie on
  uint32_t any_side = 0; ///< lanes to which light may come from all sides, as their normals are not known yet
};

} // namespace celltrace::kernel
