// The door between the kernel and direct memory: the only file of the kernel that asks whether an effective
// address can be dereferenced. Kernel dialect.
//
// The rest of the kernel asks for one of the capabilities below, each of which says what is done otherwise
// there. What only memory that is direct needs is in this folder.
#pragma once

#include "kernel/tuning.hpp"

namespace celltrace::kernel {

/// Records in main memory are read and written where they lie, without buffers in local store.
template <class Spu> constexpr bool kReadsInPlace = Spu::direct_memory;

/// Code takes no local store: a program has every accelerator and shortcuts for what is frequent, and hot
/// functions are inlined in each place that calls them.
template <class Spu> constexpr bool kHasRoomForCode = Spu::direct_memory;

/// The processor fetches memory by itself, line by line: work goes on elsewhere until prefetched lines have
/// come. Leaves are deferred (DeferredLeaves), and traversals interleaved.
template <class Spu> constexpr bool kPrefetchesLines = Spu::direct_memory;

/// A leaf with enough triangles is tested ray by ray, with its triangles in lanes (LeafTests); an object is
/// tested against all packets of a bundle that hit its leaf.
template <class Spu> constexpr bool kTestsWholeLeaves = Spu::direct_memory;

/// A bundle of rays through one point is traversed with a view of the scene from that point (BundleView), in
/// which leaves are tested against all its packets (BundleLeafTests).
template <class Spu> constexpr bool kHasBundleViews = Spu::direct_memory;

/// Before the places of a light with an area are looked at, the objects that may be in the way are gathered
/// (AreaOccluders); if they are too many, those are remembered that are (RecentOccluders). Rays from surfaces
/// to a place fill packets with those to others (AreaPairs).
template <class Spu> constexpr bool kGathersOccluders = Spu::direct_memory;

/// Where shadow rays would be walked (ShadowWalk), one traversal finds all that they cross (KeptCrossings).
template <class Spu> constexpr bool kKeepsCrossings = Spu::direct_memory;

/// Rays of a bundle's trees are gathered into full packets (RayPool), and so are what few of them hit where
/// they end (HitQueue), shadow rays from there (ShadowQueue), and those that see the sky (SkyQueue).
template <class Spu> constexpr bool kPoolsRays = Spu::direct_memory;

/// Rays of several octants traverse the BVH together (MixedRays), or are tested against all leaves of a small
/// one (LeafList).
template <class Spu> constexpr bool kMixesOctants = Spu::direct_memory;

/// Where few rays of packets come near tori, they wait for those of others (TorusPairs).
template <class Spu> constexpr bool kGathersTorusPairs = Spu::direct_memory;

/// Fractals that take many rounds are iterated at all hits of a bundle together (FractalValues).
template <class Spu> constexpr bool kIteratesAhead = Spu::direct_memory;

/// The SPEs build the BVH (build_bvh.hpp). Otherwise the PPE's side has it built before it starts them.
template <class Spu> constexpr bool kBuildsBvh = Spu::direct_memory;

/// Packets a side of a bundle, if memory is `direct` or not.
constexpr uint32_t bundle_edge(bool direct) {
  return direct ? tuning::kBundleEdge : tuning::kBundleEdgeInLocalStore;
}
template <class Spu> constexpr uint32_t kBundleEdge = bundle_edge(Spu::direct_memory);
template <class Spu> constexpr uint32_t kBundlePackets = kBundleEdge<Spu>* kBundleEdge<Spu>;

/// The most that directions of a packet's rays differ by which are traced at once.
template <class Spu>
constexpr float kMaxPacketSpread =
    Spu::direct_memory ? tuning::kMaxPacketSpread : tuning::kMaxPacketSpreadInLocalStore;

/// A T, or nothing: for members that only a capability asks for.
template <class T, bool kPresent> struct Present : T { using T::T; };
template <class T> struct Present<T, false> {
  template <class... Arguments> explicit Present(const Arguments&...) {}
};

} // namespace celltrace::kernel
