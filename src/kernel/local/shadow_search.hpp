// Shadow rays in local store: they are walked wherever the surfaces that they cross matter. Kernel dialect.
#pragma once

#include "kernel/shading/shadow_tracer.hpp"

namespace celltrace::kernel {

template <class Tracer, class Spu> class LocalShadowSearch {
protected:
  static constexpr bool is_at_pinhole(const LightRecord&) { return false; }
  static constexpr bool walks(const LightRecord&) { return true; }
  static constexpr bool trace_crossings(const LightRecord&, const RayQuery*, uint32_t) { return false; }
  static void trace_crossings(const LightRecord&, const RayPacket&, uint32_t, const FloatLanes&,
                              const VectorLanes&) {}
  static constexpr bool sample_area(const LightRecord&, uint32_t, const VectorLanes&) { return false; }
};

} // namespace celltrace::kernel
