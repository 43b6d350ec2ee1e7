// Thresholds of the tracer that were found by measuring. Kernel dialect.
//
// Each threshold trades one cost for another; none decides what is in a picture. To measure one again, change
// it, build bench/compare twice, and run both programs in turn, several times:
//
//   celltrace_compare --only 'MEASURE/SCENE$' --threads 1 --clock processor --runs 5
//
// Each comment names MEASURE and SCENE; "rays of the models" is 'rays/(bunny|head|legocar|suzanne)$'. A value
// stays unless another is better by more than the difference between runs of one program. Values are for
// direct memory unless the comment says otherwise. bench/sweep-thresholds tries half, double and off for the
// thresholds that scenes are sensitive to, and writes a table of the gain of each.
#pragma once

#include <stdint.h>

namespace celltrace::kernel::tuning {

// --- bundles of rays ---

/// Packets per side of a bundle; one SPE traces the bundle as a whole. Larger: more packets share the
/// traversal of a node; smaller: less memory for their state. Four is what the SIMD lanes of a frustum test
/// have room for; two is what local store has room for. Rays of the models; for an SPE `celltrace render
/// --backend cell_emu --schedule lockstep --stats -`, whose cycles count.
constexpr uint32_t kBundleEdge = 4;
constexpr uint32_t kBundleEdgeInLocalStore = 2;

/// Largest difference between the directions of rays that share a frustum. Larger: fewer traversals, with
/// looser frusta; smaller: more traversals, with tighter ones. 'trace time' of scenes with mirrors and glass;
/// also for SPEs.
constexpr float kMaxDirectionSpread = 1.0f;

/// Largest difference between the directions of a packet's rays that are traced at once; more divergent rays
/// are traced in blocks of 2x2 or one by one. Where processors test all lanes at once, one traversal with all
/// rays of an octant (whose directions differ by 3 at most) costs less, even if many of its nodes are hit by
/// few rays. 'trace time' of scenes with mirrors.
constexpr float kMaxPacketSpread = 3.0f;
constexpr float kMaxPacketSpreadInLocalStore = kMaxDirectionSpread;

/// A packet whose rays go to several octants is traced as a whole if it has at least kLeastMixedRays rays and
/// the scene at most kMostObjectsOfMixedRays objects, which a core's caches hold. Rays of other packets have
/// few nodes in common and are traced octant by octant, with a frustum, or one by one if they diverge. 'trace
/// time' of scenes with mirrors and glass.
constexpr int kLeastMixedRays = 4;
constexpr uint32_t kMostObjectsOfMixedRays = 40000;
/// Most objects of a scene in which packets of one octant are traced without a frustum, too. Larger: nodes
/// that a frustum misses are tested ray by ray; smaller: frusta are computed although there is hardly a node
/// to miss. 'trace time' of scenes with mirrors and glass.
constexpr uint32_t kMostObjectsWithoutFrusta = 64;

/// Least number of rays, hits or shadow rays of one tree that go on as a packet by themselves; smaller groups
/// are gathered into full packets. Larger: fewer lanes are empty; smaller: more packets have rays that are
/// close to each other. 'trace time' of scenes with mirrors and glass, at 320x240.
constexpr int kLeastRaysByThemselves = 12;

/// Least number of rounds of iteration of fractals, summed over a bundle's packets, for which the packets of
/// the next bundle are iterated together. Larger: packets wait for their last lanes; smaller: hits are
/// determined twice. 'trace time' of fractals.
constexpr uint32_t kLeastRoundsOfFractals = 1000;

/// Least number of a bundle's packets with two corners on different materials for which the bundle's rays are
/// sorted by material, if sorting is found to pay. Smaller: materials are counted in vain; larger: packets
/// with several materials stay. 'trace time' of scenes with many small objects; other scenes show the cost.
constexpr uint32_t kLeastMixedPackets = 4;

/// Most nodes that are tested against a bundle's frustum before the bundle's rays are made. Larger: more of
/// the bundles without a hit are found; smaller: the tighter frusta of packets are tested from an earlier
/// node on. Rays of the models, above all legocar, whose picture is largely empty.
constexpr uint32_t kMaxEnteredNodes = 24;

/// Number of nodes, hit by a packet's frustum but by none of its rays, from which on the packet counts as
/// incoherent and its rays are tested as well. Larger: more nodes are hit in vain; smaller: rays are tested
/// where frusta would do. Matters at silhouettes, where origins of shadow rays lie far apart. Rays of the
/// models; also for SPEs.
constexpr uint32_t kMissesOfIncoherent = 2;
/// A packet of shadow rays counts as incoherent if its rectangle, seen from the light, exceeds its share of
/// the bundle's rectangle by this factor. Its origins then lie on several surfaces, and its frustum hits
/// leaves in between that no ray hits. Therefore its rays are tested against leaves' bounds as well. Larger:
/// triangles are tested in vain; smaller: rays are tested where frusta would do. 'refitted every
/// frame/(hills|random)-100000'.
constexpr float kIncoherentOrigins = 1.5f;

/// Most objects of a scene, besides planes, with which packets are tested against all objects without a
/// traversal of the bundle. Larger: objects are tested that a frustum would miss; smaller: frusta are
/// computed for a single leaf. 'trace time' of scenes with one or two objects.
constexpr uint32_t kMostListedObjects = 2;

// --- when packets of a bundle part ---

/// Most packets of a bundle that may traverse a node separately. Larger: packets share fewer nodes; smaller:
/// more nodes are tested for packets that do not hit them. Rays of the bunny, whose triangles are smaller
/// than pixels.
constexpr uint32_t kMaxSplitPackets = 4;
/// Number of pixels per object, or of a stream's rays in a unit square per object, below which up to
/// kMaxSplitPackets packets split: each hits other nodes. Larger: packets split at larger triangles, too.
/// Rays of the models.
constexpr uint32_t kPixelsOfSmallObject = 2;

// Cache sizes are those of a usual PC, not of the computer that renders: they decide the order in which a
// pixel's light is added up, and pixels are to be the same on all computers.

/// Bytes of an object's record and its share of the nodes.
constexpr uint32_t kBytesOfObject = 100;
constexpr uint32_t objects_in(uint32_t bytes) {
  return bytes / kBytesOfObject;
}

/// Bytes of objects and nodes that the caches of one core mostly hold; leaves of smaller scenes are tested at
/// once. In larger scenes leaves are deferred while their objects are prefetched, and normals at hits are
/// prefetched a packet ahead. Smaller: leaves are deferred although nothing has to be waited for; larger:
/// tests wait for memory. Rays of head (17,684 objects) and bunny (69,630), and 'trace time' of scenes of
/// 20,000 to 40,000 objects with mirrors and glass, which takes up to 5 % longer if their leaves are
/// deferred.
constexpr uint32_t kCoreCacheBytes = 4'000'000;
constexpr uint32_t kObjectsInCoreCache = objects_in(kCoreCacheBytes);
/// Most leaves that are deferred. Once kEnoughDeferredLeaves are waiting, their objects are tested after the
/// next node is expanded. Larger: more time to fetch the objects; smaller: hits shorten tfar sooner. Rays of
/// the bunny and of generated models: '--primitives 1000000'.
constexpr uint32_t kMaxDeferredLeaves = 8;
constexpr uint32_t kEnoughDeferredLeaves = kMaxDeferredLeaves / 2;
/// Bytes of objects and nodes beyond which nodes lie in main memory, and the traversals of packets are
/// interleaved. Smaller: state is saved and restored although no node has to be waited for. Where objects lie
/// at random, interleaving begins to pay at ten million. Rays of generated models, '--primitives 1000000
/// 4000000 10000000'.
constexpr uint32_t kNearBytes = 400'000'000;
constexpr uint32_t kMostObjectsOfNearNodes = objects_in(kNearBytes);
/// Traversals that are interleaved. Larger: more time to fetch a node; smaller: less state to keep in cache.
/// Rays of generated models, '--primitives 10000000'.
constexpr uint32_t kMaxInterleaved = 4;

// --- objects that move ---

/// Factor by which refitting may raise the expected cost of a ray, by the surface area heuristic, before the
/// BVH is built again. Larger: rays go through looser nodes; smaller: more builds, which cost several times
/// as much as refits. Frames of 'refitted every frame/'.
constexpr double kMostDecay = 1.5;

// --- tests of triangles ---

/// Most rays, and least triangles of a leaf, for which a leaf is tested ray by ray with its triangles in
/// lanes. More rays would need more passes, and fewer triangles would leave lanes empty: then each triangle
/// is tested against all rays at once. Rays of bunny and legocar; `bench_triangles`.
/// ObjectTests::test_occlusion_by_leaf(), which keeps rays to a light in registers, also tests leaves from
/// kLeastTrianglesByLeaf objects on: loading the rays does not pay for fewer. 'trace time' of soft shadows.
constexpr int kMostRaysByLeaf = 4;
constexpr uint32_t kLeastTrianglesByLeaf = 4;

// --- lights with an area ---

/// Most objects that are remembered as occluders between a packet and an area light; if there are more, rays
/// toward the light's places are tested against leaves. Larger: each ray is tested against objects that are
/// nowhere near it; smaller: more rays are tested against leaves. 'trace time/area-light'.
constexpr uint32_t kMostAreaOccluders = 16;
/// Most nodes with leaves between a packet and an area light; if there are more, each ray traverses the BVH
/// from its root. Larger: leaves are tested that are nowhere near a ray; smaller: more rays traverse. 'trace
/// time/area-light', and scenes with more objects.
constexpr uint32_t kMostAreaNodes = 64;

/// Most packets of rays to places on a light that are tested together. Larger: more rays are tested beside
/// each other; smaller: they stay in the first-level cache. 'trace time' of soft shadows.
constexpr uint32_t kMostAreaPackets = 16;

// --- patterns ---

/// Most cells of crackle whose feature points are gathered for a packet cell by cell; if a packet's points
/// are in more cells, each lane is compared with the feature points around its own cell. 'trace time' of
/// scenes with crackle near by and as far as the horizon.
constexpr uint32_t kMostCellsOfFeatures = 2;
/// The corresponding limit if gathered feature points are kept for neighbouring points.
constexpr uint32_t kMostCellsInCache = 8;

// --- building the BVH ---

/// Rule that decides whether the objects of a range share a leaf. A triangle has weight 1. Two or three
/// objects that would not fill a node always share a leaf, except in a scene of few objects.
struct LeafRule {
  uint32_t certain;       ///< total weight up to which objects share a leaf
  uint32_t most;          ///< total weight above which objects share none; between the two, the SAH decides
  float cost;             ///< cost of testing an object of weight 1, relative to expanding a node
  uint32_t sphere_weight; ///< weight of a sphere, which is tested in little time and fills most of its bounds
  uint32_t other_weight;  ///< weight of other objects; most tests of thin cylinders are in vain
};
/// Rule for large leaves, in which SPEs test many triangles at once. Larger: fewer nodes are built and
/// expanded; smaller: fewer objects are tested in vain. 'rebuilt every frame' and rays of the models; for
/// weights 'trace time' of molecules and of scenes with a few simple shapes.
constexpr LeafRule kLargeLeaves = {12, 32, 0.5f, 2, 3};
/// Most rays of a packet that are traced one by one in an instance's mesh. Larger: fewer lanes idle; smaller:
/// fewer nodes are expanded more than once. 'trace time' of scenes with many instances.
constexpr int kMostRaysAlone = 1;
/// Rule for small leaves, whose objects are tested one by one. `celltrace render --backend cell_emu
/// --schedule lockstep --stats -`, whose cycles count.
constexpr LeafRule kSmallLeaves = {3, 16, 2.0f, 2, 2};
/// Rule for copied treelets, in which four objects share a leaf: a node for them would take memory in every
/// copy, and rays would wait for it longer than the tests take. 'first frame' of a scene with many instances
/// of one mesh.
constexpr LeafRule kCopiedLeaves = {4, 8, 2.0f, 1, 1};
/// Bytes of a scene up to which leaves are large: the cache that a PC's cores share holds the whole scene.
/// Larger: objects that no ray hits are fetched from main memory; smaller: more nodes are built and expanded.
/// Rays of generated models, '--primitives 100000 1000000'.
constexpr uint32_t kSharedCacheBytes = 50'000'000;
constexpr uint32_t kMostObjectsOfLargeLeaves = objects_in(kSharedCacheBytes);

/// Treelets that an SPE takes at a time. Larger: fewer atomic operations; smaller: a more even distribution.
/// 'rebuilt every frame' of the models, with '--threads' of all CPUs.
constexpr uint32_t kTreeletsAtATime = 8;
/// Most objects of a treelet, a subtree that one SPE builds, unless they are in fewer than four groups.
/// Larger: fewer top levels, which one SPE builds alone, and better splits; smaller: a more even
/// distribution. 'rebuilt every frame' of the models, and their rays.
constexpr uint32_t kTreeletObjects = 64;
/// References of a range above which it is split with kManyBins on each axis, otherwise with kFewBins, whose
/// nine split planes fit the lanes of a register. More bins find better splits but cost more, which pays only
/// for many references. 'rebuilt every frame' of the models, and their rays.
constexpr uint32_t kFewReferences = 32;
constexpr uint32_t kFewBins = 4;
constexpr uint32_t kManyBins = 8;

} // namespace celltrace::kernel::tuning
