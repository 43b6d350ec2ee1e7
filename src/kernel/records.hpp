// The records that cross DMA between the PPE and the SPE program: the tables of the scene image, the frame,
// and what an SPE reports. Fixed-width types, 16-byte aligned, sizes asserted; offsets are bytes from the
// base of the scene image. Each says its fields to the PPE, padding included, in scene/image_fields.hpp or
// render/frame_fields.hpp. Kernel dialect.
#pragma once

#include "celltrace/spe/types.hpp"

#include <stdint.h>

namespace celltrace::kernel {

constexpr uint32_t kNoOffset = 0xFFFFFFFFu;
constexpr uint32_t kNoGroup = 0xFFFFFFFFu;

// --- scene image ---

/// What an object record describes; low byte of ObjectRecord::kind_and_flags: the place of a shape in the
/// list of primitives/list.hpp, of which these are the first.
enum class ObjectKind : uint32_t { sphere = 0, triangle = 1, plane = 2, ellipsoid = 3 };
constexpr uint32_t kMaxPrimitives = 16;

namespace object_flag {
constexpr uint32_t kind_mask = 0x7F;
/// Secondary rays may leave some of its materials, or these are texture maps.
constexpr uint32_t spawns = 0x80;
constexpr uint32_t smooth = 0x100;     ///< triangle with vertex normals
constexpr uint32_t no_shadow = 0x200;  ///< shadow rays pass
constexpr uint32_t opaque = 0x400;     ///< shadow rays stop
constexpr uint32_t blended = 0x800;    ///< `material` is the offset of a BlendRecord
constexpr uint32_t open = 0x1000;      ///< cylinder or cone without caps
constexpr uint32_t csg = 0x2000;       ///< part of a CSG: crossings count where its condition holds
constexpr uint32_t textured = 0x4000;  ///< some materials of it are not the constants of their records alone
constexpr uint32_t disturbed = 0x8000; ///< some of its materials disturb normals
constexpr uint32_t no_image = 0x10000; ///< only rays that came by a mirror see it
constexpr uint32_t no_reflection = 0x20000; ///< and these do not
constexpr uint32_t selective = no_image | no_reflection;
constexpr uint32_t two_sided = 0x40000;   ///< another material where it is seen from inside,
constexpr uint32_t inverse = 0x80000;     ///< which is what else is outside
constexpr uint32_t by_surface = 0x100000; ///< some patterns of it ask for more of it than points
constexpr uint32_t flat_map = 0x200000;   ///< an ellipsoid whose surface coordinates are x and y
/// Some of its materials send on light that falls on the other side.
constexpr uint32_t lit_behind = 0x400000;
constexpr uint32_t lit_through = 0x800000; ///< as if it fell on this side; also lit_behind then
constexpr uint32_t light_set_shift = 24; ///< number of the set of lights that shine on it; 0: all global ones
} // namespace object_flag

/// What an object has to have among its kind_and_flags: in the bits of `mask` those of `value`, and no
/// others.
struct ObjectFlags {
  uint32_t mask, value;

  constexpr bool are_in(uint32_t kind_and_flags) const { return (kind_and_flags & mask) == value; }
};
/// Triangles that are no part of a CSG, which all rays see.
constexpr ObjectFlags kPlainTriangle = {object_flag::kind_mask | object_flag::csg | object_flag::selective,
                                        static_cast<uint32_t>(ObjectKind::triangle)};
/// Those of them that occlude all light.
constexpr ObjectFlags kOpaqueTriangle = {kPlainTriangle.mask | object_flag::opaque | object_flag::no_shadow,
                                         kPlainTriangle.value | object_flag::opaque};

constexpr uint32_t kMaxLightSets = 1u << (32 - object_flag::light_set_shift);

/// Geometry by kind: sphere: centre (0..2), radius (3), the directions of its x axis (4..6) and y axis (7..9)
/// and 1 or, if it is mirrored, -1 (10), which are for its surface coordinates. Triangle: its vertices (0..2,
/// 3..5, 6..8). All others: the affine map from the world to the own space of the shape or the mesh, three
/// rows of four (xyz | offset).
struct alignas(64) ObjectRecord {
  uint32_t kind_and_flags;
  uint32_t material; ///< offset of a MaterialRecord, or of a BlendRecord if `blended`
  uint32_t interior; ///< offset of an InteriorRecord; also identifies the inside
  uint32_t extra;    ///< offset of an ExtraRecord, or kNoOffset
  float geometry[12];
};
static_assert(sizeof(ObjectRecord) == 64, "two objects a line");

/// What few objects have. `value`: of a smooth triangle, the normals at its three vertices, xyz each, which
/// interpolate linearly and have any common length; of a shape in its own space, its parameters, of a polygon
/// those of PolygonEdges, of an instance the bits of its InstanceRecord's offset.
struct alignas(64) ExtraRecord {
  float value[9];
  uint32_t csg; ///< of objects with object_flag::csg: offset of a CsgRecord
  /// Of such objects and of instances: what may be there of them; least x, y, z, greatest x, y, z. But of
  /// triangles with object_flag::by_surface the surface coordinates u, v of their vertices, 0 if they have no
  /// such record.
  float bounds[6];
};
static_assert(sizeof(ExtraRecord) == 64, "two records a line");

/// An edge of a polygon, in the plane of its space, from its lower end up. It is beside points that are from
/// `low` on and below `high`: there it is at `column`, and `slope` more for each unit above `low`.
struct alignas(16) PolygonEdgeRecord {
  float low, high, column, slope;
};
static_assert(sizeof(PolygonEdgeRecord) == 16, "eight a line");

// Constructive solid geometry. Surfaces of its parts are objects; a crossing with one counts where the
// condition of the part holds: in all other parts of an intersection, in no other part of a merge, at each
// level of the tree. As in POV-Ray, parts of a merge that a ray does not see hide nothing from it.

/// The condition of a part, at one level. Its program says of a point whether it is in the other parts; steps
/// [skip_begin, skip_end) are of the part itself.
struct alignas(32) CsgRecord {
  uint32_t next;  ///< offset of the condition at the next level, or kNoOffset
  uint32_t steps; ///< offset of the first CsgStep
  uint32_t count; ///< of steps
  uint32_t skip_begin, skip_end;
  uint32_t unused[3];
};
static_assert(sizeof(CsgRecord) == 32, "four a line");

/// A step: where to go on, by number, if the point is in a solid or not. Steps only go forward.
struct alignas(16) CsgStep {
  uint32_t solid; ///< offset of a SolidRecord
  uint32_t if_inside, if_outside;
  /// Of object_flag::selective. If it is not 0, the solid is not asked: rays that do not see what has these
  /// flags go on at `if_outside`, others at `if_inside`.
  uint32_t unseen_by;
};
static_assert(sizeof(CsgStep) == 16, "eight a line");
constexpr uint32_t kCsgAccept = 0xFFFFFFFFu;
constexpr uint32_t kCsgReject = 0xFFFFFFFEu;

/// A shape of which only the inside matters.
struct alignas(128) SolidRecord {
  ObjectRecord object; ///< kind and geometry; kEmptySolid: nothing is inside
  ExtraRecord extra;
};
static_assert(sizeof(SolidRecord) == 128, "one a line");
constexpr uint32_t kEmptySolid = object_flag::kind_mask;

// The inside of a mesh: a point is in it if the ray from there along the mesh's inside vector crosses an odd
// number of triangles. So that few of them need be looked at, a grid lies across that vector: coordinates
// (column, row, height) are those of a space whose third axis is along the vector, and in which cell (i, j)
// reaches from (i, j) to (i + 1, j + 1).

/// SolidRecord: a mesh. `geometry` is the map from the world to the coordinates of the grid whose
/// MeshGridRecord is at `extra`.
constexpr uint32_t kMeshSolid = kEmptySolid - 1;

/// Cell (i, j) has number j * columns + i. Its list is a word a triangle, the offset of its
/// MeshTriangleRecord. It lies between two offsets that follow each other in the words at `starts`: the one
/// that has the cell's number, and the next one.
struct alignas(16) MeshGridRecord {
  uint32_t starts; ///< offset of the first of columns * rows + 1 words
  uint32_t columns, rows;
  uint32_t unused;
};
static_assert(sizeof(MeshGridRecord) == 16, "eight a line");
constexpr uint32_t kMaxMeshGridSide = 1024; ///< columns or rows: single precision counts the cells exactly

/// A triangle of a mesh, in the coordinates of the grid. Its corners 0, 1, 2 are in the order of their rows;
/// an edge is the same numbers in all triangles that have it.
struct alignas(64) MeshTriangleRecord {
  float row[3];
  float column[2];   ///< of corners 0 and 1
  float slope[3];    ///< columns a row, of the edges 0-1, 1-2, 0-2
  float height;      ///< of corner 0
  float gradient[2]; ///< of the height, by column and row
  float least_height, greatest_height;
  uint32_t unused[3];
};
static_assert(sizeof(MeshTriangleRecord) == 64, "two a line");

// A mesh without an inside vector in CSG. POV-Ray looks at the boxes of its triangles in the order in which a
// ray enters them, and stops before the first one that it enters behind the crossing found last: CSG shows
// what was found until then.

/// SolidRecord: which crossings with such a mesh are found. `geometry` is the map from the world to the
/// mesh's own space, `extra` the offset of the first of its CrossedMeshRecords.
constexpr uint32_t kCrossedMeshSolid = kEmptySolid - 2;

/// A triangle of such a mesh, or a box around those between this record and the one at `next`: a tree of
/// boxes in depth-first order. The first record is the box around all.
struct alignas(64) CrossedMeshRecord {
  float corner[3][3];   ///< of a box: the least and the greatest one
  uint32_t next;        ///< offset of the record behind it and what is in it
  uint32_t is_triangle; ///< 0 or 1
  uint32_t unused[5];
};
static_assert(sizeof(CrossedMeshRecord) == 64, "two a line");

// Instances of a mesh of which the image has one copy. Its triangles are ObjectRecords in its own space, in a
// table apart, in the order of the leaves of a BVH that it has for itself. An instance is one object, whose
// test traverses that BVH. Hits name a triangle of an instance by a number, for which an ObjectRecord in the
// world is made where one is asked for.

/// Set in the numbers of such triangles, and in no offset that objects have in an image with instances.
constexpr uint32_t kInstancedBit = 0x80000000u;
/// Whether the object that a ray hits or starts on is such a triangle.
constexpr bool is_instanced(uint32_t object) {
  return object + 1 > kInstancedBit; // that of kNoOffset is 0
}
/// Levels of a mesh's BVH, at most.
constexpr uint32_t kMaxMeshLevels = 16;

/// The records of a mesh's triangles have the material kNoOffset where that is the instance's. Neither has
/// materials that let light through, ask for more of surfaces than points, or look different from inside.
struct alignas(128) InstanceRecord {
  float to_world[12];       ///< the affine map from the mesh's space, three rows of four
  float normal_to_world[9]; ///< three rows
  uint32_t first_number;    ///< of its triangles, in ascending order; the first one of all is 1
  uint32_t triangle_count;
  uint32_t first_triangle; ///< offset of the mesh's first ObjectRecord
  uint32_t root;           ///< offset of the mesh's NodeRecord
  uint32_t kind_and_flags; ///< of triangles without a material of their own
  uint32_t material;       ///< of these
  uint32_t interior;       ///< of all
  uint32_t owner;          ///< index of its object in the scene
  uint32_t unused[3];
};
static_assert(sizeof(InstanceRecord) == 128, "one a line");

/// A face whose vertices have different materials, blended by barycentric coordinates.
struct alignas(16) BlendRecord {
  uint32_t material[3];
  uint32_t unused;
};
static_assert(sizeof(BlendRecord) == 16, "crosses DMA");

// Textures. What a pattern's values stand for is said by entries of a map, and an entry may be a map again.

namespace pattern_flag {
constexpr uint32_t kind_mask = 0xFF; ///< the place of its kind in the list of textures/list.hpp
constexpr uint32_t wave_shift = 8;   ///< a PatternWave
constexpr uint32_t wave_mask = 0x7;
constexpr uint32_t turbulent = 0x800;        ///< `turbulence` displaces points
constexpr uint32_t average = 0x1000;         ///< all entries, by weights that are their positions
constexpr uint32_t first_generator = 0x2000; ///< of noise: scaled as POV-Ray's generator 1 does
constexpr uint32_t nested = 0x4000;          ///< of a pigment: an entry or the pattern is a map
constexpr uint32_t gradient_noise = 0x8000;  ///< of noise: POV-Ray's generator 3
constexpr uint32_t at_features = 0x10000;    ///< of noise: at the nearest of the random points
constexpr uint32_t shifted = 0x20000;        ///< a ShiftedPattern that has turbulence
constexpr uint32_t uv_mapping = 0x40000;     ///< `to_space` is from surface coordinates (u, v, 0)
constexpr uint32_t never_repeats = 0x80000;  ///< values above 1 stay what they are
/// Of a map that is in no other one: everything in it is at points of this pattern's own space, not of the
/// world, so that maps which differ by their space alone share what is in them.
constexpr uint32_t relative = 0x100000;
} // namespace pattern_flag
/// What becomes of a pattern's values: POV-Ray's wave forms. `none`: they stay, frequency and phase mean
/// nothing.
enum class PatternWave : uint32_t {
  ramp = 0,
  triangle = 1,
  sine = 2,
  scallop = 3,
  cubic = 4,
  poly = 5,
  none = 6
};

/// Displacement by noise.
struct TurbulenceWords {
  float amount[3];
  float lambda, omega;
  uint32_t octaves;
};

/// Points go through `to_space`, then the steps, then the turbulence if there is any.
struct alignas(128) PatternRecord {
  uint32_t kind_and_flags;
  uint32_t entries; ///< offset of the first MapEntryRecord
  uint32_t entry_count;
  uint32_t steps; ///< offset of the first SpaceStepRecord
  uint32_t step_count;
  float to_space[12]; ///< three rows of four (xyz | offset)
  float frequency, phase, wave_exponent;
  TurbulenceWords turbulence;
  float parameter[5]; ///< by kind
  /// Offset of the table that its kind reads: FeatureRecords, WaveRecords, a SlopeRecord, the PatternRecord
  /// of a pigment that is the pattern, a CsgRecord that says what is in an object, or with `gradient_noise`
  /// GradientRecords, before which there are the FeatureRecords if it reads both. Of fractals: fractal_word.
  uint32_t table;
};
static_assert(sizeof(PatternRecord) == 128, "one a line");

/// What points go through between the world and a pattern's space.
enum class WarpKind : uint32_t {
  turbulence = 0,
  repeat = 1,
  black_hole = 2,
  planar = 3,
  cylindrical = 4,
  spherical = 5,
  toroidal = 6
};
constexpr uint32_t kWarpKinds = 7;
namespace warp_flag {
constexpr uint32_t kind_mask = 0xFF;
constexpr uint32_t axis_shift = 8; ///< of a repeat: 0 to 2
constexpr uint32_t inverse = 0x400;
} // namespace warp_flag

/// PatternRecord::table of a fractal.
namespace fractal_word {
constexpr uint32_t exponent_mask = 0xFF;
constexpr uint32_t exterior_shift = 8; ///< POV-Ray's number of what is counted, 0 to 8
constexpr uint32_t interior_shift = 12;
constexpr uint32_t type_mask = 0xF;
constexpr uint32_t magnet_shift = 16; ///< 0 to 2
constexpr uint32_t magnet_mask = 0x3;
constexpr uint32_t julia = 0x40000;
} // namespace fractal_word

/// A warp, then a map. `value`: of a repeat, its width, 1 or -1 by axis as it flips, and the offset; of a
/// black hole, its centre, radius, strength and falloff, and the distances at which it repeats, by axis, 0
/// where it does not, while `turbulence` is that of the copies; of the others, their orientation, a unit
/// vector, the distance's exponent, and the major radius.
struct alignas(128) SpaceStepRecord {
  TurbulenceWords turbulence;
  float to_space[12];
  uint32_t kind_and_flags; ///< WarpKind and warp_flag
  uint32_t table;          ///< of a black hole: offset of the FeatureRecords
  float value[12];
};
static_assert(sizeof(SpaceStepRecord) == 128, "one a line");

// Tables of random numbers, which the image has if a pattern reads them. All are POV-Ray's.

/// A random point in each of the unit cells of space, whose corner (x, y, z) gives the number
/// h(h(h(x) ^ y) ^ z), each coordinate modulo kFeatures, where h() is `hash` of the record of a number.
struct alignas(16) FeatureRecord {
  float place[3]; ///< in its cell, 0 to 1
  uint32_t hash;
};
static_assert(sizeof(FeatureRecord) == 16, "eight a line");
constexpr uint32_t kFeatures = 4096;

/// Of the noise of generator 3. The corner (x, y, z) of a cell has the gradient of record
/// next(next(x) + y) + z, all modulo kGradients.
struct alignas(16) GradientRecord {
  float gradient[3];
  uint32_t next;
};
static_assert(sizeof(GradientRecord) == 16, "eight a line");
constexpr uint32_t kGradients = 2048;

/// Of ripples and waves: where one comes from, and how often it comes.
struct alignas(16) WaveRecord {
  float source[3];
  float frequency; ///< of waves; ripples are all of 1
};
static_assert(sizeof(WaveRecord) == 16, "eight a line");

/// Of a slope: its value is factor * (1 - a) + altitude . point + offset, where a is the angle of the
/// surface's normal to the direction, in half turns.
struct alignas(32) SlopeRecord {
  float direction[3]; ///< of unit length
  float factor;
  float altitude[3];
  float offset;
};
static_assert(sizeof(SlopeRecord) == 32, "four a line");

/// What stands for a value of a pattern.
struct alignas(32) MapEntryRecord {
  float position; ///< the pattern's value, or an average's weight
  /// Of the interval from the entry before. 0 where there is none, or where that one counts alone: it is the
  /// same.
  float inverse_width;
  float rgb[3]; ///< of a pigment without a map
  float filter, transmit;
  /// Pigments: offset of a PatternRecord, whose map it is, or kNoOffset. Normals: of a NormalRecord.
  /// Textures: of a MaterialRecord. Slope maps: means nothing; rgb[0] is the height there, rgb[1] the slope.
  uint32_t child;
};
static_assert(sizeof(MapEntryRecord) == 32, "four a line");

/// A normal: adds a disturbance to the normals of surfaces, which the linear map takes to the pattern's
/// space.
struct alignas(64) NormalRecord {
  uint32_t pattern; ///< offset of a PatternRecord
  /// 0 or 1: the pattern's entries are NormalRecords, and what follows means nothing. 0: if the pattern has
  /// entries, they are a slope map.
  uint32_t is_mapped;
  float amount;
  float accuracy;  ///< distance at which slopes are measured
  float linear[9]; ///< three rows
  uint32_t unused[3];
};
static_assert(sizeof(NormalRecord) == 64, "two a line");

namespace material_flag {
constexpr uint32_t fresnel = 0x1;
constexpr uint32_t conserve_energy = 0x2;
constexpr uint32_t patterned = 0x4; ///< `pattern` says what the pigment is
constexpr uint32_t disturbed = 0x8; ///< has a normal
constexpr uint32_t layered = 0x10;  ///< has a layer below
constexpr uint32_t mapped = 0x20;   ///< a texture map: `pattern` has MaterialRecords, all else means nothing
constexpr uint32_t old_opacity =
    0x40; ///< filtered light is counted by the brightest channel, as before version 3.7
// What the numbers of a record ask for: where a flag is not set, numbers that only it concerns are not read.
constexpr uint32_t bends_diffuse = 0x80; ///< brilliance is not 1
constexpr uint32_t phong = 0x100;
constexpr uint32_t specular = 0x200;
constexpr uint32_t highlights = phong | specular;
constexpr uint32_t metallic = 0x400; ///< of highlights
constexpr uint32_t reflects = 0x800;
constexpr uint32_t metallic_mirror = 0x1000;
constexpr uint32_t falloff = 0x2000;          ///< of reflection is not 1
constexpr uint32_t bends_reflection = 0x4000; ///< its exponent is not 1
constexpr uint32_t transmits = 0x8000;        ///< by its constants; a pattern may do so as well
} // namespace material_flag

/// A texture or one layer of it: pigment, normal and finish, with what is constant per frame computed
/// beforehand.
struct alignas(128) MaterialRecord {
  float pigment[3];
  float filter;
  float transmit;
  float opacity;
  float ambient[3]; ///< finish ambient times the scene's ambient light, plus emission
  float diffuse;
  float brilliance;
  float phong;
  float phong_size;
  float specular;
  float inverse_roughness;
  float metallic;
  float reflection_min[3];
  float reflection_max[3];
  float reflection_falloff;
  float reflection_metallic;
  float inverse_reflection_exponent;
  uint32_t flags;
  uint32_t pattern;     ///< offset of a PatternRecord
  uint32_t normal;      ///< offset of a NormalRecord
  uint32_t below;       ///< offset of the layer's MaterialRecord
  uint32_t finish;      ///< offset of a FinishRecord, or kNoOffset
  uint32_t inside;      ///< two_sided objects: offset of the MaterialRecord that is seen from inside
  float diffuse_behind; ///< of light that falls on the other side
};
static_assert(sizeof(MaterialRecord) == 128, "one material a line");

/// What few finishes have.
struct alignas(32) FinishRecord {
  float crand;
  float irid;
  float irid_thickness;
  float irid_turbulence;
  float inverse_wavelength[3];
  uint32_t first_generator; ///< 0 or 1: of noise, as pattern_flag's
};
static_assert(sizeof(FinishRecord) == 32, "four a line");

struct alignas(32) InteriorRecord {
  float ior;
  /// What transmitted light is multiplied by at its surfaces; with the other sign, where there is fog in it.
  float signed_refraction;
  float inverse_fade_distance; ///< 0: it does not fade
  float fade_power;            ///< from 1000 on: exponentially
  float fade_colour[3];
  float caustics; ///< exponent; 0: none

  bool is_hollow() const { return __builtin_signbit(signed_refraction) != 0; }
  float refraction() const { return __builtin_fabsf(signed_refraction); }
};
static_assert(sizeof(InteriorRecord) == 32, "four a line");

namespace fog_flag {
constexpr uint32_t ground = 0x1;          ///< thins out with the height
constexpr uint32_t turbulent = 0x2;       ///< `turbulence` clears it
constexpr uint32_t first_generator = 0x4; ///< of noise, as pattern_flag's
} // namespace fog_flag

/// Heights are along `up`, in units of the altitude, and 0 where the fog begins to thin out.
struct alignas(128) FogRecord {
  float colour[3]; ///< of what it adds
  float least;     ///< share of light that passes in any case
  float tint[3];   ///< of what passes
  float inverse_distance;
  float up[3]; ///< over the altitude
  float offset;
  uint32_t flags;
  float turbulence_depth;
  TurbulenceWords turbulence;
  float turbulence_offset[3]; ///< added to points that are multiplied by its amount
  uint32_t unused[9];
};
static_assert(sizeof(FogRecord) == 128, "one a line");

/// A bow around the axis `direction`, in the plane of `up` and `right`; all three of unit length and at right
/// angles. Angles are in turns.
struct alignas(128) RainbowRecord {
  float direction[3];
  float angle; ///< from the axis to the middle of the bow
  float up[3];
  float inverse_width;
  float right[3];
  float inverse_distance;
  float jitter;       ///< of the place across the bow, by which the colours are chosen
  float falloff, arc; ///< along the bow from `up`: where it begins to fade and where it ends
  float inverse_fade; ///< of the way in between; 0: it does not fade
  uint32_t entries;   ///< offset of the first MapEntryRecord, of colours
  uint32_t entry_count;
  uint32_t unused[14];
};
static_assert(sizeof(RainbowRecord) == 128, "one a line");

namespace light_flag {
constexpr uint32_t kind_mask = 0xFF;   ///< the place of its kind in the list of lights/list.hpp
constexpr uint32_t shadowless = 0x100; ///< neither shadows nor highlights
constexpr uint32_t parallel = 0x200;   ///< all its rays go along its axis
constexpr uint32_t fades = 0x400;
constexpr uint32_t area = 0x800;        ///< has an area, which shadows are looked for on
constexpr uint32_t circular = 0x1000;   ///< that is round,
constexpr uint32_t orient = 0x2000;     ///< turns to surfaces,
constexpr uint32_t jitter = 0x4000;     ///< and whose places are moved at random
constexpr uint32_t selective = 0x8000;  ///< there are objects that it does not shine on
constexpr uint32_t projected = 0x10000; ///< shines through its projector alone
constexpr uint32_t dimmed = 0x20000;    ///< by fogs
} // namespace light_flag

/// Columns or rows of places on a light.
constexpr uint32_t kMaxLightPlaces = 256;

/// Beams have an axis, from which every point is some way off: 0 on it, 1 where there is no light any more.
struct alignas(128) LightRecord {
  float location[3];
  uint32_t kind_and_flags;
  float colour[3];
  float tightness;             ///< of a beam
  float axis[3];               ///< of unit length, away from the light; of beams and parallel lights
  float inverse_width;         ///< of a cylinder: of the distance from the axis that is 1 way off
  float inner;                 ///< way off where a beam's edge begins
  float inverse_edge;          ///< of the edge's width
  float inverse_fade_distance; ///< where there is as much light as without fading
  float fade_power;

  // Of a light with an area.
  float across[3]; ///< from the first column of places to the last
  uint32_t columns;
  float along[3]; ///< from the first row to the last
  uint32_t rows;
  float inverse_columns, inverse_rows; ///< of columns - 1, rows - 1
  uint32_t adaptive;                   ///< times that the grid is divided in any case
  float axis_length;                   ///< from the location to where the light points

  /// Selective: offset of words with a bit for each set of lights, whether it has this one.
  uint32_t lit_sets;
  uint32_t projector, projector_count; ///< projected: offset of the first ObjectRecord that it shines through
  /// The power of a negative distance, in units of that of fading, over the power of the positive one: 1 or
  /// -1, or so much that no light is left where it is no number. As in POV-Ray, whose distances behind
  /// parallel light are negative.
  float fade_behind;
};
static_assert(sizeof(LightRecord) == 128, "one light a line");

/// A voxel: where its list of object offsets starts, and how many there are.
struct alignas(8) CellRecord {
  uint32_t list; ///< offset of the first of `count` words
  uint32_t count;
};
static_assert(sizeof(CellRecord) == 8, "sixteen voxels a line");

/// Objects that are near each other and neighbours in the table, with a box around them.
struct alignas(32) GroupRecord {
  float min[3];
  uint32_t first; ///< index of an ObjectRecord
  float max[3];
  uint32_t count;
};
static_assert(sizeof(GroupRecord) == 32, "four groups a line");
/// A group may be a copy of an earlier one, its prototype: it has as many objects, each of which lies among
/// its neighbours as the one at the same place of the prototype does. Both have no more objects than this.
constexpr uint32_t kMaxCopiedObjects = 256;

/// What light may meet on its way that few scenes have.
namespace light_way {
constexpr uint32_t atmosphere = 0x1; ///< fogs or rainbows
constexpr uint32_t fading = 0x2;     ///< interiors that fade, or whose surfaces dim what they transmit
/// Shadow rays go from surface to surface: what these let through depends on more than points of them.
constexpr uint32_t stepwise = 0x4;
constexpr uint32_t by_surface = 0x8;  ///< some objects are object_flag::by_surface
constexpr uint32_t projectors = 0x10; ///< of lights
/// Shadow rays that cross two translucent surfaces within kShadowEpsilon may go on behind the second one: in
/// those, too, that are not `stepwise`.
constexpr uint32_t near_surfaces = 0x200;
/// With `stepwise`: only because interiors fade. What surfaces let through depends on points of them alone.
constexpr uint32_t only_fading = 0x400;
constexpr uint32_t unseen = 0x1000; ///< some objects are object_flag::no_image
/// With `near_surfaces`: which surfaces a shadow ray crosses depends on where it started last.
constexpr uint32_t restarts = 0x2000;
// Of frames alone, not of scene images:
constexpr uint32_t alpha = 0x20; ///< how clear each pixel is is wanted, too
/// With `alpha`: only rays that came by a mirror see sky and background.
constexpr uint32_t no_backdrop = 0x40;
/// With `alpha`: FrameBlock::background is what reflected rays see, others less of it, as it is clear.
constexpr uint32_t mirrored_background = 0x800;
constexpr uint32_t first_hits = 0x80; ///< what each primary ray hits is wanted, too
constexpr uint32_t jitter = 0x100;    ///< places of lights are moved, in each lane otherwise
} // namespace light_way

/// Beyond this nobody counts what may go on from surfaces.
constexpr uint32_t kMostSurfaceNodes = 0x10000;

/// Head of a scene image.
struct alignas(128) ImageHeader {
  uint32_t magic;
  uint32_t version;
  uint64_t bytes;    ///< of the static part, this header included
  uint64_t checksum; ///< of the static part with this field 0
  uint32_t object_offset, object_count;
  uint32_t material_offset, material_count;
  uint32_t interior_offset, interior_count;
  uint32_t light_offset, light_count;
  uint32_t extra_offset, extra_count;
  uint32_t blend_offset, blend_count;
  float bounds_min[3];
  float bounds_max[3];
  uint32_t group_offset, group_count; ///< all objects by group, or nothing: there are few
  uint32_t longest_group;             ///< objects
  /// By group, the group that it is a copy of, its own index if it has copies, or kNoGroup; or nothing: there
  /// are no copies.
  uint32_t prototype_offset, prototype_count;
  /// Objects without bounds, just before the others; no accelerator has them.
  uint32_t unbounded_count;
  uint32_t csg_offset, csg_count;           ///< CsgRecords
  uint32_t csg_step_offset, csg_step_count; ///< CsgSteps
  uint32_t solid_offset, solid_count;       ///< SolidRecords
  uint32_t pattern_offset, pattern_count;
  uint32_t space_step_offset, space_step_count;
  uint32_t map_entry_offset, map_entry_count;
  uint32_t normal_offset, normal_count;
  uint32_t sky; ///< offset of the uppermost layer's MaterialRecord, whose pigments count; kNoOffset: none
  uint32_t mesh_grid_offset, mesh_grid_count;         ///< MeshGridRecords
  uint32_t mesh_word_offset, mesh_word_count;         ///< words of theirs
  uint32_t mesh_triangle_offset, mesh_triangle_count; ///< MeshTriangleRecords
  uint32_t fog_offset, fog_count;                     ///< FogRecords
  uint32_t finish_offset, finish_count;               ///< FinishRecords
  uint32_t light_ways;                                ///< bits of light_way
  uint32_t feature_offset, feature_count;             ///< FeatureRecords: kFeatures of them, or none
  uint32_t gradient_offset, gradient_count;           ///< GradientRecords: likewise
  uint32_t wave_offset, wave_count;                   ///< WaveRecords
  uint32_t light_set_count;                           ///< sets of lights, of which object_flag has numbers
  uint32_t light_word_offset, light_word_count;       ///< words of LightRecord::lit_sets
  uint32_t polygon_edge_offset, polygon_edge_count;   ///< PolygonEdgeRecords
  uint32_t rainbow_offset, rainbow_count;             ///< RainbowRecords
  uint32_t slope_offset, slope_count;                 ///< SlopeRecords
  uint32_t projector_count; ///< ObjectRecords of projectors, just before those without bounds
  uint32_t surface_nodes; ///< that what the rays of a node hit may push, at most; kMostSurfaceNodes: or more
  uint32_t instance_offset, instance_count;         ///< InstanceRecords
  uint32_t mesh_object_offset, mesh_object_count;   ///< ObjectRecords of the meshes of instances
  uint32_t mesh_node_offset, mesh_node_count;       ///< NodeRecords of their BVHs
  uint32_t crossed_mesh_offset, crossed_mesh_count; ///< CrossedMeshRecords
  uint32_t unused[15];
};
static_assert(sizeof(ImageHeader) == 384, "three lines");

// --- frame ---

/// How a camera's rays lie to each other: from one point through a plane, parallel from a plane, or as the
/// code module of cameras makes them.
enum class RaySheaf : uint32_t { pinhole, parallel, made };

/// Flat cameras: through pixel (x, y) goes base + (x - middle_x)*dx + (y - middle_y)*dy, as a direction from
/// `origin` (not normalised) or as an origin with direction `origin`; `middle_y` may be another row than that
/// in the middle. Curved ones: `origin` is their location, and `base`, `dx` and `dy` are their axes forward,
/// right and up; pixel (x, y) is at ((x - middle_x) * step_x, (middle_y - y) * step_y) of their picture,
/// which the kind turns into a ray.
///
/// Rays of a camera that is far away start just before the scene, in the plane that is `ahead` away along the
/// unit vector `base`. Unless they are parallel they are then made as those of curved cameras are, flat ones
/// too, and `origin` is where the middle one starts.
struct alignas(16) CameraRecord {
  float origin[3];
  uint32_t kind; ///< its place in the list of cameras/list.hpp
  float base[3];
  float bend; ///< curved: what else the kind needs
  float dx[3];
  float middle_x;
  float dy[3];
  float middle_y;
  float step_x, step_y;
  /// 0: rays start at the camera. A ray starts ahead / dot(direction, axis) away from it, where the axis is
  /// `base`, or `origin` of parallel rays.
  float ahead;
  uint32_t sheaf; ///< RaySheaf
};
static_assert(sizeof(CameraRecord) == 80, "crosses DMA");

/// The uniform grid. Voxel (x, y, z) has index x + y*cells[0] + z*cells[0]*cells[1].
struct alignas(16) GridRecord {
  float min[3];
  uint32_t cell_offset;
  float max[3];
  uint32_t list_offset;
  float cell_size[3];
  uint32_t list_capacity; ///< words
  float inverse_cell_size[3];
  uint32_t list_count; ///< words in use, set by PREPARE FRAME
  uint32_t cells[3];
  uint32_t row_of_cells; ///< cells[0] * cells[1]
};
static_assert(sizeof(GridRecord) == 80, "crosses DMA");

/// A node of the BVH, four children wide: their bounds, coordinate by coordinate, and what is
/// in them. A child without objects has a box that is empty (min > max).
struct alignas(128) NodeRecord {
  float bounds[6][4]; ///< min x, max x, min y, max y, min z, max z of each child
  uint32_t child[4];  ///< offset of its NodeRecord; of a leaf: of its first object, or of its list
  uint32_t leaf[4];   ///< the objects of a leaf; 0: a node, or nothing if the box is empty
};
static_assert(sizeof(NodeRecord) == 128, "one node a line");

/// NodeRecord::leaf: in the low 8 bits how many objects there are, above them by how many places each lies
/// after the one before it in the table, signed. That is 0 if they are listed, a word each, its offset.
namespace leaf_word {
constexpr uint32_t kCountBits = 8;
constexpr uint32_t make(uint32_t count, int32_t step) {
  return count | (static_cast<uint32_t>(step) << kCountBits);
}
constexpr uint32_t count(uint32_t word) {
  return word & ((1u << kCountBits) - 1);
}
constexpr bool is_list(uint32_t word) {
  return (word >> kCountBits) == 0;
}
/// From one object's offset to the next one's, modulo 2^32.
constexpr uint32_t step_bytes(uint32_t word) {
  return static_cast<uint32_t>(static_cast<int32_t>(word) >> kCountBits) *
         static_cast<uint32_t>(sizeof(ObjectRecord));
}
/// What fits.
constexpr int32_t kMaxStep = (1 << (31 - kCountBits)) - 1;
/// Bytes that may be read from where a leaf's list begins, whatever its count.
constexpr uint32_t kReadableBytes = sizeof(ObjectRecord);
} // namespace leaf_word

/// the BVH. The root is the first node.
struct alignas(16) BvhRecord {
  uint32_t node_offset;
  uint32_t node_capacity; ///< nodes
  uint32_t node_count;    ///< in use, set by PREPARE FRAME
  uint32_t list_offset;   ///< a word per object, in the order of the leaves, of which lists take theirs
};
static_assert(sizeof(BvhRecord) == 16, "crosses DMA");

/// How rays find objects.
enum class AcceleratorKind : uint32_t { grid = 0, bvh = 1 };

enum class GammaEncoding : uint32_t { none = 0, assumed = 1 };

constexpr uint32_t kMaxInteriorDepth = 8;
constexpr uint32_t kPacketEdge = 4; ///< a packet is 4x4 rays

/// What a frame is for. Where colours are asked for, a picture without antialiasing is a grid of its pixels'
/// middles, and the host takes them from there. With antialiasing a picture takes two: the points of a grid,
/// one more than pixels each way, then the samples that some pixels need besides. `blocks` is a picture whose
/// pixels leave the SPEs as blocks of BC1.
enum class FramePurpose : uint32_t { picture = 0, grid = 1, samples = 2, blocks = 3 };

/// POV-Ray's. `fixed`: grid points are the middles of pixels, from the one to the upper left of the picture
/// on, and pixels that differ from their neighbours get a number of samples. `adaptive`: they are the corners
/// of pixels, which are divided as long as theirs differ.
enum class SamplingMethod : uint32_t { fixed = 1, adaptive = 2 };

/// Pixels a side of the blocks that are sampled by themselves. POV-Ray's, where its fixed method does not
/// look from one to the next.
constexpr uint32_t kSampledEdge = 32;
constexpr uint32_t kMaxSamplingDepth = 9;
/// Colours of a packet of grid points, red of all first, then green, then blue, then how clear they are.
constexpr uint32_t kGridPacketBytes = 4 * 4 * kPacketEdge * kPacketEdge;

/// What the primary rays of a packet hit.
struct alignas(64) FirstHitRecord {
  float distance[kPacketEdge * kPacketEdge];
  float normal[3][kPacketEdge * kPacketEdge];
  uint32_t interior[kPacketEdge * kPacketEdge]; ///< offset of an InteriorRecord; kNoOffset: nothing was hit
};
static_assert(sizeof(FirstHitRecord) == 320, "crosses DMA");

/// How pixels are sampled.
struct SamplingRecord {
  uint32_t method; ///< SamplingMethod
  uint32_t depth;  ///< fixed: samples a row, and rows; adaptive: levels of squares, the pixel the first one
  float threshold; ///< of the difference of two colours, summed over the channels
  float jitter;    ///< pixels that a sample may be moved by, all in all
  float inverse_gamma; ///< power that colours are raised to before they are compared
  /// Bytes of a row of colours, a ColourRecord a pixel. The rows lie behind those of the surface; 0: colours
  /// are not asked for.
  uint32_t colours_pitch;
};

/// A pixel's colour as the rays brought it, and the share of what is behind the scene that comes through
/// (light_way::alpha).
struct alignas(16) ColourRecord {
  float channel[4];
};

/// Everything an SPE needs for a frame. Lies in main memory at a place that does not change while the SPEs
/// run.
struct alignas(128) FrameBlock {
  CameraRecord camera;
  GridRecord grid;
  BvhRecord bvh;

  ea_t image;     ///< base of the scene image
  ea_t surface;   ///< RGBA8, or 8 bytes a packet; rows of `surface_pitch` bytes, both multiples of 16 bytes
  ea_t units;     ///< UnitRecord per unit of work, whole lines of them
  ea_t costs;     ///< uint32_t per unit of work, written by the SPEs: ticks that it took
  ea_t strips;    ///< StripRecord per SPE: the units it starts the frame with
  ea_t reports;   ///< ReportRecord per SPE
  ea_t ray_stack; ///< spill area: ray_stack_nodes nodes of kRayNodeBytes per SPE
  /// kGridPacketBytes per packet, row by row, then with light_way::first_hits a FirstHitRecord per packet;
  /// none if all frames are pictures.
  ea_t grid_points;
  ea_t sample_store; ///< sample_store_bytes() per SPE, its own; likewise
  /// Of a command: PREPARE FRAME's work memory, `work_entries` pairs of 8 bytes each; SYNCHRONIZE's list of
  /// lines that are out of date, the first block alone, whole lines of it, of `work_entries` words.
  ea_t work_memory[2];
  uint32_t prepare_spes; ///< that build the accelerator step by step; 0: one takes all steps
  uint32_t prepare_step; ///< the step that is to be taken

  uint32_t width, height; ///< pixels, or points of the grid
  uint32_t packet_columns, packet_rows;
  uint32_t bundle_columns;
  /// Rows of packets that `surface` and `grid_points` have room for, which may be a part of the picture's,
  /// and the first one of them.
  uint16_t surface_row, surface_rows;
  uint32_t surface_pitch;
  uint32_t work_entries;
  uint32_t ray_stack_nodes;

  uint32_t object_offset, object_count;
  uint32_t light_offset, light_count;
  uint32_t max_trace_level;
  float adc_bailout;
  uint32_t gamma_encoding; ///< GammaEncoding
  float assumed_gamma;

  float background[3];
  uint32_t epoch; ///< counts frames

  uint32_t cache_ways, cache_sets, cache_replacement, cache_enabled;

  uint32_t unit_count;
  uint32_t exchange_parameter; ///< lambda, 16-bit fixed point; 0: strips stay as they are
  uint32_t camera_interior_count;
  uint32_t accelerator;                         ///< AcceleratorKind
  uint32_t camera_interiors[kMaxInteriorDepth]; ///< offsets, outermost first

  uint32_t group_offset, group_count; ///< RunRecords
  uint32_t longest_group;             ///< objects
  uint32_t prototype_offset;          ///< a word per group; 0: there are no copies
  uint32_t units_per_word;            ///< that an SPE tells of its progress by; 0: it does not; or kEachUnit
  uint32_t wide_leaves;               ///< 0 or 1: for SPEs that test many triangles of a leaf at once
  uint32_t far_nodes;                 ///< 0 or 1: for SPEs that wait long for a node of the BVH
  uint32_t unbounded_count;           ///< objects just before the others that no accelerator has
  uint32_t sky;                       ///< as in ImageHeader
  uint32_t light_places;   ///< that shadows are looked for at; as many as lights if none has an area
  uint32_t purpose;        ///< FramePurpose
  SamplingRecord sampling; ///< of frames that are no picture
  uint32_t fog_offset, fog_count;
  uint32_t light_ways; ///< bits of light_way
  uint32_t rainbow_offset, rainbow_count;
  /// Share of what is behind the scene that comes through the background; counts with light_way::alpha, 1
  /// with light_way::no_backdrop.
  float background_clear;
};
static_assert(sizeof(FrameBlock) % 128 == 0 && sizeof(FrameBlock) <= 512, "fetched by one DMA command");

/// FrameBlock::work_entries of SYNCHRONIZE: all lines are out of date.
constexpr uint32_t kAllLines = 0xFFFFFFFF;
/// FrameBlock::units_per_word: every unit is told by its number, once its pixels are in main memory.
constexpr uint32_t kEachUnit = 0xFFFFFFFF;

/// A unit of work: bundles in a row of bundles from `column` on, and on in the next row where it ends.
struct alignas(8) UnitRecord {
  uint16_t column, row;
  uint32_t bundles;
};
static_assert(sizeof(UnitRecord) == 8, "sixteen units a line");

/// Units [begin, end) that an SPE starts a frame with.
struct alignas(16) StripRecord {
  uint32_t begin, end;
  uint32_t unused[2];
};
static_assert(sizeof(StripRecord) == 16, "crosses DMA");

/// What an SPE did in a frame.
struct alignas(128) ReportRecord {
  uint64_t primary_rays, shadow_rays, reflection_rays, refraction_rays;
  uint64_t tests[kMaxPrimitives];          ///< packet against object, by kind
  uint64_t accelerator_visits;             ///< voxels by rays, or nodes by beams
  uint64_t cache_hits[4], cache_misses[4]; ///< by DataKind
  uint64_t dropped_rays;                   ///< rays beyond the depth of the interior stack
  uint32_t packets;                        ///< rendered
  uint32_t exchanges;                      ///< balance exchanges that brought this SPE units
  uint32_t units_received;
  uint32_t busy_ticks; ///< of the decrementer, in which the SPE did not wait for work
  uint32_t spilled_nodes;
  uint32_t list_entries; ///< PREPARE FRAME
  uint64_t pixel_bytes;  ///< that left as pixels were traced
  uint64_t block_error;  ///< of pixels in blocks: squared differences, summed over red, green and blue
  uint32_t unused[26];
};
static_assert(sizeof(ReportRecord) == 384, "three lines");

/// Kinds of data that the cache counts separately.
enum class DataKind : uint32_t { list = 0, object = 1, material = 2, light = 3 };
constexpr uint32_t kDataKinds = 4;

// --- words between PPE and SPE ---

/// Bits of signal 1, PPE to SPE. The register is in logical-OR mode. Each but quit fetches the frame block
/// anew, so that a camera that moved needs no command of its own.
namespace command {
constexpr uint32_t prepare_frame = 0x1;
constexpr uint32_t render_frame = 0x2;
constexpr uint32_t synchronize = 0x4;
constexpr uint32_t quit = 0x8;
} // namespace command

/// Outbound mailbox, SPE to PPE: kind in the top four bits, a count below.
enum class ReportKind : uint32_t {
  prepared = 1, ///< count: 0
  needs_memory =
      2, ///< PREPARE FRAME ran out of room for pairs; the report's list_entries says how many there are
  progress = 3, ///< count: units completed in this frame so far
  idle = 4,     ///< as progress, and nothing left to do
  finished = 5, ///< left the frame; the report record is written
  synchronised = 6,
  unit = 7, ///< count: the number of a unit that is completed
};
constexpr uint32_t make_report(ReportKind kind, uint32_t count) {
  return (static_cast<uint32_t>(kind) << 28) | count;
}
constexpr ReportKind report_kind(uint32_t word) {
  return static_cast<ReportKind>(word >> 28);
}
constexpr uint32_t report_count(uint32_t word) {
  return word & 0x0FFFFFFFu;
}

} // namespace celltrace::kernel
