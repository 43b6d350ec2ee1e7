// A kernel that holds one packet of rays against one object, again and again.
#pragma once

#include "kernel/primitives/list.hpp"
#include "kernel/scalar_work.hpp"

#include <stdint.h>

namespace celltrace::bench {

struct alignas(128) IntersectionTask {
  kernel::RayPacket rays;
  kernel::ObjectRecord object;
  uint32_t count;
  uint32_t hits; ///< answer: of all rays
  uint32_t pad[14];
};
static_assert(sizeof(IntersectionTask) % 128 == 0, "crosses DMA");

template <class Spu> void intersection_loop(Spu& spu, ea_t argument) {
  using S = typename Spu::simd;
  IntersectionTask* task = spu.template allocate<IntersectionTask>();
  spu.get(task, argument, sizeof *task, 0);
  spu.wait_all(1);
  const uint32_t kind = task->object.kind_and_flags & kernel::object_flag::kind_mask;
  uint32_t hits = 0;
  for (uint32_t i = 0; i < task->count; ++i) {
    spu.compute(kernel::scalar_work::kTest[kind]);
    // Every time another ray, so that no result can be used twice.
    task->rays.origin.x.lane[i % kSimdLanes] += 1e-7f;
    kernel::Crossings<S> crossings[kernel::kMaxCrossingPairs];
    crossings[0].clear();
    kernel::Primitives::dispatch(kind, [&](auto shape) {
      decltype(shape)::template intersect<S>(task->rays, task->object, {}, 0, crossings);
    });
    hits += static_cast<uint32_t>(__builtin_popcount(crossings[0].near_hit.bits()));
  }
  task->hits = hits;
  spu.put(task, argument, sizeof *task, 0);
  spu.wait_all(1);
}

} // namespace celltrace::bench
