// Shapes that are made of any number of parts: polynomials, prisms, lathes, surfaces of revolution and blobs, in
// double precision; and the transformations from the spaces in which the kernel has them.
#pragma once

#include "celltrace/scene.hpp"
#include "geometry/extent.hpp"
#include "geometry/shape_geometry.hpp"

#include <optional>
#include <vector>

namespace celltrace {

/// The rectangle around a curve.
struct CurveBounds {
  double min_x, max_x, min_y, max_y;

  /// Returns the tight bounds of one piece, or of all pieces, of which there has to be at least one.
  static CurveBounds of(const CurveSegment& segment);
  static CurveBounds of(const std::vector<CurveSegment>& segments);
};

/// Returns the greatest power of w in a curve, 1 to 3.
int degree_of(const std::vector<CurveSegment>& segments);

/// Returns a distance from the origin beyond which the terms of the highest degree prevail.
double scale_of(const Polynomial& polynomial);

// Return the transformation from the space of the kernel's shape to the object's space, and nothing if the
// shape has no surface.
std::optional<Transform> frame_of(const Prism& prism);
std::optional<Transform> frame_of(const Lathe& lathe);
std::optional<Transform> frame_of(const SurfaceOfRevolution& sor);
std::optional<Transform> frame_of(const Blob& blob);

/// Returns the height of a prism's lower end in that space.
float lower_end_of(const Prism& prism);

} // namespace celltrace

namespace celltrace::geometry {

// The functions of shape_geometry.hpp for these shapes.

void find_crossings(const Polynomial& polynomial, const Ray& ray, Crossings& found);
void find_crossings(const Prism& prism, const Ray& ray, Crossings& found);
void find_crossings(const Lathe& lathe, const Ray& ray, Crossings& found);
void find_crossings(const SurfaceOfRevolution& sor, const Ray& ray, Crossings& found);
void find_crossings(const Blob& blob, const Ray& ray, Crossings& found);

bool is_inside(const Polynomial& polynomial, const Vec3& point);
bool is_inside(const Prism& prism, const Vec3& point);
bool is_inside(const Lathe& lathe, const Vec3& point);
bool is_inside(const SurfaceOfRevolution& sor, const Vec3& point);
bool is_inside(const Blob& blob, const Vec3& point);

Extent extent_of(const Polynomial& polynomial);
Extent extent_of(const Prism& prism);
Extent extent_of(const Lathe& lathe);
Extent extent_of(const SurfaceOfRevolution& sor);
Extent extent_of(const Blob& blob);

} // namespace celltrace::geometry
