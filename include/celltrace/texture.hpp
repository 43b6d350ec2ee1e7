// Textures: what surfaces look like. A pattern is a number at every point of space; maps make colours,
// normals and whole textures of it. All formulas and defaults are POV-Ray's. Values of these types are plain:
// copyable, and what they share is never changed.
#pragma once

#include "celltrace/transform.hpp"

#include <memory>
#include <variant>
#include <vector>

namespace celltrace {

struct Object;
struct Pigment;

/// Displaces points by noise: `amount` times a sum of `octaves` octaves, each of them `lambda` times finer
/// and `omega` times weaker than the one before.
struct Turbulence {
  Vec3 amount{0, 0, 0};
  int octaves = 6; ///< 1 to 10
  double omega = 0.5;
  double lambda = 2;
};

/// The kinds of patterns. Numbers are those at
/// a point p = (x, y, z) of the pattern's own space; most are in 0..1.
namespace pattern {

// Lists: the number is the index of the entry that is there.
struct Checker {};    ///< unit cubes by turns: 2 entries
struct Square {};     ///< unit squares of the xz plane: 4
struct Hexagon {};    ///< hexagons with sides of length 1 in the xz plane: 3
struct Triangular {}; ///< triangles in the xz plane: 6
struct Cubic {};      ///< by the side of a cube that the point is seen through from the origin: 6
/// Mortar and brick: 2.
struct Brick {
  Vec3 size{8, 3, 4.5};
  double mortar = 0.5;
};

// Blends without noise.
struct Gradient {
  Vec3 direction{1, 0, 0}; ///< of any length but 0; the pattern repeats after one unit along it
};
struct Boxed {};       ///< from 1 at the origin to 0 at the sides of the cube from -1 to 1
struct Spherical {};   ///< likewise of the unit sphere
struct Cylindrical {}; ///< likewise of the unit cylinder around the y axis
struct Planar {};      ///< likewise of the planes y = -1 and y = 1
struct Leopard {};     ///< spots in all directions
struct Onion {};       ///< shells one unit apart
struct Radial {};      ///< once around the y axis
/// Arms around the z axis; with `is_crossed`, and as many the other way.
struct Spiral {
  int arms = 1;
  bool is_crossed = false;
};
/// Pillows: cubes whose surfaces bulge as the two numbers say.
struct Quilted {
  double control[2] = {1, 1};
};

// Blends of noise.
struct Bozo {};     ///< smooth noise
struct Bumps {};    ///< the same; as a normal, noise in each coordinate
struct Dents {};    ///< its cube
struct Granite {};  ///< six octaves with creases
struct Wrinkles {}; ///< ten octaves
struct Agate {
  double turbulence = 1; ///< by which its bands are bent
};
struct Marble {};  ///< along x, with the pattern's turbulence
struct Wood {};    ///< rings around the z axis, with the pattern's turbulence
struct Ripples {}; ///< waves from points around the origin, which run into each other
struct Waves {};   ///< likewise, of different lengths
struct Cells {};   ///< unit cubes of a random number each
/// Distances to the nearest of random points, of which there is one in each unit cube.
struct Crackle {
  double form[3] = {-1, 1, 0}; ///< factors of the three shortest distances
  double metric = 2;           ///< 1: the sum of the coordinates' differences; 2: as the crow flies; ...
  double offset = 0;
  bool is_solid = false; ///< one number for each of the points
};
/// How long a point of the xy plane takes to leave when it is iterated: the Mandelbrot set, and what is like
/// it. POV-Ray's numbers of what is counted outside and inside of the set.
struct Fractal {
  bool is_julia = false; ///< of `c`; otherwise each point is its own c
  double c[2] = {0, 0};
  int iterations = 1; ///< 0 to 65535
  int exponent = 2;   ///< 2 to 33, of z^n + c
  int magnet = 0;     ///< 1 or 2: formulas of magnetism, without exponent
  int exterior = 1;   ///< 0 to 8
  double exterior_factor = 1;
  int interior = 0; ///< 0 to 8
  double interior_factor = 1;
};
/// How much the surface faces a direction, 0 away from it to 1 toward it, by the angle; with an altitude, the
/// mean with how far a point is along that. Each counts by the length of its vector.
struct Slope {
  Vec3 direction{0, 1, 0};    ///< in the scene, wherever the pattern is moved; 0 if only the altitude counts
  double least = 0, most = 1; ///< of what the surface faces: here the number is 0 and 1
  Vec3 altitude{0, 0, 0};
  double lowest = 0, highest = 1; ///< along the altitude: likewise
};
/// How bright a pigment is: 0.297 of its red, 0.589 of its green and 0.114 of its blue. It is in the space of
/// this pattern, as if it were in its map; so it counts as one level of nested maps.
struct Grey {
  std::shared_ptr<const Pigment> of;
};
/// A list of 2: what is outside of an object, and what is inside. The object is in the pattern's space; it
/// has no meshes. Its materials and the like mean nothing.
struct Inside {
  std::shared_ptr<const Object> of;
};
/// Only as a normal: the same direction all over each cell of crackle's points.
struct Facets {
  double coords = 0; ///< how far that may be from the surface's own; instead of the normal's amount
  /// Instead of that, how large facets of a unit sphere are: they are as the surface's normal is, wherever
  /// it is. Less than 0: it is smooth.
  double size = 0;
  double metric = 2; ///< as crackle's
};

using Kind =
    std::variant<Checker, Square, Hexagon, Triangular, Cubic, Brick, Gradient, Boxed, Spherical, Cylindrical,
                 Planar, Leopard, Onion, Radial, Spiral, Quilted, Bozo, Bumps, Dents, Granite, Wrinkles,
                 Agate, Marble, Wood, Ripples, Waves, Cells, Crackle, Fractal, Slope, Grey, Inside, Facets>;

} // namespace pattern

/// How else space is bent.
namespace warp {

/// The slice of space from 0 to `width` along an axis, again and again.
struct Repeat {
  int axis = 0;         ///< 0 to 2
  double width = 1;     ///< not 0
  Vec3 flip{0, 0, 0};   ///< every other slice is mirrored along axes of which this is not 0
  Vec3 offset{0, 0, 0}; ///< of each slice from the one before
};
/// Draws points in a sphere to its centre.
struct BlackHole {
  Vec3 centre{0, 0, 0};
  double radius = 1;
  double strength = 1;
  double falloff = 2;
  bool is_inverse = false;  ///< pushes them away
  Vec3 repeat{0, 0, 0};     ///< distances of its copies, 0 along axes without
  Vec3 turbulence{0, 0, 0}; ///< of the copies
};
/// Wraps the unit square of the xy plane around a shape; z is the distance.
struct Mapping {
  enum class Shape { planar, cylindrical, spherical, toroidal };
  Shape shape = Shape::planar;
  Vec3 orientation{0, 0, 1};
  double distance = 0;          ///< of planar: what z is
  double distance_exponent = 0; ///< of the others: the square grows with the distance to this power
  double major_radius = 1;      ///< of toroidal
};

} // namespace warp

/// What is done to space before the pattern is asked.
using SpaceStep = std::variant<Transform, Turbulence, warp::Repeat, warp::BlackHole, warp::Mapping>;

struct Pattern {
  enum class Wave { ramp, triangle, sine, scallop, cubic, poly };

  pattern::Kind kind = pattern::Gradient{};
  /// As written from the pattern outward: to a point in the scene the last one is done first.
  std::vector<SpaceStep> space = {};
  Turbulence turbulence = {}; ///< of points in the pattern's own space, after all steps
  Wave wave = Wave::ramp;
  double wave_exponent = 1; ///< of Wave::poly
  double frequency = 1;     ///< 0: the number as it is, without phase, in its wave
  double phase = 0;
  int noise_generator = 0; ///< 1 to 3 as POV-Ray counts them; 0: the scene's
  /// Its space is that of (u, v, 0), the surface's coordinates, wherever in the scene the surface is and
  /// whatever maps are around. They are 0 to 1 around a sphere, from pole to pole; over an unfolded box;
  /// around a torus, and its tube; a Mesh says its own; of all other shapes they are x and y of the point in
  /// the scene.
  bool uv_mapping = false;
  /// With uv_mapping: what normals go through from there to the scene. Points do not.
  Transform normal_space = {};
};

/// What a pattern's numbers stand for. Between two entries values are blended, before the first and after the
/// last they are theirs; lists take the entry of the number. No more than 256 entries, at least one; nested
/// no deeper than kDeepestMap.
///
/// Patterns inside an entry are in the space of the map's pattern: they are asked at the point that this one
/// is asked at, after its steps and its turbulence (marble and wood use theirs inside, it moves no points).
/// So is everything inside an average.
template <class T> struct PatternMap {
  struct Entry {
    double position; ///< ascending; of lists it means nothing; of an average, the entry's weight
    T value;
  };
  Pattern pattern;
  std::vector<Entry> entries;
  bool is_average = false; ///< all entries by their weights; of the pattern only steps and turbulence count
};
inline constexpr int kDeepestMap = 8;
inline constexpr int kMostMapEntries = 256;

/// Colour with POV-Ray's two transparency channels; neither is limited to 0..1.
struct Pigment {
  Vec3 rgb{0, 0, 0};
  double filter = 0;
  double transmit = 0;
  std::shared_ptr<const PatternMap<Pigment>> map = nullptr; ///< instead of the above

  /// Maps are equal if they are the same object.
  bool operator==(const Pigment&) const = default;
};

/// A point of a curve over a pattern's numbers.
struct SlopePoint {
  double position; ///< ascending, as those of maps
  double height;
  double slope; ///< of the curve, from one point to the next
};

/// Disturbs the direction of a surface, as if it were not smooth.
struct Normal {
  Pattern pattern = {pattern::Bumps{}};
  double amount = 0.5;    ///< how deep
  double accuracy = 0.02; ///< distance of the points that slopes are taken of, in the pattern's space
  /// Heights instead of the pattern's numbers; no more than 256. Empty: the numbers. Patterns that disturb by
  /// another rule than their slope ignore it: bumps, dents, wrinkles, quilted, ripples, waves, facets.
  std::vector<SlopePoint> slopes = {};
  std::shared_ptr<const PatternMap<Normal>> map = nullptr; ///< instead of the above
};

/// POV-Ray's finish with POV-Ray's defaults.
struct Finish {
  Vec3 ambient{0.1, 0.1, 0.1};
  Vec3 emission{0, 0, 0};
  double diffuse = 0.6;
  double diffuse_behind = 0; ///< of light that falls on the other side, which makes no highlights
  double brilliance = 1;
  double phong = 0;
  double phong_size = 40;
  double specular = 0;
  double roughness = 0.05;
  double metallic = 0; ///< of the highlights
  Vec3 reflection_min{0, 0, 0};
  Vec3 reflection_max{0, 0, 0};
  double reflection_falloff = 1;
  double reflection_exponent = 1;
  double reflection_metallic = 0;
  bool reflection_fresnel = false;
  bool conserve_energy = false;
  double crand = 0; ///< diffuse light is less by up to so much, at random
  double irid = 0;  ///< a film on the surface makes light stronger or weaker by up to this share of it,
  double irid_thickness = 0;  ///< of this thickness,
  double irid_turbulence = 0; ///< which noise changes

  bool operator==(const Finish&) const = default;
};

/// A texture, in the space of the scene: patterns do not move with the objects that have it.
struct Material {
  Pigment pigment;
  Finish finish;
  std::shared_ptr<const Normal> normal = nullptr;  ///< null: the surface is smooth
  std::shared_ptr<const Material> below = nullptr; ///< the layer that shines through this one
  std::shared_ptr<const PatternMap<Material>> map =
      nullptr; ///< instead of all of the above; no entry is a layer over others' map
  /// Of an object's material: what it looks like from inside, itself without one. Null: the same.
  std::shared_ptr<const Material> inside = nullptr;

  /// Normals, maps and other materials are equal if they are the same object.
  bool operator==(const Material&) const = default;
};
inline constexpr int kMostLayers = 64;

} // namespace celltrace
