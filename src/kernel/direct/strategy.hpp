// The strategy of an SPU whose memory is direct. Kernel dialect.
#pragma once

#include "kernel/direct/bundle_queries.hpp"
#include "kernel/direct/bundle_steps.hpp"
#include "kernel/direct/memory.hpp"
#include "kernel/direct/object_shortcuts.hpp"
#include "kernel/direct/packet_steps.hpp"
#include "kernel/direct/packets.hpp"
#include "kernel/direct/patterns.hpp"
#include "kernel/direct/pooled_trees.hpp"
#include "kernel/direct/program.hpp"
#include "kernel/direct/shading.hpp"
#include "kernel/direct/shadow_search.hpp"
#include "kernel/direct/shapes.hpp"

namespace celltrace::kernel {

struct DirectStrategy : DirectMemory,
                        DirectPackets,
                        DirectPatterns,
                        DirectShapes,
                        DirectShading,
                        DirectProgram {
  template <class Tests, class Spu> using ObjectShortcuts = DirectObjectShortcuts<Tests, Spu>;
  template <class Traversal, class Spu> using PacketSteps = DirectPacketSteps<Traversal, Spu>;
  template <class Search, class Spu> using BundleSteps = DirectBundleSteps<Search, Spu>;
  template <class Traversal, class Spu> using BundleQueries = DirectBundleQueries<Traversal, Spu>;
  template <class Tracer, class Spu> using ShadowSearch = DirectShadowSearch<Tracer, Spu>;
  template <class Tracer, class Spu> using Trees = PooledTrees<Tracer, Spu>;
};

} // namespace celltrace::kernel
