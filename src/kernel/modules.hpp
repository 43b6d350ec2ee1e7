// The tracer's code modules, of two regions. In each lies what never runs together. Kernel dialect.
//
// Which functions a module has, modules.ld says; `bytes` is checked by the test of the program's budget.
#pragma once

#include "celltrace/spe/code_module.hpp"

namespace celltrace::kernel::modules {

// Of the first region: what finds hits, and what asks nobody else.

/// Intersections with the shapes that are no spheres, triangles and planes, but for heavy ones, and what is
/// inside of shapes, which CSG asks.
constexpr CodeModule kShapes = {"shapes", 1, 0, 14336};
/// Intersections with heavy shapes.
constexpr CodeModule kHeavyShapes = {"heavy", 4, 0, 8192};
/// Where hits lie on objects, and the normals there.
constexpr CodeModule kHits = {"hits", 5, 0, 14336};
/// What a program does once for many frames: it makes its objects, and builds the grid.
constexpr CodeModule kStart = {"start", 3, 0, 24576};
/// Patterns without noise, and those of noise with its tables.
constexpr CodeModule kPatterns = {"patterns", 7, 0, 5120};
constexpr CodeModule kNoise = {"noise", 8, 0, 16384};

// Of the second region: what shades, and asks patterns.

/// Rays that go on from surfaces.
constexpr CodeModule kSecondary = {"secondary", 2, 1, 14336};
/// Light that is not simply a point's.
constexpr CodeModule kLights = {"lights", 6, 1, 5120};
/// The sampling of lights that have an area.
constexpr CodeModule kAreas = {"areas", 15, 1, 12288};
/// The rays of cameras whose pictures are not flat.
constexpr CodeModule kCameras = {"cameras", 10, 1, 8192};
/// Pigments and normals, but for the patterns themselves.
constexpr CodeModule kTextures = {"textures", 9, 1, 12288};
constexpr CodeModule kNormals = {"normals", 11, 1, 12288};

// Of the third region: stages of which only one is under way. Rays are not traced while surfaces are shaded.

/// Tests of objects that have a shape of the first region, or are parts of a CSG.
constexpr CodeModule kObjects = {"objects", 12, 2, 10240};
/// Shading of surfaces with textures, or of several materials.
constexpr CodeModule kComposed = {"composed", 13, 2, 10240};
/// Exchange of units of work with other SPEs.
constexpr CodeModule kExchange = {"exchange", 14, 2, 6144};

} // namespace celltrace::kernel::modules
