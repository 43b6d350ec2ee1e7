// Textures: the looks of surfaces. A pattern is a number at every point of space; maps turn it into colours,
// normals and whole textures. All formulas and defaults are POV-Ray's. These types are plain values; data
// that copies share is immutable.
#pragma once

#include "celltrace/transform.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

namespace celltrace {

struct Object;
struct Pigment;
class FunctionCode;

/// A picture that patterns read, in the scene's working space.
struct Picture {
  int width = 0, height = 0; ///< 1 to 65535 each
  /// Red, green, blue and transmittance of each pixel, row by row from the top. 65535 is `scale`, or 1 for
  /// the transmittance.
  std::vector<std::array<std::uint16_t, 4>> texels;
  double scale = 1;
};

/// A displacement of points by noise: `amount` times a sum of `octaves` octaves, each octave `lambda` times
/// finer, and with `omega` times the strength, of the octave before.
struct Turbulence {
  Vec3 amount{0, 0, 0};
  int octaves = 6; ///< 1 to 10
  double omega = 0.5;
  double lambda = 2;
};

/// The kinds of patterns. A pattern gives a number at each point p = (x, y, z) of its own space, for most
/// kinds in 0..1.
namespace pattern {

// Lists: patterns whose number is the index of an entry of the map.
struct Checker {};    ///< unit cubes in alternation: 2 entries
struct Square {};     ///< unit squares of the xz plane: 4 entries
struct Hexagon {};    ///< hexagons with sides of length 1 in the xz plane: 3 entries
struct Triangular {}; ///< triangles in the xz plane: 6 entries
struct Cubic {};      ///< six pyramids around the origin, one through each side of a cube: 6 entries
/// Mortar and brick: 2 entries.
struct Brick {
  Vec3 size{8, 3, 4.5};
  double mortar = 0.5;
};

// Patterns of continuous numbers, without noise.
struct Gradient {
  Vec3 direction{1, 0, 0}; ///< of any length but 0; the pattern repeats after one unit along it
};
struct Boxed {};       ///< from 1 at the origin to 0 at the sides of the cube from -1 to 1
struct Spherical {};   ///< from 1 at the origin to 0 at the unit sphere
struct Cylindrical {}; ///< from 1 on the y axis to 0 at the unit cylinder around it
struct Planar {};      ///< from 1 at y = 0 to 0 at the planes y = -1 and y = 1
struct Leopard {};     ///< spots in all directions
struct Onion {};       ///< shells one unit apart
struct Radial {};      ///< from 0 to 1 once around the y axis
/// Arms that spiral around the z axis; if `is_crossed`, crossed by equally many arms in the other direction.
struct Spiral {
  int arms = 1;
  bool is_crossed = false;
};
/// Cubes whose surfaces bulge like pillows; the two controls say how much.
struct Quilted {
  double control[2] = {1, 1};
};

// Patterns of continuous numbers, made of noise.
struct Bozo {};     ///< smooth noise
struct Bumps {};    ///< smooth noise; as a normal, noise in each coordinate
struct Dents {};    ///< the cube of smooth noise
struct Granite {};  ///< six octaves with creases
struct Wrinkles {}; ///< ten octaves
struct Agate {
  double turbulence = 1; ///< strength of the turbulence that bends the bands
};
struct Marble {};  ///< bands along x, with the pattern's turbulence
struct Wood {};    ///< rings around the z axis, with the pattern's turbulence
struct Ripples {}; ///< overlapping waves from random points around the origin
struct Waves {};   ///< as ripples, with waves of different lengths
struct Cells {};   ///< a random number in each unit cube
/// Distances to the nearest of random points, one in each unit cube.
struct Crackle {
  double form[3] = {-1, 1, 0}; ///< factors of the three shortest distances
  double metric = 2; ///< exponent of the distance: 1 adds the coordinates' differences, 2 is Euclidean
  double offset = 0;
  bool is_solid = false; ///< true: one number in the whole cell of each point
};
/// The number of iterations after which a point of the xy plane escapes: the Mandelbrot set and similar
/// fractals. `exterior` and `interior` are POV-Ray's types of the numbers outside and inside of the set.
struct Fractal {
  bool is_julia = false; ///< true: c is the same everywhere; false: each point is its own c
  double c[2] = {0, 0};
  int iterations = 1; ///< 0 to 65535
  int exponent = 2;   ///< n in z^n + c, 2 to 33
  int magnet = 0;     ///< 1 or 2: formulas of magnetism, without exponent
  int exterior = 1;   ///< 0 to 8
  double exterior_factor = 1;
  int interior = 0; ///< 0 to 8
  double interior_factor = 1;
};
/// The angle between a surface's normal and a direction, as a number from 0 if the surface faces away to 1 if
/// it faces along the direction. With an altitude, the mean of this number and of the point's position along
/// the altitude, weighted by the lengths of both vectors.
struct Slope {
  /// Direction in the scene's space, whatever the pattern's transformations; 0 if only the altitude counts.
  Vec3 direction{0, 1, 0};
  double least = 0, most = 1; ///< slopes at which the number is 0 and 1
  Vec3 altitude{0, 0, 0};
  double lowest = 0, highest = 1; ///< positions along the altitude at which the number is 0 and 1
};
/// The brightness of a pigment: 0.297 of its red, 0.589 of its green and 0.114 of its blue. The pigment is in
/// the space of this pattern, as an entry of its map would be, and counts as one level of nested maps.
struct Grey {
  std::shared_ptr<const Pigment> of;
};
/// A list of 2 entries: outside and inside of an object. The object is in the pattern's space, and has no
/// meshes. Its materials, interior and flags have no effect.
struct Inside {
  std::shared_ptr<const Object> of;
};
/// One direction of the normal in each cell of crackle; for normals only.
struct Facets {
  double coords = 0; ///< largest deviation from the surface's normal; replaces Normal::amount
  /// Size of facets of a unit sphere, in place of `coords`: facets then depend on the surface's normal alone,
  /// not on the point. Below 0: the surface is smooth.
  double size = 0;
  double metric = 2; ///< as Crackle::metric
};

/// How a picture is spread over space, by POV-Ray's numbers.
struct PictureMap {
  std::shared_ptr<const Picture> picture; ///< never null
  /// 0: flat, from 0 to 1 in x and y; 1: around a sphere; 2: around a cylinder about y of height 1; 5: around
  /// a torus about y of radius 1.
  int mapping = 0;
  int interpolation = 0; ///< 0: none, 2: bilinear, 3: bicubic, 4: by the distance from four pixels
  bool once = false;     ///< true: there is one copy; false: the copies fill space
  double repeat[2] = {1, 1}; ///< copies per unit
  double offset[2] = {0, 0}; ///< of the picture, in its widths and heights
  double filter = 0, transmit = 0; ///< added to all pixels
};
/// Colours of a picture, clear off its one copy: for pigments. The map needs one entry, of which only one thing
/// counts: whether it lets light through, as it has to if a pixel does or if there is one copy.
struct ImageMap {
  PictureMap map;
};
/// Grey of a picture, or its transmittance; 0 off its one copy.
struct ImageGrey {
  PictureMap map;
  bool is_transmittance = false;
};

/// A function of the scene language; only the parser makes them.
struct Function {
  std::shared_ptr<const FunctionCode> code; ///< of x, y and z; never null
};

using Kind =
    std::variant<Checker, Square, Hexagon, Triangular, Cubic, Brick, Gradient, Boxed, Spherical, Cylindrical,
                 Planar, Leopard, Onion, Radial, Spiral, Quilted, Bozo, Bumps, Dents, Granite, Wrinkles,
                 Agate, Marble, Wood, Ripples, Waves, Cells, Crackle, Fractal, Slope, Grey, Inside, Facets, ImageMap, ImageGrey,
                 Function>;

} // namespace pattern

/// Warps: transformations of space other than affine ones and turbulence.
namespace warp {

/// Repeats the slice of space from 0 to `width` along an axis.
struct Repeat {
  int axis = 0;         ///< axis along which slices repeat, 0 to 2
  double width = 1;     ///< width of a slice, not 0
  Vec3 flip{0, 0, 0};   ///< axes with a value other than 0 are mirrored in every other slice
  Vec3 offset{0, 0, 0}; ///< shift of each slice against the slice before
};
/// Draws the points in a sphere toward its centre.
struct BlackHole {
  Vec3 centre{0, 0, 0};
  double radius = 1;
  double strength = 1;
  double falloff = 2;
  bool is_inverse = false;  ///< true: pushes the points away
  Vec3 repeat{0, 0, 0};     ///< distances between copies, 0 along axes without copies
  Vec3 turbulence{0, 0, 0}; ///< displacement of the copies
};
/// Wraps the unit square of the xy plane around a shape; z is the distance.
struct Mapping {
  enum class Shape { planar, cylindrical, spherical, toroidal };
  Shape shape = Shape::planar;
  Vec3 orientation{0, 0, 1};
  double distance = 0; ///< value of z, for planar
  /// Exponent for the other shapes: the square grows with the distance to this power.
  double distance_exponent = 0;
  double major_radius = 1; ///< major radius of the torus
};

} // namespace warp

/// A step that transforms space before the pattern is evaluated.
using SpaceStep = std::variant<Transform, Turbulence, warp::Repeat, warp::BlackHole, warp::Mapping>;

struct Pattern {
  enum class Wave { ramp, triangle, sine, scallop, cubic, poly };

  pattern::Kind kind = pattern::Gradient{};
  /// Steps in their order in a scene's text: the last step is applied first to a point of the scene.
  std::vector<SpaceStep> space = {};
  Turbulence turbulence = {}; ///< displaces points in the pattern's own space, after all steps
  Wave wave = Wave::ramp;
  double wave_exponent = 1; ///< exponent of Wave::poly
  /// Factor of the number before the wave; 0: the wave gets the number unchanged, without phase.
  double frequency = 1;
  double phase = 0;
  int noise_generator = 0; ///< 1 to 3, POV-Ray's numbers; 0: the scene's
  /// True: the pattern's space is (u, v, 0), the surface's coordinates, wherever in the scene the surface is
  /// and whatever maps are around the pattern. The coordinates are 0 to 1 around a sphere and from pole to
  /// pole; over an unfolded box; around a torus and its tube; a Mesh has coordinates of its own; for all
  /// other shapes the coordinates are x and y of the point in the scene.
  bool uv_mapping = false;
  /// With uv_mapping: transformation of normals, not of points, from the pattern's space to the scene.
  Transform normal_space = {};
};

/// The map from a pattern's numbers to values. A number between the positions of two entries stands for a
/// blend of their values; numbers before the first or after the last entry stand for that entry's value. In
/// lists, a number stands for the entry with this index. 1 to kMostMapEntries entries; maps are nested no
/// deeper than kDeepestMap.
///
/// Patterns inside an entry, also of an average, are in the space of the map's pattern. They are evaluated at
/// the point to which the steps and the turbulence of the map's pattern move a point (but the turbulence of
/// marble and wood moves no points).
template <class T> struct PatternMap {
  struct Entry {
    double position; ///< ascending; in an average, the entry's weight; ignored in lists
    T value;
  };
  Pattern pattern;
  std::vector<Entry> entries;
  /// True: the map is the mean of all entries by their weights; of the pattern only `space` and `turbulence`
  /// count.
  bool is_average = false;
};
inline constexpr int kDeepestMap = 8;
inline constexpr int kMostMapEntries = 256;

/// A colour with POV-Ray's two transparency channels; neither is limited to 0..1.
struct Pigment {
  Vec3 rgb{0, 0, 0};
  double filter = 0;
  double transmit = 0;
  std::shared_ptr<const PatternMap<Pigment>> map = nullptr; ///< replaces the members above

  /// True if all members are equal; maps are equal if they are the same object.
  bool operator==(const Pigment&) const = default;
};

/// A point of a curve that turns a pattern's numbers into heights.
struct SlopePoint {
  double position; ///< ascending
  double height;
  double slope; ///< slope of the curve at this point
};

/// A disturbance of the surface's normal, which makes the surface look rough.
struct Normal {
  Pattern pattern = {pattern::Bumps{}};
  double amount = 0.5; ///< depth of the bumps
  /// Distance between the points that slopes are computed from, in the pattern's space.
  double accuracy = 0.02;
  /// Curve that turns the pattern's numbers into heights, at most 256 points; empty: the numbers are the
  /// heights. Ignored by patterns that disturb normals in ways of their own: bumps, dents, wrinkles, quilted,
  /// ripples, waves, facets.
  std::vector<SlopePoint> slopes = {};
  std::shared_ptr<const PatternMap<Normal>> map = nullptr; ///< replaces the members above
};

/// POV-Ray's finish with POV-Ray's defaults.
struct Finish {
  Vec3 ambient{0.1, 0.1, 0.1};
  Vec3 emission{0, 0, 0};
  double diffuse = 0.6;
  /// Like `diffuse`, for light that falls on the back of the surface. Such light makes no highlights.
  double diffuse_behind = 0;
  double brilliance = 1;
  double phong = 0;
  double phong_size = 40;
  double specular = 0;
  double roughness = 0.05;
  double metallic = 0; ///< share of the pigment's colour in the highlights
  Vec3 reflection_min{0, 0, 0};
  Vec3 reflection_max{0, 0, 0};
  double reflection_falloff = 1;
  double reflection_exponent = 1;
  double reflection_metallic = 0;
  bool reflection_fresnel = false;
  bool conserve_energy = false;
  double crand = 0;           ///< largest random loss of diffuse light
  double irid = 0;            ///< a thin film makes light stronger or weaker by up to this share
  double irid_thickness = 0;  ///< thickness of the film
  double irid_turbulence = 0; ///< strength of the noise in the thickness

  bool operator==(const Finish&) const = default;
};

/// A texture, in the space of the scene: patterns do not move with the objects that use it.
struct Material {
  Pigment pigment;
  Finish finish;
  std::shared_ptr<const Normal> normal = nullptr; ///< null: the surface is smooth
  /// Layer that shines through this one, without a `map`.
  std::shared_ptr<const Material> below = nullptr;
  std::shared_ptr<const PatternMap<Material>> map = nullptr; ///< replaces all members above
  /// Look of an object's material from inside; has no `inside` itself. Null: the same as from outside.
  std::shared_ptr<const Material> inside = nullptr;

  /// True if all members are equal; normals, maps and other materials are equal if they are the same object.
  bool operator==(const Material&) const = default;
};
inline constexpr int kMostLayers = 64;

} // namespace celltrace
