// Capabilities of direct memory that are not of a Strategy yet. Kernel dialect.
#pragma once

#include "kernel/strategy.hpp"

namespace celltrace::kernel {

/// Records in main memory are read and written where they lie, without buffers in local store.
template <class Spu> constexpr bool kReadsInPlace = std::is_same_v<Strategy<Spu>, DirectStrategy>;

/// Code takes no local store: a program has every accelerator and shortcuts for what is frequent, and hot
/// functions are inlined in each place that calls them.
template <class Spu> constexpr bool kHasRoomForCode = std::is_same_v<Strategy<Spu>, DirectStrategy>;

/// The processor fetches memory by itself, line by line: work goes on elsewhere until prefetched lines have
/// come. Leaves are deferred (DeferredLeaves), and traversals interleaved.
template <class Spu> constexpr bool kPrefetchesLines = std::is_same_v<Strategy<Spu>, DirectStrategy>;

/// A leaf with enough triangles is tested ray by ray, with its triangles in lanes (LeafTests); an object is
/// tested against all packets of a bundle that hit its leaf.
template <class Spu> constexpr bool kTestsWholeLeaves = std::is_same_v<Strategy<Spu>, DirectStrategy>;

/// A bundle of rays through one point is traversed with a view of the scene from that point (BundleView), in
/// which leaves are tested against all its packets (BundleLeafTests).
template <class Spu> constexpr bool kHasBundleViews = std::is_same_v<Strategy<Spu>, DirectStrategy>;

/// Before the places of a light with an area are looked at, the objects that may be in the way are gathered
/// (AreaOccluders); if they are too many, those are remembered that are (RecentOccluders). Rays from surfaces
/// to a place fill packets with those to others (AreaPairs).
template <class Spu> constexpr bool kGathersOccluders = std::is_same_v<Strategy<Spu>, DirectStrategy>;

/// Where shadow rays would be walked (ShadowWalk), one traversal finds all that they cross (KeptCrossings).
template <class Spu> constexpr bool kKeepsCrossings = std::is_same_v<Strategy<Spu>, DirectStrategy>;

/// Rays of a bundle's trees are gathered into full packets (RayPool), and so are what few of them hit where
/// they end (HitQueue), shadow rays from there (ShadowQueue), and those that see the sky (SkyQueue).
template <class Spu> constexpr bool kPoolsRays = std::is_same_v<Strategy<Spu>, DirectStrategy>;

/// Rays of several octants traverse the BVH together (MixedRays), or are tested against all leaves of a small
/// one (LeafList).
template <class Spu> constexpr bool kMixesOctants = std::is_same_v<Strategy<Spu>, DirectStrategy>;

/// Where few rays of packets come near tori, they wait for those of others (TorusPairs).
template <class Spu> constexpr bool kGathersTorusPairs = std::is_same_v<Strategy<Spu>, DirectStrategy>;

/// Fractals that take many rounds are iterated at all hits of a bundle together (FractalValues).
template <class Spu> constexpr bool kIteratesAhead = std::is_same_v<Strategy<Spu>, DirectStrategy>;

/// The SPEs build the BVH (build_bvh.hpp). Otherwise the PPE's side has it built before it starts them.
template <class Spu> constexpr bool kBuildsBvh = std::is_same_v<Strategy<Spu>, DirectStrategy>;

} // namespace celltrace::kernel
