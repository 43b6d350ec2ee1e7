// Charges for SpuBase::compute(): what an SPU executes in the kernels besides the SIMD facade's arithmetic.
// That is control flow, scalar loads with their rotations, and quadwords that functions pass through local
// store. Kernel dialect.
//
// Fitted to what the machine code of the real SPE program (spu-elf-g++ 9.3, -O2) executes, by
// tools/calibrate-charges.sh; see docs/calibration.md. The script writes the numbers.
#pragma once

#include "celltrace/spe/spu.hpp"

namespace celltrace::kernel {

namespace scalar_work {

// Each is {fixed, floating, memory, shuffle, branches, shift, waits, misses}.

// --- accel/traversal.hpp and what it includes ---
/// Setting up the traversal of the grid with a packet.
constexpr ScalarWork kVoxelWalk = {82, 0, 450, 38, 8, 1, 72, 14, "kVoxelWalk"};
/// A step to the next voxels. Most of it loads and stores the state of the walk, which exceeds the registers.
constexpr ScalarWork kPacketStep = {19, 0, 100, 3, 7, 1, 23, 32, "kPacketStep"};
/// Selecting the rays of a packet that are in the same voxel.
constexpr ScalarWork kVoxelOfPacket = {13, 0, 0, 20, 3, 0, 46, 16, "kVoxelOfPacket"};
/// The loop over the objects of a voxel or leaf, with the hit filter.
constexpr ScalarWork kListedObject = {22, 0, 13, 16, 10, 2, 52, 69, "kListedObject"};
/// The frustum of some rays: the intervals of their origins and directions.
constexpr ScalarWork kFrustum = {126, 17, 110, 50, 30, 5, 344, 199, "kFrustum"};
/// Expanding a node of the BVH: the children that a frustum hits, pushed in order of distance.
constexpr ScalarWork kBvhNode = {62, 1, 48, 30, 14, 8, 116, 88, "kBvhNode"};
/// A child of it that is tested against the frusta of packets or the rays of a packet.
constexpr ScalarWork kBvhChild = {44, 0, 30, 24, 11, 14, 81, 72, "kBvhChild"};
/// Preparing the rays of a packet for slab tests, and one such test.
constexpr ScalarWork kRaysOfPacket = {9, 0, 28, 3, 4, 2, 15, 10, "kRaysOfPacket"};
constexpr ScalarWork kRaysAgainstBounds = {46, 0, 68, 20, 17, 15, 68, 92, "kRaysAgainstBounds"};
/// A packet that traverses a node separately from its bundle, and a ray that does so from its packet.
constexpr ScalarWork kPacketAlone = {45, 0, 44, 32, 5, 1, 103, 36, "kPacketAlone"};
constexpr ScalarWork kRayAlone = {51, 6, 44, 36, 6, 0, 83, 40, "kRayAlone"};
/// The intersection test of a packet and an object, by ObjectKind.
constexpr ScalarWork kTestSphere = {76, 0, 244, 0, 4, 3, 0, 41, "kTestSphere"};
constexpr ScalarWork kTestEllipsoid = {104, 14, 305, 20, 2, 0, 124, 13, "kTestEllipsoid"};
constexpr ScalarWork kTestTriangle = {158, 0, 513, 4, 17, 7, 36, 36, "kTestTriangle"};
constexpr ScalarWork kTestPlane = {60, 0, 160, 0, 4, 3, 0, 30, "kTestPlane"};
constexpr ScalarWork kTest[4] = {kTestSphere, kTestTriangle, kTestPlane, kTestEllipsoid};
/// Merging its result into the closest hits.
constexpr ScalarWork kClosest = {27, 0, 18, 0, 11, 5, 21, 46, "kClosest"};
/// Merging its result into the occlusion of shadow rays.
constexpr ScalarWork kShadow = {37, 0, 92, 6, 5, 3, 12, 25, "kShadow"};
/// The attenuation of one shadow ray by a translucent surface.
constexpr ScalarWork kFilter = {100, 10, 90, 50, 15, 0, 204, 97, "kFilter"};

// --- textures ---
/// A pattern's value: finding its code and its wave. Counted by hand, as it is not in the scenes that are
/// fitted.
constexpr ScalarWork kPattern = {40, 0, 60, 10, 10, 4, 40, 40, "kPattern"};

// --- shading/ray_tracer.hpp and what it calls ---
/// Making a packet of primary rays.
constexpr ScalarWork kPrimaryPacket = {379, 10, 744, 147, 72, 4, 706, 552, "kPrimaryPacket"};
/// Making the shadow rays of a packet in a bundle toward a light.
constexpr ScalarWork kBundleLight = {37, 0, 88, 16, 7, 1, 58, 45, "kBundleLight"};
/// A node of the ray tree: sorting its hits from its misses.
constexpr ScalarWork kNode = {240, 0, 208, 54, 46, 4, 279, 299, "kNode"};
/// A node copied to or from the stack.
constexpr ScalarWork kNodeCopy = {63, 0, 125, 0, 3, 0, 23, 14, "kNodeCopy"};
/// Loading an object that rays of a packet hit into their lanes.
constexpr ScalarWork kHitObject = {168, 0, 324, 47, 13, 3, 213, 73, "kHitObject"};
/// Computing the surfaces at the hit points.
constexpr ScalarWork kHitSurfaces = {130, 0, 671, 9, 9, 1, 75, 38, "kHitSurfaces"};
/// Loading a material into the lanes that have it.
constexpr ScalarWork kMaterial = {385, 0, 468, 226, 104, 1, 722, 708, "kMaterial"};
/// Shading a packet, apart from its lights.
constexpr ScalarWork kShade = {150, 0, 429, 44, 13, 1, 189, 61, "kShade"};
/// Shading by a light that some of its surfaces face.
constexpr ScalarWork kLight = {206, 0, 734, 67, 21, 1, 279, 112, "kLight"};
/// Deciding which secondary rays the surfaces need, and making reflected and transmitted ones.
constexpr ScalarWork kSecondaryRays = {134, 0, 256, 25, 9, 0, 125, 55, "kSecondaryRays"};
constexpr ScalarWork kSpawn = {145, 0, 156, 60, 12, 0, 238, 76, "kSpawn"};
constexpr ScalarWork kTransmit = {155, 0, 300, 50, 9, 0, 205, 58, "kTransmit"};
/// A ray that enters or leaves an interior.
constexpr ScalarWork kCrossing = {130, 0, 70, 60, 10, 0, 226, 65, "kCrossing"};
/// A packet of secondary rays.
constexpr ScalarWork kChild = {134, 0, 102, 60, 16, 0, 234, 105, "kChild"};

// --- accel/build_grid.hpp ---
/// The range of voxels that an object's AABB overlaps, and the overlap test of one of them.
constexpr ScalarWork kBoundsOfSphere = {127, 28, 70, 81, 12, 0, 358, 67, "kBoundsOfSphere"};
constexpr ScalarWork kBoundsOfEllipsoid = {125, 54, 63, 76, 12, 0, 347, 78, "kBoundsOfEllipsoid"};
constexpr ScalarWork kBoundsOfTriangle = {125, 54, 63, 77, 13, 1, 346, 84, "kBoundsOfTriangle"};
constexpr ScalarWork kBounds[4] = {kBoundsOfSphere, kBoundsOfTriangle, kBoundsOfSphere, kBoundsOfEllipsoid};
constexpr ScalarWork kOverlapOfSphere = {64, 28, 36, 32, 16, 0, 160, 183, "kOverlapOfSphere"};
constexpr ScalarWork kOverlapOfEllipsoid = {190, 75, 62, 71, 24, 0, 403, 156, "kOverlapOfEllipsoid"};
constexpr ScalarWork kOverlapOfTriangle = {461, 150, 174, 182, 85, 7, 802, 768, "kOverlapOfTriangle"};
constexpr ScalarWork kOverlap[4] = {kOverlapOfSphere, kOverlapOfTriangle, kOverlapOfSphere,
                                    kOverlapOfEllipsoid};
/// A pair of voxel and object: written, counted and placed by a pass of the radix sort, entered into a list.
constexpr ScalarWork kEmitPair = {19, 0, 14, 14, 4, 2, 54, 17, "kEmitPair"};
constexpr ScalarWork kCountPair = {11, 0, 4, 4, 5, 3, 17, 9, "kCountPair"};
constexpr ScalarWork kPlacePair = {23, 0, 9, 13, 6, 3, 44, 17, "kPlacePair"};
constexpr ScalarWork kListPair = {29, 0, 14, 16, 4, 1, 57, 21, "kListPair"};
/// Writing the record of a voxel.
constexpr ScalarWork kCloseVoxel = {21, 0, 19, 20, 5, 2, 55, 4, "kCloseVoxel"};

} // namespace scalar_work

} // namespace celltrace::kernel
