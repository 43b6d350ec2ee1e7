// Scene: what to render, as people build it or as the POV-Ray parser delivers it.
//
// Units are the scene's own; angles are in degrees unless said otherwise; the axes are POV-Ray's
// (left-handed, y up). Colours are linear in the scene's working space (see GammaMode). A Scene is a plain
// value: copyable, without threads of its own; reading one from several threads is safe while nobody changes
// it.
#pragma once

#include "celltrace/export.hpp"
#include "celltrace/texture.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace celltrace {

struct Camera {
  /// POV-Ray's kinds, by the ray through pixel (x, y) of a W x H picture: with u = (x+.5)/W-.5 from -.5 at
  /// the left to .5 at the right, and v = .5-(y+.5)/H from -.5 at the bottom to .5 at the top.
  enum class Kind {
    perspective,      ///< from the location along direction + right*u + up*v
    orthographic,     ///< from location + right*u + up*v along direction
    spherical,        ///< columns are longitudes, angle*u; rows are latitudes, vertical_angle*v
    ultra_wide_angle, ///< as perspective, but with angle*u, and angle*v times the ratio of up's length to
                      ///< right's
    omnimax,          ///< a fisheye of 180 degrees cut off below; outside it is black
    panoramic,        ///< along direction*cos(180*u) + right*sin(180*u) + up*tan(180*v)
    cylinder_1,       ///< columns are angles, angle*u; rows are heights, up*v; on a cylinder of radius 1
    cylinder_2,       ///< columns are widths, right*u; rows are angles, angle*v
    cylinder_3,       ///< as 1, but each row is seen from its height on the cylinder's axis
    cylinder_4,       ///< as 2, but each column is seen from its place there
    fisheye ///< angle/2 off direction at a length of 1 of 2*|right|*u, 2*|up|*v; farther out it is black
  };
  Kind kind = Kind::perspective;
  // The finished camera, after sky, look_at and transformations, and for perspective and orthographic cameras
  // after the angle, too. Only these and panoramic ones look at the length of direction.
  Vec3 location{0, 0, 0};
  Vec3 direction{0, 0, 1};
  Vec3 right{1.33, 0, 0};
  Vec3 up{0, 1, 0};
  double angle = 90;           ///< that a picture is wide, in degrees, not negative; of kinds that mention it
  double vertical_angle = 180; ///< that it is high, likewise

  /// How the camera adapts to the ratio of a picture's width to its height.
  enum class Framing {
    fixed, ///< not at all, as in POV-Ray: what it sees is squeezed into the picture
    width, ///< what it sees is as wide as before, and higher or lower
    whole  ///< what it sees is wider or higher, and never less
  };
  Framing framing = Framing::fixed;

  /// A perspective camera at `from` with `to` in the middle of its picture, which is `angle` degrees wide,
  /// above 0 and below 180. With `aspect`, above 0, it is for pictures that are `aspect` times as wide as
  /// high, and others are squeezed; without, for pictures of any shape (Framing::width). What lies along
  /// `sky` is up. Throws InputError for numbers out of range or not finite, where `from` is `to`, and where
  /// `sky` is 0 or along the way from one to the other.
  CELLTRACE_EXPORT static Camera look_at(const Vec3& from, const Vec3& to, double angle = 67.38,
                                         std::optional<double> aspect = {}, const Vec3& sky = {0, 1, 0});
};

/// What colour values mean and how they become 8 bits.
enum class GammaMode {
  none,   ///< legacy: pixel values are written as they are
  srgb,   ///< working space is already encoded: written as they are (`assumed_gamma srgb`)
  assumed ///< working space has exponent Scene::assumed_gamma: sRGB-encoded on output
};

/// The inside of an object. Objects that a ray can be inside of at the same time have one each; the children
/// of a union share the union's if they have none.
struct Interior {
  double ior = 1;
  /// Light that leaves it after `fade_distance` is halfway to `fade_colour`: of the rest 1/(1 +
  /// (d/distance)^power) is left, or with a power from 1000 on an exponential. A distance of 0: it does not
  /// fade. With a power of 0 shadows do not, either.
  double fade_distance = 0;
  double fade_power = 0;
  Vec3 fade_colour{0, 0, 0};
  double caustics = 0; ///< shadows get lighter where light falls through it straight; more is less wide
  /// What light that passes a surface of it, going in or out, is multiplied by, where it is totally reflected
  /// as well: POV-Ray's `refraction` of a finish. Not the light of shadow rays. Less than 0 counts as 0.
  double refraction = 1;
  bool hollow = false; ///< there is fog in it, too
};

/// What light passes through on its way between surfaces, but for rays that are in an object whose interior
/// is not hollow.
struct Fog {
  Vec3 colour{0, 0, 0};
  double filter = 0;   ///< how much of what is seen through it takes its colour
  double transmit = 0; ///< the share of light that passes it however far, 0 to 1
  double distance = 0; ///< after which 1/e of the light is left; 0: there is no fog
  /// It lies on the ground and thins out above `offset`, as 1/(1 + y^2) at y times `altitude` above that.
  /// Heights are along `up`, of length 1.
  bool is_ground = false;
  double offset = 0;
  double altitude = 0; ///< 0: there is no fog above the offset
  Vec3 up{0, 1, 0};
  Turbulence turbulence;           ///< clears it here and there, where an amount is not 0
  double turbulence_depth = 0.5;   ///< how much
  Vec3 turbulence_origin{0, 0, 0}; ///< in the scene, of the noise
};

/// A bow of colours, with POV-Ray's formulas: it is seen before whatever rays meet there, the more the
/// farther away that is, also before nothing at all; not by rays that are in an object whose interior is not
/// hollow. Where several are seen they count the same. Fog is before all of them.
struct Rainbow {
  struct Colour {
    double position; ///< ascending, 0 at the inner edge of the bow to 1 at the outer one
    Vec3 rgb{0, 0, 0};
    double filter = 0;   ///< how much of what is seen through it takes the colour
    double transmit = 0; ///< the share of it that is seen in any case
  };
  Vec3 direction{0, 0,
                 1};      ///< in which light falls, of any length but 0: the bow is around what is seen there
  double angle = 0;       ///< to that, of the middle of the bow, in degrees
  double width = 0;       ///< of the bow, in degrees; 0: there is none
  double distance = 0;    ///< of what is seen by 1/e; not above 0: there is no bow
  double jitter = 0;      ///< by so much of the width colours lie elsewhere, at random
  Vec3 up{0, 1, 0};       ///< where the middle of its arc is; not along the direction
  double arc_angle = 360; ///< of the arc, in degrees
  double falloff_angle = 360;  ///< of the part of the arc that does not fade toward the ends
  std::vector<Colour> colours; ///< 1 to 256, blended in between
};

/// Index into Scene::materials or Scene::interiors.
using Index = std::uint32_t;
inline constexpr Index kNoIndex = 0xFFFFFFFFu;

/// The area of a light that casts soft shadows: a grid of places in a parallelogram around its location, from
/// each of which shadows are cast as from a point. POV-Ray looks at the corners, and at what lies between
/// them where they differ.
struct LightArea {
  Vec3 across{1, 0, 0}, along{0, 1, 0}; ///< from the first column to the last, from the first row to the last
  int columns = 2, rows = 2;            ///< 1 to 256 each
  int adaptive = 100;    ///< times, from 0 on, that the grid is divided even if its corners do not differ
  bool jitter = false;   ///< places are moved by up to half of the way to the next, always in the same manner
  bool circular = false; ///< the grid is pulled into an ellipse
  /// It turns to each surface, with both sides as long as `across`, and is circular, too.
  bool orient = false;
};

struct Object;

/// A light source with POV-Ray's formulas and defaults.
struct Light {
  enum class Kind {
    point,     ///< to all sides
    spotlight, ///< in a cone
    cylinder   ///< in a cylinder that begins at the location, with parallel rays
  };
  Vec3 location{0, 0, 0};
  Vec3 colour{1, 1, 1};
  bool shadowless = false; ///< casts no shadows and makes no highlights
  Kind kind = Kind::point;
  /// Where the axis of all but points goes to, from the location. If it is the location there is no light.
  Vec3 point_at{0, 0, 1};
  /// Of all but points: where the edge begins and ends. Spotlights: angles to the axis in degrees; cylinders:
  /// distances from it.
  double radius = 30, falloff = 45;
  double tightness = 0;  ///< the exponent by which light decreases off the axis, of all but points
  bool parallel = false; ///< all rays along the axis, also behind the location; a spotlight has no edge then
  /// At which there is as much light as without fading; 0: it does not fade. As in POV-Ray, the share of
  /// light is 2 / (1 + (distance / fade_distance)^fade_power) for negative distances, too: those behind
  /// parallel light.
  double fade_distance = 0;
  double fade_power = 0; ///< the exponent by which light decreases with distance; 0: it does not fade
  /// Of what its shadows are; else of a point.
  std::optional<LightArea> area = std::nullopt;
  /// Only what comes through it shines, from there on: what is between it and the light casts no shadows. Its
  /// materials and interiors mean nothing. No mesh may be a part of a CSG in it. Null: light goes everywhere.
  std::shared_ptr<const Object> projected_through = nullptr;
  bool is_dimmed_by_fog = false; ///< what comes through fogs is less, but not of a shadowless light
  bool is_global = true; ///< shines on all objects but those of light groups that leave global lights out
};

/// Which lights shine on the objects that refer to it. Shadows are cast by all objects, whatever group they
/// or the light are in.
struct LightGroup {
  std::vector<Index> lights;  ///< into Scene::lights
  bool global_lights = false; ///< those of Light::is_global, too
};
inline constexpr int kMostLightGroups = 255;

/// Triangles with shared vertices; vertices, normals and surface coordinates are single precision, as in
/// POV-Ray. Where a material looks different from inside, a triangle's outside is where its normals point, or
/// that of a flat one where -(b - a) x (c - a) does, of its corners a, b and c; of a face with several
/// materials the first says what it looks like from there.
struct Mesh {
  struct Triangle {
    Index vertex[3];
    /// kNoIndex in all three, never in one or two: flat.
    Index normal[3] = {kNoIndex, kNoIndex, kNoIndex};
    /// Index into Scene::materials; kNoIndex: the instance's material. Three different ones are blended over
    /// the face by its barycentric coordinates.
    Index material[3] = {kNoIndex, kNoIndex, kNoIndex};
  };
  std::vector<Vec3f> vertices;
  std::vector<Vec3f> normals;
  std::vector<Triangle> triangles;
  /// Surface coordinates at the corners of a triangle, between which they are interpolated.
  struct Coordinates {
    Vec2f corner[3] = {{0, 0}, {0, 0}, {0, 0}};
  };
  std::vector<Coordinates> coordinates; ///< by triangle; empty: 0 all over
  /// A direction of any length, in the mesh's space. For CSG a point is in the mesh if the ray from there
  /// along it crosses an odd number of triangles. Zero: nothing is in the mesh, and nothing in its inverse
  /// either.
  Vec3 inside_vector{0, 0, 0};

  bool has_inside() const { return inside_vector != Vec3(0); }
};

struct Sphere {
  Vec3 centre{0, 0, 0};
  double radius = 1;
};

/// Infinite; the side that the normal points away from is inside.
struct Plane {
  Vec3 normal{0, 1, 0}; ///< of any length
  double distance = 0;  ///< of the origin, along the unit normal
};

/// Flat and round, with a hole. Inside of its plane, for CSG, is the side that the normal points away from.
struct Disc {
  Vec3 centre{0, 0, 0};
  Vec3 normal{0, 1, 0}; ///< of any length
  double radius = 1;
  double hole_radius = 0;
};

/// From one corner to the opposite one.
struct Box {
  Vec3 corner[2] = {{-1, -1, -1}, {1, 1, 1}};
};

struct Cylinder {
  Vec3 base{0, 0, 0}, cap{0, 1, 0}; ///< middles of its two ends
  double radius = 1;
  bool open = false; ///< without the ends
};

/// Also cut off, if both radii are greater than 0.
struct Cone {
  Vec3 base{0, 0, 0}, cap{0, 1, 0};
  double base_radius = 1, cap_radius = 0;
  bool open = false; ///< without the ends
};

/// Around the y axis.
struct Torus {
  double major_radius = 1; ///< from the centre to the middle of the tube
  double minor_radius = 0.25;
};

/// Where dot(square, (xx, yy, zz)) + dot(mixed, (xy, xz, yz)) + dot(linear, (x, y, z)) + constant = 0. Below
/// 0 is inside.
struct Quadric {
  Vec3 square{1, 1, 1};
  Vec3 mixed{0, 0, 0};
  Vec3 linear{0, 0, 0};
  double constant = -1;
};

/// Where (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) = 1, e being `east_west` and n `north_south`: a sphere
/// where both are 1, more like a box the smaller they are, and with edges that bend inward above 2. Less than
/// 1e-4 counts as that.
struct Superellipsoid {
  double east_west = 1, north_south = 1;
};

/// Flat: loops of points in one plane, each of them closed from its last point to its first. It is there
/// where an odd number of lines of theirs lies to one side: a loop inside another one is a hole. For CSG
/// nothing is inside of it, and nothing of its inverse either.
struct Polygon {
  std::vector<std::vector<Vec3>> loops;
};

struct Csg;

/// One thing to hit: a shape, placed. Plain unions are already taken apart.
struct Object {
  std::variant<Sphere, std::shared_ptr<const Mesh>, Plane, Disc, Box, Cylinder, Cone, Torus, Quadric,
               Superellipsoid, std::shared_ptr<const Polygon>, std::shared_ptr<const Csg>>
      shape;
  Transform transform;
  Index material = 0;        ///< of a CSG: means nothing, its parts have their own
  Index interior = kNoIndex; ///< likewise; kNoIndex: one of its own, as Interior() makes it
  // Of these three POV-Ray does not take all that parts of a CSG say: in unions all, but in those that are
  // clipped or parts of other operations only no_reflection; in merges all but no_shadow; in others nothing.
  // What a ray does not see of a merge hides nothing of its other parts from that ray.
  bool no_shadow = false;
  bool no_image = false;      ///< seen in mirrors alone
  bool no_reflection = false; ///< seen in no mirror
  /// Neither seen nor in the way of light, and nothing is inside of it. Rendering goes on from there and back
  /// at small cost. Of parts of a CSG, of what clips or what lights are projected through: means nothing.
  bool is_hidden = false;
  bool inverse = false; ///< inside and outside change places
  /// Light that falls on the other side counts as if it fell on this one: POV-Ray's double_illuminate. Of a
  /// CSG: means nothing.
  bool is_lit_through = false;
  /// Index into Scene::light_groups: its lights shine on it. kNoIndex: all global ones. Of a CSG: means
  /// nothing.
  Index light_group = kNoIndex;
  /// Only what is inside all of these is there. They are placed as the object is, and their materials mean
  /// nothing. Null: all of it.
  std::shared_ptr<const std::vector<Object>> clipped_by = nullptr;
};

/// Constructive solid geometry, as in POV-Ray: which parts of its parts' surfaces are there. A surface that
/// is there has the material of the part that it belongs to.
struct Csg {
  enum class Operation {
    union_,       ///< all of them
    merge,        ///< what is in no other part
    intersection, ///< what is in all other parts
    difference    ///< the first part without the others
  };
  Operation operation = Operation::union_;
  std::vector<Object> parts; ///< placed in the space of the CSG
};

struct CELLTRACE_EXPORT Scene {
  std::string name; ///< for messages: the file it came from
  Camera camera;
  Vec3 background{0, 0, 0};
  /// Share of what is behind the picture that comes through the background, 0 to 1; counts where a picture
  /// has alpha. Below version 3.7 it means nothing: only mirrors see sky and background there.
  double background_transparency = 1;
  /// What reflected rays see in place of the background, those in glass too, where a picture has alpha and
  /// the scene no sky; none: the same. `background` is what is left of it then behind the picture.
  std::optional<Vec3> mirrored_background;
  /// Layers over the background, the last one on top: what rays meet that hit nothing. Their patterns are
  /// asked at the ray's direction, of length 1.
  std::vector<Pigment> sky_sphere;
  Vec3 ambient_light{1, 1, 1};
  std::vector<Fog> fogs;
  std::vector<Rainbow> rainbows;
  std::vector<Light> lights;
  std::vector<LightGroup> light_groups; ///< at most kMostLightGroups
  std::vector<Material> materials;      ///< objects refer to these by index
  std::vector<Interior> interiors; ///< one per object (or union); its identity matters, not only its values
  std::vector<Object> objects;

  GammaMode gamma_mode = GammaMode::assumed;
  double assumed_gamma = 1;
  /// Effective language version (3.62 for a scene without #version): below 3.7 the opacity of a surface is
  /// 1 - (filter*max(r,g,b) + transmit), from 3.7 on 1 - filter - transmit.
  double version = 3.7;
  int max_trace_level = 5;
  double adc_bailout = 1.0 / 255;
  Vec3 irid_wavelength{0.7, 0.52, 0.48}; ///< of red, green and blue, where films are thin
  int noise_generator = 2;               ///< of patterns that do not say: 1 to 3 as POV-Ray counts them
  int number_of_waves = 10;              ///< of ripples and waves

  /// Appends and returns the index.
  Index add(const Material& material);
  Index add(const Interior& interior);
};

/// Throws InputError if a number is not finite, or an angle negative.
CELLTRACE_EXPORT void validate(const Camera& camera);
/// Throws InputError, naming the first fault, if an index is out of range, a number is not finite, or there
/// are more triangles or vertices than 32-bit offsets can address, or a light's area has no places.
CELLTRACE_EXPORT void validate(const Scene& scene);

} // namespace celltrace
