// The tracer's code modules, of one region: what never runs together. Kernel dialect.
//
// Which functions a module has, modules.ld says; `bytes` is checked by the test of the program's budget.
#pragma once

#include "celltrace/spe/code_module.hpp"

namespace celltrace::kernel::modules {

/// Intersections with the shapes that are no spheres and triangles, but for heavy ones, and what is inside of
/// shapes, which CSG asks.
constexpr CodeModule kShapes = {"shapes", 1, 0, 14336};
/// Intersections with heavy shapes.
constexpr CodeModule kHeavyShapes = {"heavy", 4, 0, 8192};
/// The normals of shapes.
constexpr CodeModule kNormals = {"normals", 5, 0, 8192};
/// Rays that go on from surfaces.
constexpr CodeModule kSecondary = {"secondary", 2, 0, 14336};
/// Light that is not simply a point's.
constexpr CodeModule kLights = {"lights", 6, 0, 12288};
/// The rays of cameras whose pictures are not flat.
constexpr CodeModule kCameras = {"cameras", 7, 0, 8192};
/// What a program does once for many frames: it makes its objects, and builds the grid.
constexpr CodeModule kStart = {"start", 3, 0, 20480};

} // namespace celltrace::kernel::modules
