// All patterns. The order determines their kinds, which are numbers in records. Kernel dialect.
//
// A pattern P has, from pattern_traits.hpp or of its own,
//   kName
//   kIsList        true if its value is the index of a map's entry
//   kIsColour      true if it has colours in place of values
//   kCode          location of its code
//   kReadsSurface  true if its value depends on more than points
//   kDisturbs      true if its normals are not the slope of its value; their code is in the module of rare
//                  patterns for a rare pattern, otherwise in the module of noise
//   value(p, record)        also takes the noise generator if P is a noise pattern; takes PatternPoints
//                           instead of a point if kReadsSurface
//   disturbance(p, record)  if P disturbs
// Functions of rare patterns take the scene first.
#pragma once

#include "kernel/textures/agate.hpp"
#include "kernel/textures/boxed.hpp"
#include "kernel/textures/bozo.hpp"
#include "kernel/textures/brick.hpp"
#include "kernel/textures/bumps.hpp"
#include "kernel/textures/cells.hpp"
#include "kernel/textures/checker.hpp"
#include "kernel/textures/crackle.hpp"
#include "kernel/textures/cubic.hpp"
#include "kernel/textures/cylindrical.hpp"
#include "kernel/textures/dents.hpp"
#include "kernel/textures/fractal.hpp"
#include "kernel/textures/function.hpp"
#include "kernel/textures/gradient.hpp"
#include "kernel/textures/granite.hpp"
#include "kernel/textures/hexagon.hpp"
#include "kernel/textures/image_map.hpp"
#include "kernel/textures/leopard.hpp"
#include "kernel/textures/marble.hpp"
#include "kernel/textures/object_pattern.hpp"
#include "kernel/textures/onion.hpp"
#include "kernel/textures/pigment_pattern.hpp"
#include "kernel/textures/planar.hpp"
#include "kernel/textures/quilted.hpp"
#include "kernel/textures/radial.hpp"
#include "kernel/textures/ripples.hpp"
#include "kernel/textures/slope.hpp"
#include "kernel/textures/spherical.hpp"
#include "kernel/textures/spiral1.hpp"
#include "kernel/textures/spiral2.hpp"
#include "kernel/textures/square.hpp"
#include "kernel/textures/triangular.hpp"
#include "kernel/textures/waves.hpp"
#include "kernel/textures/wood.hpp"
#include "kernel/textures/wrinkles.hpp"
#include "kernel/type_list.hpp"

namespace celltrace::kernel {

template <class... P> struct PatternList : TypeList<P...> {
  static constexpr PatternCode kCode[] = {P::kCode...};
  static constexpr bool kAreLists[] = {P::kIsList...};
  static constexpr bool kDisturb[] = {P::kDisturbs...};
  static constexpr bool kReadNoise[] = {P::kReadsNoise...};
  static constexpr bool kAreShifted[] = {P::kIsShifted...};
  static constexpr bool kSomeAreColours = (P::kIsColour || ...);
  static constexpr bool is_colour(uint32_t kind) {
    return ((P::kIsColour ? kind == TypeList<P...>::template number<P>() : false) || ...);
  }
  static constexpr bool kReadSurfaces[] = {P::kReadsSurface...};
};

using Patterns =
    PatternList<CheckerPattern, GradientPattern, BozoPattern, BumpsPattern, BoxedPattern, SphericalPattern,
                CylindricalPattern, PlanarPattern, OnionPattern, LeopardPattern, RadialPattern,
                Spiral1Pattern, Spiral2Pattern, QuiltedPattern, SquarePattern, TriangularPattern,
                HexagonPattern, CubicPattern, BrickPattern, DentsPattern, GranitePattern, WrinklesPattern,
                AgatePattern, MarblePattern, WoodPattern, CellsPattern, CracklePattern, RipplesPattern,
                WavesPattern, FractalPattern, SlopePattern, PigmentPattern, ObjectPattern, ImageMapPattern, ImagePattern,
                FunctionPattern>;
constexpr bool is_colour(uint32_t kind) {
  return Patterns::is_colour(kind);
}
constexpr bool disturbs(uint32_t kind) {
  return Patterns::kDisturb[kind];
}
template <class P> constexpr uint32_t kPatternKind = Patterns::number<P>();

} // namespace celltrace::kernel
