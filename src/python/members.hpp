// The numbers of members of the structures that scenes are made of, and their members as tuples. When a
// structure gets another member, the compiler complains about its number here.
#pragma once

#include "celltrace/cache.hpp"
#include "celltrace/error.hpp"
#include "celltrace/render.hpp"
#include "celltrace/scene.hpp"

#include <tuple>

namespace celltrace {

/// Number of members; 0: none that matter.
template <class T> inline constexpr int kMembers = -1;

template <> inline constexpr int kMembers<Turbulence> = 4;
template <> inline constexpr int kMembers<pattern::Checker> = 0;
template <> inline constexpr int kMembers<pattern::Square> = 0;
template <> inline constexpr int kMembers<pattern::Hexagon> = 0;
template <> inline constexpr int kMembers<pattern::Triangular> = 0;
template <> inline constexpr int kMembers<pattern::Cubic> = 0;
template <> inline constexpr int kMembers<pattern::Brick> = 2;
template <> inline constexpr int kMembers<pattern::Gradient> = 1;
template <> inline constexpr int kMembers<pattern::Boxed> = 0;
template <> inline constexpr int kMembers<pattern::Spherical> = 0;
template <> inline constexpr int kMembers<pattern::Cylindrical> = 0;
template <> inline constexpr int kMembers<pattern::Planar> = 0;
template <> inline constexpr int kMembers<pattern::Leopard> = 0;
template <> inline constexpr int kMembers<pattern::Onion> = 0;
template <> inline constexpr int kMembers<pattern::Radial> = 0;
template <> inline constexpr int kMembers<pattern::Spiral> = 2;
template <> inline constexpr int kMembers<pattern::Quilted> = 1;
template <> inline constexpr int kMembers<pattern::Bozo> = 0;
template <> inline constexpr int kMembers<pattern::Bumps> = 0;
template <> inline constexpr int kMembers<pattern::Dents> = 0;
template <> inline constexpr int kMembers<pattern::Granite> = 0;
template <> inline constexpr int kMembers<pattern::Wrinkles> = 0;
template <> inline constexpr int kMembers<pattern::Agate> = 1;
template <> inline constexpr int kMembers<pattern::Marble> = 0;
template <> inline constexpr int kMembers<pattern::Wood> = 0;
template <> inline constexpr int kMembers<pattern::Ripples> = 0;
template <> inline constexpr int kMembers<pattern::Waves> = 0;
template <> inline constexpr int kMembers<pattern::Cells> = 0;
template <> inline constexpr int kMembers<pattern::Crackle> = 4;
template <> inline constexpr int kMembers<pattern::Fractal> = 9;
template <> inline constexpr int kMembers<pattern::Slope> = 6;
template <> inline constexpr int kMembers<pattern::Grey> = 1;
template <> inline constexpr int kMembers<pattern::Inside> = 1;
template <> inline constexpr int kMembers<pattern::Facets> = 3;
template <> inline constexpr int kMembers<Picture> = 4;
template <> inline constexpr int kMembers<pattern::PictureMap> = 8;
template <> inline constexpr int kMembers<pattern::ImageMap> = 1;
template <> inline constexpr int kMembers<pattern::ImageGrey> = 2;
template <> inline constexpr int kMembers<pattern::Function> = 1;
template <> inline constexpr int kMembers<warp::Repeat> = 4;
template <> inline constexpr int kMembers<warp::BlackHole> = 7;
template <> inline constexpr int kMembers<warp::Mapping> = 5;
template <> inline constexpr int kMembers<Transform> = 1;
template <> inline constexpr int kMembers<Pattern> = 10;
template <class T> inline constexpr int kMembers<PatternMap<T>> = 3;
template <> inline constexpr int kMembers<PatternMap<Pigment>::Entry> = 2;
template <> inline constexpr int kMembers<PatternMap<Normal>::Entry> = 2;
template <> inline constexpr int kMembers<PatternMap<Material>::Entry> = 2;
template <> inline constexpr int kMembers<Pigment> = 4;
template <> inline constexpr int kMembers<SlopePoint> = 3;
template <> inline constexpr int kMembers<Normal> = 5;
template <> inline constexpr int kMembers<Finish> = 21;
template <> inline constexpr int kMembers<Material> = 6;

template <> inline constexpr int kMembers<Camera> = 8;
template <> inline constexpr int kMembers<Interior> = 7;
template <> inline constexpr int kMembers<Fog> = 11;
template <> inline constexpr int kMembers<Rainbow> = 9;
template <> inline constexpr int kMembers<Rainbow::Colour> = 4;
template <> inline constexpr int kMembers<LightArea> = 8;
template <> inline constexpr int kMembers<Light> = 15;
template <> inline constexpr int kMembers<LightGroup> = 2;
template <> inline constexpr int kMembers<Mesh> = 5;
template <> inline constexpr int kMembers<Mesh::Triangle> = 3;
template <> inline constexpr int kMembers<Mesh::Coordinates> = 1;
template <> inline constexpr int kMembers<Sphere> = 2;
template <> inline constexpr int kMembers<Plane> = 2;
template <> inline constexpr int kMembers<Disc> = 4;
template <> inline constexpr int kMembers<Box> = 1;
template <> inline constexpr int kMembers<Cylinder> = 4;
template <> inline constexpr int kMembers<Cone> = 5;
template <> inline constexpr int kMembers<Torus> = 2;
template <> inline constexpr int kMembers<Quadric> = 4;
template <> inline constexpr int kMembers<Superellipsoid> = 2;
template <> inline constexpr int kMembers<Polygon> = 1;
template <> inline constexpr int kMembers<Polynomial> = 2;
template <> inline constexpr int kMembers<CurveSegment> = 2;
template <> inline constexpr int kMembers<Prism> = 5;
template <> inline constexpr int kMembers<Lathe> = 1;
template <> inline constexpr int kMembers<SurfaceOfRevolution::Piece> = 3;
template <> inline constexpr int kMembers<SurfaceOfRevolution> = 2;
template <> inline constexpr int kMembers<Blob::Component> = 5;
template <> inline constexpr int kMembers<Blob> = 2;
template <> inline constexpr int kMembers<Csg> = 2;
template <> inline constexpr int kMembers<Object> = 12;
template <> inline constexpr int kMembers<Scene> = 22;

template <> inline constexpr int kMembers<Antialiasing> = 5;
template <> inline constexpr int kMembers<CacheConfig> = 6;
template <> inline constexpr int kMembers<Finding> = 7;

/// Returns references to all members of a value.
template <class T> auto tie_members(T& value) {
  constexpr int kCount = kMembers<std::remove_const_t<T>>;
  static_assert(kCount >= 0 && kCount <= 22, "a structure that is not in the list above");
  if constexpr (kCount == 0) {
    return std::tuple<>();
  } else if constexpr (kCount == 1) {
    auto& [a] = value;
    return std::tie(a);
  } else if constexpr (kCount == 2) {
    auto& [a, b] = value;
    return std::tie(a, b);
  } else if constexpr (kCount == 3) {
    auto& [a, b, c] = value;
    return std::tie(a, b, c);
  } else if constexpr (kCount == 4) {
    auto& [a, b, c, d] = value;
    return std::tie(a, b, c, d);
  } else if constexpr (kCount == 5) {
    auto& [a, b, c, d, e] = value;
    return std::tie(a, b, c, d, e);
  } else if constexpr (kCount == 6) {
    auto& [a, b, c, d, e, f] = value;
    return std::tie(a, b, c, d, e, f);
  } else if constexpr (kCount == 7) {
    auto& [a, b, c, d, e, f, g] = value;
    return std::tie(a, b, c, d, e, f, g);
  } else if constexpr (kCount == 8) {
    auto& [a, b, c, d, e, f, g, h] = value;
    return std::tie(a, b, c, d, e, f, g, h);
  } else if constexpr (kCount == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = value;
    return std::tie(a, b, c, d, e, f, g, h, i);
  } else if constexpr (kCount == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = value;
    return std::tie(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (kCount == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = value;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (kCount == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = value;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l);
  } else if constexpr (kCount == 15) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = value;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
  } else if constexpr (kCount == 21) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u] = value;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u);
  } else if constexpr (kCount == 22) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v] = value;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v);
  }
}

} // namespace celltrace
