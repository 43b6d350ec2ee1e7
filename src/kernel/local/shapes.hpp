// Shapes where local store for code is scarce. Kernel dialect.
#pragma once

#include "kernel/primitives/instances_module.hpp"

namespace celltrace::kernel {

struct LocalShapes {
  template <class S, class Shape>
  [[gnu::always_inline]] static const LocalRays<S>& off_faces(const LocalRays<S>& rays) {
    return rays;
  }

  /// Rays of instances are traversed packet by packet.
  template <class Spu> struct InstanceRays {
    using S = typename Spu::simd;
    using Stack = TraversalStack<1, kMaxMeshLevels>;

    InstanceRays(const RayPacket&, const V3<S>&, const V3<S>&, const V3<S>&) {}
    static constexpr bool traverse(const SceneAccess<Spu>&, uint32_t, const NodeRef&, const InstanceTest&,
                                   const Stack&, const HitPacket&, const InstanceWork&) {
      return false;
    }
  };
};

} // namespace celltrace::kernel
