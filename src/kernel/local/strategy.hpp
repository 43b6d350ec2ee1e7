// The strategy of an SPU that has a local store. Kernel dialect.
#pragma once

#include "kernel/local/bundle_queries.hpp"
#include "kernel/local/bundle_steps.hpp"
#include "kernel/local/memory.hpp"
#include "kernel/local/object_shortcuts.hpp"
#include "kernel/local/packet_steps.hpp"
#include "kernel/local/packet_trees.hpp"
#include "kernel/local/packets.hpp"
#include "kernel/local/patterns.hpp"
#include "kernel/local/program.hpp"
#include "kernel/local/shading.hpp"
#include "kernel/local/shadow_search.hpp"
#include "kernel/local/shapes.hpp"

namespace celltrace::kernel {

struct LocalStrategy : LocalMemory, LocalPackets, LocalPatterns, LocalShapes, LocalShading, LocalProgram {
  template <class Tests, class Spu> using ObjectShortcuts = LocalObjectShortcuts<Tests, Spu>;
  template <class Traversal, class Spu> using PacketSteps = LocalPacketSteps<Traversal, Spu>;
  template <class Search, class Spu> using BundleSteps = LocalBundleSteps<Search, Spu>;
  template <class Traversal, class Spu> using BundleQueries = LocalBundleQueries<Traversal, Spu>;
  template <class Tracer, class Spu> using ShadowSearch = LocalShadowSearch<Tracer, Spu>;
  template <class Tracer, class Spu> using Trees = PacketTrees<Tracer, Spu>;
};

} // namespace celltrace::kernel
