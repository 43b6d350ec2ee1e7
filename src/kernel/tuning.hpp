// The thresholds of the tracer that were found by measuring. Kernel dialect.
//
// Each trades one cost for another; none of them decides what is in a picture. To measure one again, change
// it, build bench/compare twice, and run both programs in turn, several times:
//
//   celltrace_compare --only 'MEASURE/SCENE$' --threads 1 --clock processor --runs 5
//
// MEASURE and SCENE are said with each number; "rays of the models" is 'rays/(bunny|head|legocar|suzanne)$'.
// A number stays as it is unless another is better by more than the runs of one program differ. The numbers
// are for memory that is direct, where they do not say otherwise. bench/sweep-thresholds tries those that
// scenes can tell of at half, double and off, and writes as a table what each is worth.
#pragma once

#include <stdint.h>

namespace celltrace::kernel::tuning {

// --- bundles of rays ---

/// Packets a side of a bundle, which one SPE takes as a whole. Larger: more packets share the traversal of a
/// node; smaller: less memory for their state. Four is what the SIMD lanes of a frustum test have room for;
/// two is what local store has room for. Rays of the models; for an SPE `celltrace render --backend cell_emu
/// --schedule lockstep --stats -`, whose cycles count.
constexpr uint32_t kBundleEdge = 4;
constexpr uint32_t kBundleEdgeInLocalStore = 2;

/// Rays whose directions differ by more do not share a frustum. Larger: fewer traversals, with looser frusta;
/// smaller: more traversals, with tighter ones. 'trace time' of scenes with mirrors and glass; also for SPEs.
constexpr float kMaxDirectionSpread = 1.0f;

/// Rays of a packet that do not share a frustum by that are traced by blocks of 2x2 and one by one. Where
/// processors test all lanes at once, one traversal with all rays of an octant (whose directions differ by 3
/// at most) costs less, even if many of its nodes are hit by few rays. 'trace time' of scenes with mirrors.
constexpr float kMaxPacketSpread = 3.0f;
constexpr float kMaxPacketSpreadInLocalStore = kMaxDirectionSpread;

/// So many rays of a packet that go to several octants traverse the BVH together, in scenes of at most so
/// many objects: those that a core's caches hold. Fewer rays, or rays among smaller objects, have few nodes
/// in common: traversals octant by octant have a frustum, and follow single rays by themselves. 'trace time'
/// of scenes with mirrors and glass.
constexpr int kLeastMixedRays = 4;
constexpr uint32_t kMostObjectsOfMixedRays = 40000;
/// In scenes of at most so many objects packets of one octant are traversed like that, too. Larger: nodes
/// that a frustum misses are tested ray by ray; smaller: frusta are computed that have hardly a node to miss.
/// 'trace time' of scenes with mirrors and glass.
constexpr uint32_t kMostObjectsWithoutFrusta = 64;

/// A packet with so many rays of one tree goes on by itself, and so do so many hits and shadow rays from
/// there; those of others are gathered into full packets. Larger: fewer lanes are empty; smaller: more
/// packets have rays that are close to each other. 'trace time' of scenes with mirrors and glass, at 320x240.
constexpr int kLeastRaysByThemselves = 12;

/// Where the packets of a bundle have iterated fractals for so many rounds in all, those of the next one are
/// iterated together. Larger: packets wait for their last lanes; smaller: what is hit is found out twice.
/// 'trace time' of fractals.
constexpr uint32_t kLeastRoundsOfFractals = 1000;

/// Packets of a bundle of which two corners hit different materials: with so many the bundle's rays are
/// sorted by materials, if that is found to pay. Smaller: materials are counted in vain; larger: packets with
/// several materials stay. 'trace time' of scenes with many small objects; of others the cost.
constexpr uint32_t kLeastMixedPackets = 4;

/// Nodes that a bundle's frustum alone is tested against before its rays are made. Larger: more of the
/// bundles that hit nothing are found; smaller: the tighter frusta of packets are tested from an earlier node
/// on. Rays of the models, and of legocar most of all, which leaves much of its picture empty.
constexpr uint32_t kMaxEnteredNodes = 24;

/// A packet's frustum is loose once it has hit this many nodes that none of the packet's rays hit. From then
/// on its rays are tested as well. Larger: more nodes are hit in vain; smaller: rays are tested where frusta
/// would do. It matters at silhouettes, where the origins of shadow rays lie far apart. Rays of the models;
/// also for SPEs.
constexpr uint32_t kMissesOfLoose = 2;
/// A packet of shadow rays is wide if its rectangle, as the light sees it, is larger than its share of the
/// bundle's by this factor: the origins lie on several surfaces, and leaves between these are hit by the
/// frustum only. Its rays are tested against leaves' bounds as well. Larger: triangles are tested in vain;
/// smaller: rays are tested where frusta would do. 'refitted every frame/(hills|random)-100000'.
constexpr float kWidePacket = 1.5f;

/// In scenes of at most so many objects, and planes besides, packets are tested against all of them in place
/// of a bundle's traversal. Larger: objects are tested that a frustum would miss; smaller: frusta are
/// computed for a single leaf. 'trace time' of scenes with one or two objects.
constexpr uint32_t kMostListedObjects = 2;

// --- when packets of a bundle part ---

/// A node that this many packets of a bundle hit, or fewer, may be traversed by each of them separately.
/// Larger: packets share fewer nodes; smaller: more nodes are tested for packets that do not hit them. Rays
/// of the bunny, whose triangles are smaller than pixels.
constexpr uint32_t kMaxSplitPackets = 4;
/// Packets split that early where there are more objects than one for so many pixels, or rays of a stream in
/// a unit square: each then hits other nodes. Larger: larger triangles split too. Rays of the models.
constexpr uint32_t kPixelsOfSmallObject = 2;

// --- waiting for memory ---
//
// The caches are those of a usual PC, not those of the computer that renders: what fits in them decides in
// which order a pixel's light is added up, and pixels are to be the same on all computers.

/// Bytes of an object's record and of its share of the nodes.
constexpr uint32_t kBytesOfObject = 100;
constexpr uint32_t objects_in(uint32_t bytes) {
  return bytes / kBytesOfObject;
}

/// In so many bytes the caches of one core hold most of the objects with their nodes, and leaves are tested
/// at once. With more objects, leaves are deferred while their objects are prefetched, and so are normals at
/// hits a packet ahead. Smaller: leaves are deferred although nothing has to be waited for; larger: tests
/// wait for memory. Rays of head (17,684 objects) and bunny (69,630), and 'trace time' of scenes of 20,000 to
/// 40,000 objects with mirrors and glass, which takes up to 5 % longer if their leaves are deferred.
constexpr uint32_t kCoreCacheBytes = 4'000'000;
constexpr uint32_t kObjectsInCoreCache = objects_in(kCoreCacheBytes);
/// The most leaves that are deferred. With kEnoughDeferredLeaves of them their objects are tested after the
/// next node is expanded. Larger: more time to fetch them; smaller: hits shorten tfar sooner. Rays of the
/// bunny and of generated models: '--primitives 1000000'.
constexpr uint32_t kMaxDeferredLeaves = 8;
constexpr uint32_t kEnoughDeferredLeaves = kMaxDeferredLeaves / 2;
/// With more, nodes lie in main memory, and the traversals of packets are interleaved. Smaller: state is
/// saved and restored although no node has to be waited for. Where objects lie at random, it begins to pay at
/// ten million. Rays of generated models, '--primitives 1000000 4000000 10000000'.
constexpr uint32_t kNearBytes = 400'000'000;
constexpr uint32_t kMostObjectsOfNearNodes = objects_in(kNearBytes);
/// Traversals that are interleaved. Larger: more time to fetch a node; smaller: less state to keep in cache.
/// Rays of generated models, '--primitives 10000000'.
constexpr uint32_t kMaxInterleaved = 4;

// --- objects that move ---

/// A BVH is built again when refitting has made the expected cost of a ray so many times what it was, by the
/// surface area heuristic. Larger: rays go through looser nodes; smaller: builds that cost several times what
/// a refit does. Frames of 'refitted every frame/'.
constexpr double kMostDecay = 1.5;

// --- tests of triangles ---

/// A leaf is tested ray by ray, with its triangles in lanes, with at most so many rays and at least so many
/// triangles. More rays would need more passes, and fewer triangles would leave lanes empty: then each
/// triangle is tested against all rays at once. Rays of bunny and legocar; `bench_triangles`. Leaves with so
/// many objects are tested against more rays to a light by ObjectTests::test_occlusion_by_leaf(), whose rays
/// stay in registers: loading them does not pay for fewer objects. 'trace time' of soft shadows.
constexpr int kMostRaysByLeaf = 4;
constexpr uint32_t kLeastTrianglesByLeaf = 4;

// --- lights with an area ---

/// Objects that are remembered to be between a packet and such a light; with more, rays toward its places are
/// tested against leaves. Larger: each ray is tested against objects that are nowhere near it; smaller: more
/// rays come to leaves. 'trace time/area-light'.
constexpr uint32_t kMostAreaOccluders = 16;
/// Nodes that have leaves between these; with more, each ray traverses the BVH from its root. Larger: leaves
/// are tested that are nowhere near a ray; smaller: more rays traverse. The same, and scenes with more
/// objects.
constexpr uint32_t kMostAreaNodes = 64;

/// Packets of rays to places of a light that are tested together at most. Larger: more rays are tested beside
/// each other; smaller: they stay in the first cache. 'trace time' of soft shadows.
constexpr uint32_t kMostAreaPackets = 16;

// --- patterns ---

/// The points around up to so many cells of crackle are gathered for a packet cell by cell; if its points are
/// in more, each lane is compared with the points around its own cell. 'trace time' of scenes with crackle
/// near by and as far as the horizon.
constexpr uint32_t kMostCellsOfFeatures = 2;
/// The same where points that were gathered are kept for points beside these.
constexpr uint32_t kMostCellsInCache = 8;

// --- building the BVH ---

/// When the objects of a range share a leaf. A triangle has weight 1. Two or three objects that would not
/// fill a node always do, but in a scene of few objects.
struct LeafRule {
  uint32_t certain;       ///< so many objects of weight 1 always
  uint32_t most;          ///< above this weight never; between the two, the SAH decides
  float cost;             ///< of testing an object of weight 1, relative to expanding a node
  uint32_t sphere_weight; ///< a sphere is tested in little time, and fills most of its bounds
  uint32_t other_weight;  ///< of what is neither: most tests of thin cylinders are in vain
};
/// Wide leaves are for SPEs that test many triangles of a leaf at once. Larger: fewer nodes are built and
/// expanded; smaller: fewer objects are tested in vain. 'rebuilt every frame' and rays of the models; for
/// weights 'trace time' of molecules and of scenes with a few simple shapes.
constexpr LeafRule kWideLeaves = {12, 32, 0.5f, 2, 3};
/// Rays of a packet that go on alone in an instance's mesh where they are so few. Larger: fewer lanes idle;
/// smaller: fewer nodes are expanded more than once. 'trace time' of scenes with many instances.
constexpr int kMostRaysAlone = 1;
/// Narrow leaves are for tests one by one. `celltrace render --backend cell_emu --schedule lockstep --stats
/// -`, whose cycles count.
constexpr LeafRule kNarrowLeaves = {3, 16, 2.0f, 2, 2};
/// In copied treelets four objects do: a node for them would take memory in every copy, and rays would wait
/// for it longer than the tests take. 'first frame' of a scene with many instances of one mesh.
constexpr LeafRule kCopiedLeaves = {4, 8, 2.0f, 1, 1};
/// Leaves are wide in scenes of at most so many bytes, all of which are in the cache that a PC's cores share.
/// Larger: objects that no ray hits are fetched from main memory; smaller: more nodes are built and expanded.
/// Rays of generated models, '--primitives 100000 1000000'.
constexpr uint32_t kSharedCacheBytes = 50'000'000;
constexpr uint32_t kMostObjectsOfWideLeaves = objects_in(kSharedCacheBytes);

/// Treelets that an SPE takes at a time. Larger: fewer atomic operations; smaller: a more even distribution.
/// 'rebuilt every frame' of the models, with '--threads' of all CPUs.
constexpr uint32_t kTreeletsAtATime = 8;
/// The most objects of a treelet, a subtree that one SPE builds, unless they are in fewer than four groups.
/// Larger: fewer top levels, which one SPE builds alone, and better splits; smaller: a more even
/// distribution. 'rebuilt every frame' of the models, and their rays.
constexpr uint32_t kTreeletObjects = 64;
/// Ranges of more references are split with kManyBins on each axis, others with kFewBins, whose nine split
/// planes fit the lanes of a register. More bins find better splits but cost more, which pays only for many
/// references. 'rebuilt every frame' of the models, and their rays.
constexpr uint32_t kFewReferences = 32;
constexpr uint32_t kFewBins = 4;
constexpr uint32_t kManyBins = 8;

} // namespace celltrace::kernel::tuning
