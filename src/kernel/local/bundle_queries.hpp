// Ray queries in local store, where a bundle is answered packet by packet. Kernel dialect.
#pragma once

#include "kernel/accel/traversal.hpp"

namespace celltrace::kernel {

template <class Traversal, class Spu> class LocalBundleQueries {
protected:
  explicit LocalBundleQueries(const FrameBlock&) {}
  static constexpr bool lists_all() { return false; }
  static constexpr bool intersect_toward(const RayQuery*, uint32_t, const LightRecord&) { return false; }
};

} // namespace celltrace::kernel
