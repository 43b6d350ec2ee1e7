// The curves of lathes, prisms and surfaces of revolution, from their control points.
#pragma once

#include "celltrace/scene.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace celltrace::pov {

/// Kinds of splines by the words of POV-Ray.
enum class CurveKind { linear, quadratic, cubic, bezier, b_spline };

/// Words that stand in front of the arguments of shapes with a curve, besides those of splines.
enum class CurveWord { bezier, b_spline, linear_sweep, conic_sweep };

using CurvePoints = std::vector<glm::dvec2>;
/// Reports that something is wrong with a curve, and does not return.
using CurveFails = std::function<void(const std::string& what)>;

/// Returns the curve of a lathe through control points.
std::vector<CurveSegment> lathe_curve(CurveKind kind, const CurvePoints& points, const CurveFails& fail);

/// Returns the closed loops of a prism's outline; no loop at all if POV-Ray shows nothing of the prism, for
/// which `warn` is called.
std::vector<CurveSegment> prism_outline(CurveKind kind, const CurvePoints& points, const CurveFails& fail,
                                        const std::function<void(const char*)>& warn);

/// Returns the pieces of a surface of revolution, from the lowest up. The first and the last point only give
/// slopes.
std::vector<SurfaceOfRevolution::Piece> sor_pieces(const CurvePoints& points, const CurveFails& fail);

} // namespace celltrace::pov
