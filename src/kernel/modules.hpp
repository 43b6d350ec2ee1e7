// The tracer's code modules, of three regions. In each lies what never runs together. Kernel dialect.
//
// Which functions a module has, modules.ld says. The tests of the programs' budgets check that each number is
// one module's, and that none takes more than its `bytes`.
#pragma once

#include "celltrace/spe/code_module.hpp"

namespace celltrace::kernel::modules {

// Of the first region: what asks no other module.

/// Intersections with the shapes that are no spheres, triangles and planes, and what is inside of shapes,
/// which CSG asks; but for heavy ones.
constexpr CodeModule kShapes = {"shapes", 1, 0, 14592};
/// What a program does once a frame or once for many: it makes its objects, and reports.
constexpr CodeModule kStart = {"start", 3, 0, 12800};
/// The building of accelerators.
constexpr CodeModule kBuild = {"build", 16, 0, 21504};
/// Patterns without noise, and those of noise with its tables.
constexpr CodeModule kPatterns = {"patterns", 7, 0, 3200};
constexpr CodeModule kNoise = {"noise", 8, 0, 14336};
/// What becomes of the points of antialiased pictures, and which samples they need besides: by the fixed
/// method, by the adaptive one, and either with alpha.
constexpr CodeModule kSampling = {"sampling", 18, 0, 13056};
constexpr CodeModule kSquares = {"squares", 28, 0, 9984};
constexpr CodeModule kAlphaSampling = {"alphasampling", 29, 0, 13056};
constexpr CodeModule kAlphaSquares = {"alphasquares", 30, 0, 10624};
/// What primary rays hit, for main memory.
constexpr CodeModule kFirstHits = {"firsthits", 31, 0, 1408};

/// What insides take of light, and how clear they are; and mirrors that bend it.
constexpr CodeModule kFading = {"fading", 20, 0, 3968};
/// Patterns that few scenes have, many of which read tables of the scene image.
constexpr CodeModule kRarePatterns = {"rare", 22, 0, 14464};
/// What patterns ask of surfaces besides points.
constexpr CodeModule kSurfaces = {"surfaces", 25, 0, 3968};
/// Warps but for turbulence.
constexpr CodeModule kWarps = {"warps", 23, 0, 3456};

// Of the second region: what shades, and asks patterns.

/// Intersections with heavy shapes. Not of the region of the other shapes: rays test both by turns.
constexpr CodeModule kHeavyShapes = {"heavy", 4, 1, 8960};
/// What is inside of shapes whose equations have powers, and the normals of these.
constexpr CodeModule kHeavyPoints = {"heavypoints", 33, 1, 2304};
/// What is inside of meshes, and which crossings CSG sees of those without an inside. Likewise: where CSG has
/// meshes, it asks both by turns.
constexpr CodeModule kMeshes = {"meshes", 17, 1, 4864};
/// Where crossings are in polygons. Likewise, beside the shapes.
constexpr CodeModule kPolygons = {"polygons", 26, 1, 1024};
/// Instances of meshes. Likewise.
constexpr CodeModule kInstances = {"instances", 35, 1, 7808};
/// Rays that go on from surfaces.
constexpr CodeModule kSecondary = {"secondary", 2, 1, 8832};
/// Light that is not simply a point's.
constexpr CodeModule kLights = {"lights", 6, 1, 4864};
/// The sampling of lights that have an area.
constexpr CodeModule kAreas = {"areas", 15, 1, 9472};
/// The rays of cameras whose pictures are not flat, or which are far away.
constexpr CodeModule kCameras = {"cameras", 10, 1, 7808};
/// Pigments and normals, but for the patterns themselves.
constexpr CodeModule kTextures = {"textures", 9, 1, 7104};
/// The maps of textures: which of them count where.
constexpr CodeModule kMaps = {"maps", 27, 1, 7168};
constexpr CodeModule kNormals = {"normals", 11, 1, 8960};

/// What few finishes do with light, light from behind, and the materials of surfaces that look different from
/// inside.
constexpr CodeModule kFinishes = {"finishes", 19, 1, 5248};

// Of the third region: stages of which only one is under way. Rays are not traced while surfaces are shaded.

/// Tests of objects that have a shape of the first region, or are parts of a CSG.
constexpr CodeModule kObjects = {"objects", 12, 2, 6784};
/// Where hits lie on objects, and the normals there.
constexpr CodeModule kHits = {"hits", 5, 2, 7808};
/// Shading of surfaces with textures, or of several materials.
constexpr CodeModule kComposed = {"composed", 13, 2, 7168};
/// What rays pass through on their way or see before what they hit or behind it.
constexpr CodeModule kAtmosphere = {"atmosphere", 24, 2, 7168};
/// What rays see that hit nothing, where there is a sky.
constexpr CodeModule kSky = {"sky", 34, 2, 2048};
/// Shadow rays that go from surface to surface.
constexpr CodeModule kShadowWalk = {"walk", 21, 2, 5632};
/// Pixels become blocks of BC1.
constexpr CodeModule kEncoding = {"encoding", 32, 2, 6976};
/// Exchange of units of work with other SPEs.
constexpr CodeModule kExchange = {"exchange", 14, 2, 4992};

} // namespace celltrace::kernel::modules
