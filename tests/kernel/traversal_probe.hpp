// A kernel that builds the grid and sends packets of rays through it.
#pragma once

#include "kernel/entry/strategies.hpp"
#include "kernel/program/prepare_frame.hpp"

namespace celltrace::test {

struct alignas(128) TraversalQuery {
  kernel::RayPacket rays;
  kernel::FloatLanes distance; ///< shadow rays: to the light
  kernel::VectorLanes light;   ///< shadow rays: in full, becomes what arrives
  kernel::HitPacket hits;      ///< of the rays as ordinary rays
  uint32_t lanes;
  uint32_t pad[31];
};
static_assert(sizeof(TraversalQuery) % 128 == 0, "crosses DMA");

struct alignas(16) TraversalTask {
  ea_t frame, queries;
  uint32_t count;
  uint32_t built;   ///< answer
  uint32_t pairs;   ///< answer
  uint32_t bundles; ///< not 0: as many queries at once as a bundle has packets
};

template <class Spu> void traversal(Spu& spu, ea_t argument) {
  using namespace kernel;
  TraversalTask* task = spu.template allocate<TraversalTask>();
  FrameBlock* frame = spu.template allocate<FrameBlock>();
  const auto fetch = [&](void* ls, ea_t ea, uint32_t bytes) {
    spu.get(ls, ea, bytes, 0);
    spu.wait_all(1);
  };
  fetch(task, argument, sizeof *task);
  fetch(frame, task->frame, sizeof *frame);
  const PrepareResult result = prepare_frame(spu, *frame);
  task->built = result.built ? 1 : 0;
  task->pairs = result.entries;
  spu.put(task, argument, sizeof *task, 0);
  spu.wait_all(1);
  if (!result.built) return;

  CacheConfig config;
  config.sets = 32; // small, so that lines are replaced
  SceneAccess<Spu> scene(spu, config, frame->image);
  Traversal<Spu> walker(scene, *frame);
  const uint32_t most = task->bundles != 0 ? kBundlePackets<Spu> : 1;
  TraversalQuery* const query = spu.template allocate<TraversalQuery>(most);
  for (uint32_t first = 0; first < task->count; first += most) {
    const uint32_t left = task->count - first;
    const uint32_t n = left < most ? left : most;
    const ea_t at = task->queries + first * sizeof(TraversalQuery);
    RayQuery closest[kBundlePackets<Spu>], light[kBundlePackets<Spu>];
    for (uint32_t i = 0; i < n; ++i) {
      TraversalQuery& q = query[i];
      fetch(&q, at + i * sizeof q, sizeof q);
      closest[i] = {&q.rays, &q.hits, nullptr, nullptr, q.lanes};
      light[i] = {&q.rays, nullptr, &q.distance, &q.light, q.lanes};
    }
    walker.intersect(closest, n);
    walker.intersect(light, n);
    for (uint32_t i = 0; i < n; ++i)
      spu.put(query + i, at + i * sizeof *query, sizeof *query, 0);
    spu.wait_all(1);
  }
  scene.cache().settle();
}

} // namespace celltrace::test
