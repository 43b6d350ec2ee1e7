// Scene: the description of a picture, which an application builds or the POV-Ray parser returns.
//
// Units are the scene's own; angles are in degrees unless said otherwise; the axes are POV-Ray's
// (left-handed, y up). Colours are linear in the scene's working space (see GammaMode). A Scene is a plain
// value: copyable, without threads of its own; several threads may read one while no thread changes it.
#pragma once

#include "celltrace/export.hpp"
#include "celltrace/texture.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace celltrace {

struct Camera {
  /// POV-Ray's kinds of cameras, each described by its ray through pixel (x, y) of a W x H picture, where u =
  /// (x+.5)/W-.5 goes from -.5 at the left to .5 at the right, and v = .5-(y+.5)/H from -.5 at the bottom to
  /// .5 at the top.
  enum class Kind {
    perspective,      ///< from the location along direction + right*u + up*v
    orthographic,     ///< from location + right*u + up*v along direction
    spherical,        ///< columns are longitudes, angle*u; rows are latitudes, vertical_angle*v
    ultra_wide_angle, ///< as perspective, but with angle*u, and angle*v times the ratio of up's length to
                      ///< right's
    omnimax,          ///< a fisheye of 180 degrees, cut off below; black outside
    panoramic,        ///< along direction*cos(180*u) + right*sin(180*u) + up*tan(180*v)
    cylinder_1,       ///< columns are angles, angle*u; rows are heights, up*v; on a cylinder of radius 1
    cylinder_2,       ///< columns are widths, right*u; rows are angles, angle*v
    cylinder_3,       ///< as cylinder_1, but each row is seen from its height on the cylinder's axis
    cylinder_4,       ///< as cylinder_2, but each column is seen from its place on the cylinder's axis
    fisheye ///< rays at angle/2 from direction where (2*|right|*u, 2*|up|*v) has length 1; black farther out
  };
  Kind kind = Kind::perspective;
  // Values after sky, look_at and transformations have been applied, and for perspective and orthographic
  // cameras also the angle. Only perspective, orthographic and panoramic use the length of direction.
  Vec3 location{0, 0, 0};
  Vec3 direction{0, 0, 1};
  Vec3 right{1.33, 0, 0};
  Vec3 up{0, 1, 0};
  // Width and height of the picture in degrees, not negative, for kinds whose comments name them.
  double angle = 90;
  double vertical_angle = 180;

  /// Ways in which the camera adapts to the ratio of a picture's width to its height.
  enum class Framing {
    fixed, ///< not at all, as in POV-Ray: the view is squeezed into the picture
    width, ///< the view keeps its width, and gets higher or lower
    whole  ///< the view gets wider or higher, and is never cut off
  };
  Framing framing = Framing::fixed;

  /// Returns a perspective camera at `from` with `to` in the middle of its picture, which is `angle` degrees
  /// wide, above 0 and below 180. With `aspect`, above 0, the view is for pictures that are `aspect` times as
  /// wide as high, and is squeezed into pictures of other shapes. Without `aspect`, the view fits pictures of
  /// any shape (Framing::width). The direction `sky` points up in the picture. Throws InputError for numbers
  /// out of range or not finite, if `from` is `to`, and if `sky` is 0 or parallel to the direction from
  /// `from` to `to`.
  CELLTRACE_EXPORT static Camera look_at(const Vec3& from, const Vec3& to, double angle = 67.38,
                                         std::optional<double> aspect = {}, const Vec3& sky = {0, 1, 0});
};

/// The meaning of colour values and their conversion to 8 bits.
enum class GammaMode {
  none,   ///< legacy: pixel values are written unchanged
  srgb,   ///< working space is already encoded: values are written unchanged (`assumed_gamma srgb`)
  assumed ///< working space has exponent Scene::assumed_gamma: sRGB-encoded on output
};

/// The inside of an object. If a ray can be inside of two objects at once, each of them needs an interior of
/// its own. Children of a union that have no interior share the union's interior.
struct Interior {
  double ior = 1;
  /// Fading: light that travels `fade_distance` in the interior is halfway to `fade_colour`. After a distance
  /// d the share 1/(1 + (d/fade_distance)^fade_power) of the difference from `fade_colour` is left, or an
  /// exponential share if the power is 1000 or more. A distance of 0: light does not fade. A power of 0:
  /// shadows do not fade, either.
  double fade_distance = 0;
  double fade_power = 0;
  Vec3 fade_colour{0, 0, 0};
  /// Brightens shadows where light passes straight through; greater values brighten a smaller area.
  double caustics = 0;
  /// Factor for light that passes a surface of the interior, going in or out, or is totally reflected there:
  /// POV-Ray's `refraction` of a finish. Shadow rays ignore it. Values below 0 count as 0.
  double refraction = 1;
  bool hollow = false; ///< true: fog fills the interior, too
};

/// A medium that light passes through on its way between surfaces, except along rays inside an object whose
/// interior is not hollow.
struct Fog {
  Vec3 colour{0, 0, 0};
  double filter = 0;   ///< share of the light through the fog that is tinted by the fog's colour
  double transmit = 0; ///< the share of light that passes the fog at any distance, 0 to 1
  double distance = 0; ///< distance after which 1/e of the light is left; 0: there is no fog
  /// True: the fog lies on the ground and thins out above `offset`. Its density is 1/(1 + y^2) at a height of
  /// y times `altitude` above `offset`. Heights are measured along `up`, which has length 1.
  bool is_ground = false;
  double offset = 0;
  double altitude = 0; ///< unit of the height above `offset`; 0: there is no fog above `offset`
  Vec3 up{0, 1, 0};
  Turbulence turbulence;           ///< thins the fog at random places, if an amount is not 0
  double turbulence_depth = 0.5;   ///< strength of the turbulence
  Vec3 turbulence_origin{0, 0, 0}; ///< origin of the noise in the scene
};

/// A bow of colours, by POV-Ray's formulas. The bow lies in front of the surface that a ray hits, and is
/// stronger the farther away the surface is; it is also seen where rays hit nothing. Rays inside an object
/// whose interior is not hollow do not see the bow. Several rainbows count equally. Fog lies in front of all
/// rainbows.
struct Rainbow {
  struct Colour {
    double position; ///< ascending, 0 at the inner edge of the bow to 1 at the outer one
    Vec3 rgb{0, 0, 0};
    double filter = 0;   ///< share of the light through the bow that is tinted by the colour
    double transmit = 0; ///< share of the light through the bow that passes unchanged
  };
  Vec3 direction{0, 0, 1}; ///< direction of the light, of any length but 0; the bow surrounds it
  double angle = 0;        ///< angle between the direction and the middle of the bow, in degrees
  double width = 0;        ///< width of the bow, in degrees; 0: there is none
  double distance = 0;     ///< distance at which 1/e of a surface's light is left; 0 or less: there is no bow
  double jitter = 0;       ///< random shift of the colours, as a share of the width
  Vec3 up{0, 1, 0};        ///< direction to the middle of the arc; not along `direction`
  double arc_angle = 360;  ///< length of the arc, in degrees
  /// Length of the part of the arc that does not fade toward the ends, in degrees.
  double falloff_angle = 360;
  std::vector<Colour> colours; ///< 1 to 256, blended in between
};

/// Index into Scene::materials or Scene::interiors.
using Index = std::uint32_t;
inline constexpr Index kNoIndex = 0xFFFFFFFFu;

/// The area of a light that casts soft shadows: a grid of points in a parallelogram around the light's
/// location, each of which casts shadows as a point light does. As in POV-Ray, shadow rays to the corners of
/// the grid are traced first, and the grid is divided where the corners differ.
struct LightArea {
  /// Vectors from the first to the last column, and from the first to the last row.
  Vec3 across{1, 0, 0}, along{0, 1, 0};
  int columns = 2, rows = 2; ///< 1 to 256 each
  /// Number of levels, 0 or more, by which the grid is divided even if its corners do not differ.
  int adaptive = 100;
  /// True: points are moved by up to half of the distance between points, in the same way in every frame.
  bool jitter = false;
  bool circular = false; ///< true: the grid is deformed into an ellipse
  /// True: the area turns to face each surface point, both its sides are as long as `across`, and it counts
  /// as circular.
  bool orient = false;
};

struct Object;

/// A light source, by POV-Ray's formulas and with its defaults.
struct Light {
  enum class Kind {
    point,     ///< shines in all directions
    spotlight, ///< shines in a cone
    cylinder   ///< shines in a cylinder that begins at the location, with parallel rays
  };
  Vec3 location{0, 0, 0};
  Vec3 colour{1, 1, 1};
  bool shadowless = false; ///< true: casts no shadows and makes no highlights
  Kind kind = Kind::point;
  /// End of the axis that begins at the location, for all kinds except point. If `point_at` equals
  /// `location`, there is no light.
  Vec3 point_at{0, 0, 1};
  /// Inner and outer edge of the light, for all kinds except point: of spotlights the angles to the axis in
  /// degrees, of cylinders the distances from the axis.
  double radius = 30, falloff = 45;
  double tightness = 0;  ///< exponent by which light decreases off the axis, for all kinds except point
  bool parallel = false; ///< true: all rays are parallel to the axis, also behind the location; a spotlight
                         ///< has no edge then
  /// Distance at which there is as much light as without fading; 0: light does not fade. As in POV-Ray, the
  /// light is multiplied by 2 / (1 + (distance / fade_distance)^fade_power), also at negative distances,
  /// which occur behind parallel lights.
  double fade_distance = 0;
  double fade_power = 0; ///< exponent by which light decreases with distance; 0: light does not fade
  /// The area that casts the light's shadows; none: shadows are those of a point.
  std::optional<LightArea> area = std::nullopt;
  /// Object that the light is projected through (`projected_through`): light shines only through it and
  /// beyond, and objects between it and the light cast no shadows. Its materials and interiors have no
  /// effect. If the object is or contains a CSG, no part of the CSG may be a mesh. Null: light goes
  /// everywhere.
  std::shared_ptr<const Object> projected_through = nullptr;
  bool is_dimmed_by_fog = false; ///< true: fogs weaken the light, unless it is shadowless
  /// True: shines on all objects, except objects whose light group has no global lights.
  bool is_global = true;
};

/// The lights that shine on the objects which refer to the group. All objects cast shadows, whatever group
/// they or the light are in.
struct LightGroup {
  std::vector<Index> lights;  ///< indices into Scene::lights
  bool global_lights = false; ///< true: lights with Light::is_global belong to the group, too
};
inline constexpr int kMostLightGroups = 255;

/// Triangles with shared vertices; vertices, normals and surface coordinates are single precision, as in
/// POV-Ray. For a material that looks different from inside, the outside of a smooth triangle is the side
/// that its normals point to; the outside of a flat triangle with corners a, b and c is the side that -(b -
/// a) x (c - a) points to. If a face has several materials, its look from inside is that of the first
/// material.
struct Mesh {
  struct Triangle {
    Index vertex[3];
    /// Indices into `normals`; kNoIndex, in all three: the triangle is flat.
    Index normal[3] = {kNoIndex, kNoIndex, kNoIndex};
    /// Indices into Scene::materials; kNoIndex: the instance's material. Three different ones are blended
    /// over the face by its barycentric coordinates.
    Index material[3] = {kNoIndex, kNoIndex, kNoIndex};
  };
  std::vector<Vec3f> vertices;
  std::vector<Vec3f> normals;
  std::vector<Triangle> triangles;
  /// Surface coordinates (u, v) at the corners of a triangle; points of the triangle have interpolated
  /// coordinates.
  struct Coordinates {
    Vec2f corner[3] = {{0, 0}, {0, 0}, {0, 0}};
  };
  std::vector<Coordinates> coordinates; ///< by triangle; empty: all are 0
  /// Direction that defines the inside for CSG, in the mesh's space and of any length: a point is in the mesh
  /// if the ray from the point along this direction crosses an odd number of triangles. Zero: no point is in
  /// the mesh, nor in its inverse.
  Vec3 inside_vector{0, 0, 0};

  bool has_inside() const { return inside_vector != Vec3(0); }
};

struct Sphere {
  Vec3 centre{0, 0, 0};
  double radius = 1;
};

/// An infinite plane; the side that the normal points away from is inside.
struct Plane {
  Vec3 normal{0, 1, 0}; ///< of any length
  double distance = 0;  ///< distance from the origin, along the unit normal
};

/// A flat, round disc with a hole. The inside of its plane, for CSG, is the side that the normal points away
/// from.
struct Disc {
  Vec3 centre{0, 0, 0};
  Vec3 normal{0, 1, 0}; ///< of any length
  double radius = 1;
  double hole_radius = 0;
};

/// A box from one corner to the opposite one, with its sides along the axes.
struct Box {
  Vec3 corner[2] = {{-1, -1, -1}, {1, 1, 1}};
};

struct Cylinder {
  Vec3 base{0, 0, 0}, cap{0, 1, 0}; ///< middles of its two ends
  double radius = 1;
  bool open = false; ///< true: without the ends
};

/// A cone, cut off if both radii are greater than 0.
struct Cone {
  Vec3 base{0, 0, 0}, cap{0, 1, 0};
  double base_radius = 1, cap_radius = 0;
  bool open = false; ///< true: without the ends
};

/// A torus around the y axis.
struct Torus {
  double major_radius = 1; ///< distance from the centre to the middle of the tube
  double minor_radius = 0.25;
};

/// The surface dot(square, (xx, yy, zz)) + dot(mixed, (xy, xz, yz)) + dot(linear, (x, y, z)) + constant = 0.
/// Values below 0 are inside.
struct Quadric {
  Vec3 square{1, 1, 1};
  Vec3 mixed{0, 0, 0};
  Vec3 linear{0, 0, 0};
  double constant = -1;
};

/// The surface (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) = 1, with e = `east_west` and n = `north_south`: a
/// sphere if both are 1, more like a box the smaller they are, and with edges that bend inward above 2.
/// Values below 1e-4 count as 1e-4.
struct Superellipsoid {
  double east_west = 1, north_south = 1;
};

/// A flat polygon: loops of points in one plane, each closed from its last point to its first. A point is in
/// the polygon if a half-line from the point crosses an odd number of edges, so that a loop inside another
/// loop is a hole. For CSG no point is inside of a polygon, nor of its inverse.
struct Polygon {
  std::vector<std::vector<Vec3>> loops;
};

/// The surface of points where a polynomial of x, y and z is 0; values below 0 are inside.
struct Polynomial {
  int degree = 2; ///< 2 to 35
  /// One coefficient of each x^i y^j z^k with i + j + k <= degree: i falls from `degree` to 0, for each i
  /// the power j falls, and for each j the power k, so that the constant is last.
  std::vector<double> coefficients;

  /// Returns how many coefficients a polynomial of this degree has.
  static std::size_t count(int degree) {
    const auto n = static_cast<std::size_t>(degree);
    return (n + 1) * (n + 2) * (n + 3) / 6;
  }
};

/// A piece of a curve in a plane, for w from 0 to 1: its points are (x[0] + x[1] w + x[2] w^2 + x[3] w^3, the
/// same of y).
struct CurveSegment {
  std::array<double, 4> x{}, y{};
};

/// A solid with the same cross-section at all heights, which lies between y = `bottom` and y = `top`.
struct Prism {
  /// Closed loops of segments in x and z, each of which begins where the one before it ends. A point is in
  /// the cross-section if a half-line from the point crosses the segments an odd number of times.
  std::vector<CurveSegment> outline;
  double bottom = 0, top = 1;
  /// True: the cross-section at height y is `outline` scaled by y, so that the solid comes to a point at the
  /// origin.
  bool is_conic = false;
  bool open = false; ///< true: without the ends
};

/// The surface that a curve in x and y leaves behind when it turns around the y axis.
struct Lathe {
  std::vector<CurveSegment> curve; ///< x is the distance from the axis
};

/// A solid around the y axis whose squared radius is a polynomial of the height, piece by piece.
struct SurfaceOfRevolution {
  struct Piece {
    double low = 0, high = 1; ///< heights of its ends; each piece begins where the one below it ends
    std::array<double, 4> square{}; ///< squared radius at height y: square[0] + square[1] y + ...
  };
  std::vector<Piece> pieces;
  bool open = false; ///< true: without the discs at its ends
};

/// The surface around points and lines where their fields add up to `threshold`; greater sums are inside.
struct Blob {
  /// At distance d from the point, or from the line from `a` to `b`, the field is strength * (1 -
  /// d^2/radius^2)^2, and 0 beyond the radius.
  struct Component {
    Vec3 a{0, 0, 0}, b{0, 0, 0}; ///< equal for a point
    double radius = 1;
    double strength = 1;
    Transform transform; ///< of the field, in the blob
  };
  double threshold = 1;
  std::vector<Component> components;
};

struct Csg;

/// One thing to hit: a shape and its place. Plain unions are already taken apart.
struct Object {
  std::variant<Sphere, std::shared_ptr<const Mesh>, Plane, Disc, Box, Cylinder, Cone, Torus, Quadric,
               Superellipsoid, std::shared_ptr<const Polygon>, std::shared_ptr<const Polynomial>,
               std::shared_ptr<const Prism>, std::shared_ptr<const Lathe>,
               std::shared_ptr<const SurfaceOfRevolution>, std::shared_ptr<const Blob>, std::shared_ptr<const Csg>>
      shape;
  Transform transform;
  Index material = 0; ///< index into Scene::materials; no effect for a CSG, whose parts have their own
  /// Index into Scene::interiors; no effect for a CSG. kNoIndex: the object has an interior of its own with
  /// the defaults of Interior.
  Index interior = kNoIndex;
  // Visibility flags. As in POV-Ray, a CSG also has flags of its parts: a top-level union has all three; a
  // union that is clipped or nested in another operation only no_reflection; a merge no_image and
  // no_reflection; other CSG none. If rays of one kind do not see a part of a merge, this part hides nothing
  // of the other parts from these rays.
  bool no_shadow = false;
  bool no_image = false;      ///< true: not seen by camera rays, only in mirrors
  bool no_reflection = false; ///< true: seen in no mirror
  /// True: the object is neither seen nor in the way of light, and no point is inside of it. Hiding and
  /// showing an object between frames is cheap. Ignored for parts of a CSG, for clipping objects, and for
  /// objects that lights are projected through.
  bool is_hidden = false;
  bool inverse = false; ///< true: inside and outside are swapped
  /// True: light that falls on the back of a surface lights its front, too: POV-Ray's double_illuminate. No
  /// effect for a CSG.
  bool is_lit_through = false;
  /// Index into Scene::light_groups: the lights that shine on the object. kNoIndex: all global lights. No
  /// effect for a CSG.
  Index light_group = kNoIndex;
  /// Objects that clip this object: only the part of this object inside all of them exists. Clipping objects
  /// are transformed with this object; their materials have no effect. Null: the whole object exists.
  std::shared_ptr<const std::vector<Object>> clipped_by = nullptr;
};

/// Constructive solid geometry, as in POV-Ray: the operation decides which pieces of its parts' surfaces are
/// there. Each piece has the material of the part that it belongs to.
struct Csg {
  enum class Operation {
    union_,       ///< all pieces
    merge,        ///< pieces that are in no other part
    intersection, ///< pieces that are in all other parts
    difference    ///< the first part without the others
  };
  Operation operation = Operation::union_;
  std::vector<Object> parts; ///< parts in the space of the CSG
};

struct CELLTRACE_EXPORT Scene {
  std::string name; ///< file that the scene was read from, for messages
  Camera camera;
  Vec3 background{0, 0, 0};
  /// Share, 0 to 1, of the light behind the picture that comes through the background; for pictures with
  /// alpha. No effect below version 3.7, where only mirrors see sky and background.
  double background_transparency = 1;
  /// Background that reflected rays see, also inside glass, if the picture has alpha and the scene no sky;
  /// none: reflected rays see `background`. If there is a mirrored background, `background` is the share of
  /// it that is left behind the picture.
  std::optional<Vec3> mirrored_background;
  /// Layers of the sky over the background, the last layer on top, which rays see if they hit nothing.
  /// Patterns of the sky are evaluated at the ray's direction, of length 1.
  std::vector<Pigment> sky_sphere;
  Vec3 ambient_light{1, 1, 1};
  std::vector<Fog> fogs;
  std::vector<Rainbow> rainbows;
  std::vector<Light> lights;
  std::vector<LightGroup> light_groups; ///< at most kMostLightGroups
  std::vector<Material> materials;      ///< objects refer to these by index
  /// Interiors, one per object or union: interiors with equal values but different indices are different.
  std::vector<Interior> interiors;
  std::vector<Object> objects;

  GammaMode gamma_mode = GammaMode::assumed;
  double assumed_gamma = 1;
  /// Effective language version (3.62 for a scene without #version). Below 3.7 the opacity of a surface is
  /// 1 - (filter*max(r,g,b) + transmit), from 3.7 on 1 - filter - transmit.
  double version = 3.7;
  int max_trace_level = 5;
  double adc_bailout = 1.0 / 255;
  Vec3 irid_wavelength{0.7, 0.52, 0.48}; ///< wavelengths of red, green and blue in thin films
  int noise_generator = 2;  ///< noise generator of patterns that name none: 1 to 3, POV-Ray's numbers
  int number_of_waves = 10; ///< number of waves in the patterns ripples and waves

  /// Append `material` or `interior` and return its index.
  Index add(const Material& material);
  Index add(const Interior& interior);
};

/// Throws InputError if a number is not finite, or an angle negative.
CELLTRACE_EXPORT void validate(const Camera& camera);
/// Throws InputError, naming the first fault, if an index is out of range, a number is not finite, or there
/// are more triangles or vertices than 32-bit offsets can address, or a light's area has no places.
CELLTRACE_EXPORT void validate(const Scene& scene);

} // namespace celltrace
