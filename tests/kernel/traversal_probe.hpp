// A kernel that builds the grid and sends packets of rays through it.
#pragma once

#include "kernel/prepare_frame.hpp"
#include "kernel/traversal.hpp"

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
  uint32_t built; ///< answer
  uint32_t pairs; ///< answer
  uint32_t pad;
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
  TraversalQuery* query = spu.template allocate<TraversalQuery>();
  for (uint32_t i = 0; i < task->count; ++i) {
    const ea_t at = task->queries + i * sizeof(TraversalQuery);
    fetch(query, at, sizeof *query);
    walker.find_closest(query->rays, query->lanes, query->hits);
    walker.attenuate(query->rays, query->lanes, query->distance, query->light);
    spu.put(query, at, sizeof *query, 0);
    spu.wait_all(1);
  }
}

} // namespace celltrace::test
