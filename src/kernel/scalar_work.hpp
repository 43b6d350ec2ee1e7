// Charges for SpuBase::compute(): the instructions that an SPU executes in the kernels besides the SIMD
// facade's arithmetic. These instructions are control flow, scalar loads with their rotations, and quadwords
// that functions pass through local store. Kernel dialect.
//
// The charges are fitted to the executed machine code of the real SPE program (spu-elf-g++ 9.3, -O2) by
// tools/calibrate-charges.sh, which writes the numbers; see docs/calibration.md.
#pragma once

#include "celltrace/spe/spu.hpp"

namespace celltrace::kernel {

namespace scalar_work {

// Each constant is {fixed, floating, memory, shuffle, branches, shift, waits, misses}.

// --- accel/traversal.hpp and what it includes ---
/// Setting up the traversal of the grid with a packet.
constexpr ScalarWork kVoxelWalk = {264, 0, 568, 68, 24, 5, 373, 31, "kVoxelWalk"};
/// A step to the next voxels. Most of it loads and stores the state of the walk, which exceeds the registers.
constexpr ScalarWork kPacketStep = {9, 0, 67, 2, 3, 0, 0, 15, "kPacketStep"};
/// Selecting the rays of a packet that are in the same voxel.
constexpr ScalarWork kVoxelOfPacket = {0, 0, 0, 0, 0, 3, 6, 38, "kVoxelOfPacket"};
/// The loop over the objects of a voxel or leaf, with the hit filter.
constexpr ScalarWork kListedObject = {11, 0, 5, 14, 0, 0, 21, 6, "kListedObject"};
/// The frustum of some rays: the intervals of their origins and directions.
constexpr ScalarWork kFrustum = {424, 12, 275, 124, 67, 14, 692, 492, "kFrustum"};
/// Expanding a node of the BVH: the children that a frustum hits, pushed in order of distance.
constexpr ScalarWork kBvhNode = {0, 2, 3, 19, 6, 6, 58, 0, "kBvhNode"};
/// Testing a child of a node against the frusta of packets or the rays of a packet.
constexpr ScalarWork kBvhChild = {97, 0, 62, 41, 15, 14, 0, 123, "kBvhChild"};
/// Preparing the rays of a packet for slab tests, and one such test.
constexpr ScalarWork kRaysOfPacket = {21, 0, 50, 11, 12, 8, 22, 13, "kRaysOfPacket"};
constexpr ScalarWork kRaysAgainstBounds = {77, 0, 51, 19, 13, 23, 0, 120, "kRaysAgainstBounds"};
/// Traversing a node with a packet apart from its bundle, and with a ray apart from its packet.
constexpr ScalarWork kPacketAlone = {55, 1, 45, 33, 5, 1, 35, 54, "kPacketAlone"};
constexpr ScalarWork kRayAlone = {63, 7, 46, 35, 6, 0, 59, 47, "kRayAlone"};
/// The intersection test of a packet and an object, by ObjectKind.
constexpr ScalarWork kTestSphere = {41, 0, 128, 0, 0, 0, 14, 0, "kTestSphere"};
constexpr ScalarWork kTestEllipsoid = {281, 0, 659, 68, 33, 10, 280, 140, "kTestEllipsoid"};
constexpr ScalarWork kTestTriangle = {94, 0, 399, 2, 11, 2, 0, 0, "kTestTriangle"};
constexpr ScalarWork kTestPlane = {80, 0, 73, 9, 22, 7, 21, 146, "kTestPlane"};
constexpr ScalarWork kTest[4] = {kTestSphere, kTestTriangle, kTestPlane, kTestEllipsoid};
/// Merging the result of a test into the closest hits.
constexpr ScalarWork kClosest = {47, 0, 15, 9, 19, 6, 35, 92, "kClosest"};
/// Merging the result of a test into the occlusion of shadow rays.
constexpr ScalarWork kShadow = {14, 0, 17, 10, 17, 6, 36, 85, "kShadow"};
/// The attenuation of one shadow ray by a translucent surface.
constexpr ScalarWork kFilter = {139, 0, 129, 47, 25, 2, 58, 242, "kFilter"};

// --- textures ---
/// Evaluating a pattern, including its place in a tree of maps and the colours or normals there. Estimated
/// from textures.pov and patterns.pov instead of fitted, as the code of patterns differs much.
constexpr ScalarWork kPattern = {1300, 0, 800, 100, 110, 40, 900, 550, "kPattern"};

// --- shading/ray_tracer.hpp and what it calls ---
/// Making a packet of primary rays.
constexpr ScalarWork kPrimaryPacket = {282, 5, 554, 73, 44, 7, 0, 118, "kPrimaryPacket"};
/// Making the shadow rays of a packet in a bundle toward a light.
constexpr ScalarWork kBundleLight = {66, 0, 152, 22, 12, 2, 115, 60, "kBundleLight"};
/// A node of the ray tree: sorting its hits from its misses.
constexpr ScalarWork kNode = {286, 0, 166, 51, 60, 9, 0, 436, "kNode"};
/// Copying a node of the ray tree to or from the stack.
constexpr ScalarWork kNodeCopy = {171, 0, 207, 4, 12, 3, 77, 25, "kNodeCopy"};
/// Loading an object that rays of a packet hit into their lanes.
constexpr ScalarWork kHitObject = {329, 0, 452, 74, 24, 7, 249, 148, "kHitObject"};
/// Computing the surfaces at the hit points.
constexpr ScalarWork kHitSurfaces = {161, 0, 772, 10, 14, 4, 61, 44, "kHitSurfaces"};
/// Loading a material into the lanes that have it.
constexpr ScalarWork kMaterial = {553, 0, 724, 246, 209, 5, 825, 1085, "kMaterial"};
/// Shading a packet, apart from its lights.
constexpr ScalarWork kShade = {113, 0, 250, 45, 18, 4, 22, 60, "kShade"};
/// Shading by a light that some of its surfaces face.
constexpr ScalarWork kLight = {281, 0, 446, 90, 42, 6, 337, 270, "kLight"};
/// Deciding which secondary rays the surfaces need, and making reflected and transmitted ones.
constexpr ScalarWork kSecondaryRays = {174, 0, 276, 30, 14, 2, 273, 73, "kSecondaryRays"};
constexpr ScalarWork kSpawn = {190, 0, 164, 76, 18, 2, 708, 105, "kSpawn"};
constexpr ScalarWork kTransmit = {151, 0, 375, 49, 11, 1, 201, 74, "kTransmit"};
/// A ray that enters or leaves an interior.
constexpr ScalarWork kCrossing = {31, 0, 20, 23, 22, 9, 3, 98, "kCrossing"};
/// A packet of secondary rays.
constexpr ScalarWork kChild = {150, 0, 96, 74, 25, 2, 799, 149, "kChild"};

// --- accel/build_grid.hpp ---
/// The range of voxels that an object's AABB overlaps, and the overlap test of one of them.
constexpr ScalarWork kBoundsOfSphere = {72, 25, 80, 76, 11, 0, 49, 67, "kBoundsOfSphere"};
constexpr ScalarWork kBoundsOfEllipsoid = {137, 50, 67, 79, 13, 0, 468, 87, "kBoundsOfEllipsoid"};
constexpr ScalarWork kBoundsOfTriangle = {67, 55, 24, 66, 11, 1, 204, 48, "kBoundsOfTriangle"};
constexpr ScalarWork kBounds[4] = {kBoundsOfSphere, kBoundsOfTriangle, kBoundsOfSphere, kBoundsOfEllipsoid};
constexpr ScalarWork kOverlapOfSphere = {85, 26, 26, 36, 14, 0, 179, 166, "kOverlapOfSphere"};
constexpr ScalarWork kOverlapOfEllipsoid = {118, 15, 95, 83, 34, 1, 504, 291, "kOverlapOfEllipsoid"};
constexpr ScalarWork kOverlapOfTriangle = {638, 154, 193, 200, 93, 9, 898, 782, "kOverlapOfTriangle"};
constexpr ScalarWork kOverlap[4] = {kOverlapOfSphere, kOverlapOfTriangle, kOverlapOfSphere,
                                    kOverlapOfEllipsoid};
/// Handling a pair of voxel and object: writing it, counting it and placing it in a pass of the radix sort,
/// entering it into a list.
constexpr ScalarWork kEmitPair = {29, 0, 25, 19, 7, 1, 65, 24, "kEmitPair"};
constexpr ScalarWork kCountPair = {2, 0, 0, 2, 2, 3, 2, 3, "kCountPair"};
constexpr ScalarWork kPlacePair = {6, 0, 0, 8, 2, 3, 0, 7, "kPlacePair"};
constexpr ScalarWork kListPair = {118, 1, 53, 30, 12, 2, 163, 59, "kListPair"};
/// Writing the record of a voxel.
constexpr ScalarWork kCloseVoxel = {18, 0, 9, 18, 2, 3, 64, 6, "kCloseVoxel"};

} // namespace scalar_work

} // namespace celltrace::kernel
