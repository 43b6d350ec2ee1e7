// What the kernels do on an SPU besides the arithmetic of the SIMD facade, for SpuBase::compute(): walks and
// loops, scalar loads with their rotations, and the quadwords that functions hand each other in local store.
// Kernel dialect.
//
// Counted in the disassembly of the real SPE program (spu-elf-g++ 9.3, -O2): the instructions of the lines in
// question along the usual way, by unit, less those that the facade's own operations account for. Branches
// are the conditional ones; no-ops and hints are left out. Rounded: the next change of the code shifts them
// anyway.
#pragma once

#include "celltrace/spe/spu.hpp"

namespace celltrace::kernel {

namespace scalar_work {

// Each is {fixed, floating, memory, shuffle, branches}.

// --- traversal.hpp, voxel_walk.hpp ---
/// Sets a packet's walk through the grid up.
constexpr ScalarWork kVoxelWalk = {60, 0, 400, 40, 2, 0, "kVoxelWalk"};
/// A step to the next voxels: most of it is the walk itself, too large for the registers.
constexpr ScalarWork kPacketStep = {16, 0, 93, 6, 3, 0, "kPacketStep"};
/// Those of its rays that are in one voxel.
constexpr ScalarWork kVoxelOfPacket = {20, 0, 6, 6, 2, 0, "kVoxelOfPacket"};
/// The loop over a voxel's objects, and their mailbox.
constexpr ScalarWork kListedObject = {15, 0, 9, 9, 4, 0, "kListedObject"};
/// The intervals of a beam.
constexpr ScalarWork kBeam = {150, 12, 110, 70, 14, 0, "kBeam"};
/// A node of the hierarchy: the children that a beam meets, into their places on the stack.
constexpr ScalarWork kNodeOfBoxes = {80, 0, 50, 45, 12, 0, "kNodeOfBoxes"};
/// A child of it that packets' beams or a packet's rays are held against.
constexpr ScalarWork kChildOfNode = {20, 0, 15, 12, 3, 0, "kChildOfNode"};
/// The rays of a packet made ready for boxes, and held against one.
constexpr ScalarWork kRaysOfPacket = {10, 0, 30, 4, 1, 0, "kRaysOfPacket"};
constexpr ScalarWork kRaysInBox = {20, 0, 30, 12, 3, 0, "kRaysInBox"};
/// A packet that leaves its bundle, and a ray that leaves its packet.
constexpr ScalarWork kPacketAlone = {40, 0, 40, 30, 4, 0, "kPacketAlone"};
constexpr ScalarWork kRayAlone = {60, 6, 50, 40, 6, 0, "kRayAlone"};
/// A packet against an object, by ObjectKind.
constexpr ScalarWork kTestSphere = {78, 0, 247, 0, 2, 0, "kTestSphere"};
constexpr ScalarWork kTestEllipsoid = {104, 14, 305, 20, 2, 0, "kTestEllipsoid"};
constexpr ScalarWork kTestTriangle = {152, 0, 469, 1, 2, 0, "kTestTriangle"};
constexpr ScalarWork kTest[3] = {kTestSphere, kTestEllipsoid, kTestTriangle};
/// What the search for the closest hit makes of it.
constexpr ScalarWork kClosest = {22, 0, 28, 4, 2, 0, "kClosest"};
/// What a shadow packet makes of it.
constexpr ScalarWork kShadow = {30, 0, 40, 8, 4, 0, "kShadow"};
/// The filtering of one ray by a translucent surface.
constexpr ScalarWork kFilter = {100, 10, 90, 50, 15, 0, "kFilter"};

// --- ray_tracer.hpp and what it calls ---
/// A packet of primary rays from the camera to the pixels.
constexpr ScalarWork kPrimaryPacket = {420, 8, 550, 135, 35, 0, "kPrimaryPacket"};
/// A packet of a bundle that asks for the light of a source.
constexpr ScalarWork kBundleLight = {40, 0, 100, 20, 6, 0, "kBundleLight"};
/// A node of the ray tree: its hits and misses.
constexpr ScalarWork kNode = {240, 0, 216, 51, 22, 0, "kNode"};
/// A node copied to or from the stack.
constexpr ScalarWork kNodeCopy = {60, 0, 192, 0, 2, 0, "kNodeCopy"};
/// An object that rays of a packet hit, into their lanes.
constexpr ScalarWork kHitObject = {115, 0, 240, 36, 6, 0, "kHitObject"};
/// The surfaces there.
constexpr ScalarWork kHitSurfaces = {130, 0, 560, 8, 5, 0, "kHitSurfaces"};
/// The lanes of one material.
constexpr ScalarWork kMaterial = {345, 0, 300, 185, 60, 0, "kMaterial"};
/// The surfaces of a packet, apart from their lights.
constexpr ScalarWork kShade = {150, 0, 377, 40, 8, 0, "kShade"};
/// A light that some of them face.
constexpr ScalarWork kLight = {220, 0, 560, 60, 14, 0, "kLight"};
/// What they pass on, if anything.
constexpr ScalarWork kPassOn = {130, 0, 560, 25, 8, 0, "kPassOn"};
constexpr ScalarWork kSendOn = {140, 0, 200, 60, 11, 0, "kSendOn"};
constexpr ScalarWork kTransmit = {155, 0, 300, 50, 9, 0, "kTransmit"};
/// A lane that enters or leaves an interior.
constexpr ScalarWork kCrossing = {130, 0, 70, 60, 10, 0, "kCrossing"};
/// A packet of secondary rays.
constexpr ScalarWork kChild = {130, 0, 120, 60, 15, 0, "kChild"};

// --- prepare_frame.hpp ---
/// The voxels that an object may touch, and the test of one of them.
constexpr ScalarWork kBounds = {125, 54, 63, 76, 12, 0, "kBounds"};
constexpr ScalarWork kOverlap = {190, 75, 62, 71, 24, 0, "kOverlap"};
/// A pair of voxel and object: written, counted and put in its place by a pass of the sort, put into a list.
constexpr ScalarWork kEmitPair = {22, 0, 17, 17, 2, 0, "kEmitPair"};
constexpr ScalarWork kCountPair = {12, 0, 4, 4, 1, 0, "kCountPair"};
constexpr ScalarWork kPlacePair = {25, 0, 10, 12, 2, 0, "kPlacePair"};
constexpr ScalarWork kListPair = {30, 0, 14, 16, 3, 0, "kListPair"};
/// A voxel's record.
constexpr ScalarWork kCloseVoxel = {16, 0, 10, 10, 2, 0, "kCloseVoxel"};

} // namespace scalar_work

} // namespace celltrace::kernel
