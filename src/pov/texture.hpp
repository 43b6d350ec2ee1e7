// What a scene says about surfaces and insides, as declared: pigments, normals, finishes, textures,
// interiors, materials, and the maps that patterns make of them.
//
// What POV-Ray has and this program lacks is kept, marked as unsupported, and only an error where an object
// uses it.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "celltrace/scene.hpp"
#include "pov/heap_value.hpp"
#include "pov/location.hpp"
#include "pov/memory.hpp"
#include "pov/patterns.hpp"
#include "pov/unsupported.hpp"

namespace celltrace::pov {

struct TextureDefinition;
/// Equal pointers make equal materials: a texture that is only referred to is not copied.
using TexturePtr = std::shared_ptr<const TextureDefinition>;

/// The entries of a map or of a pattern's list, of colours, pigments, normals or textures.
template <class T> struct MapDefinition {
  std::vector<typename PatternMap<T>::Entry> entries;
  int depth = 1;                 ///< of maps inside one another
  bool is_opaque = true;         ///< nothing shines through any entry
  bool asks_for_surface = false; ///< some entry depends on more of a surface than points
  UnsupportedPtr unsupported;    ///< the first in any entry
};
using PigmentMap = MapDefinition<Pigment>;
using NormalMap = MapDefinition<Normal>;
using TextureMap = MapDefinition<TexturePtr>;
using PigmentMapPtr = std::shared_ptr<const PigmentMap>;
using NormalMapPtr = std::shared_ptr<const NormalMap>;
using TextureMapPtr = std::shared_ptr<const TextureMap>;
using SlopeMapPtr = std::shared_ptr<const std::vector<SlopePoint>>;

struct PigmentDefinition {
  Pigment value; ///< of one without a pattern; it has no map
  PatternDefinition pattern;
  PigmentMapPtr map;                   ///< null: the pattern's own colours
  std::optional<Pigment> quick_colour; ///< instead of all that, where quality is low enough for it
  bool uv_mapping = false;             ///< while it is read: it will be put on surface coordinates
  UnsupportedPtr unsupported;
  [[no_unique_address]] Counted<PigmentDefinition> counted;

  UnsupportedPtr first_unsupported() const;
  int depth() const {
    return !pattern.exists() ? 0 : std::max(map ? map->depth : 1, 1 + pattern.inner_depth);
  }
  /// Nothing shines through.
  bool is_opaque() const;
  /// It, or something in its map, is on surface coordinates, or a slope.
  bool asks_for_surface() const;
  Pigment finish() const;
};
using PigmentPtr = std::shared_ptr<const PigmentDefinition>;

struct NormalDefinition {
  PatternDefinition pattern; ///< without one it is smooth
  double amount = 0.5;
  double accuracy = 0.02;
  std::vector<SlopePoint> slopes; ///< empty: the pattern's numbers
  NormalMapPtr map;               ///< null: the pattern's own slopes
  bool uv_mapping = false;        ///< as a pigment's
  bool is_undefined = false;      ///< what has it is black
  UnsupportedPtr unsupported;
  [[no_unique_address]] Counted<NormalDefinition> counted;

  UnsupportedPtr first_unsupported() const;
  bool asks_for_surface() const;
  int depth() const { return map ? std::max(map->depth, 1 + pattern.inner_depth) : pattern.inner_depth; }
  bool is_smooth() const { return !pattern.exists(); }
  Normal finish() const;
};
using NormalPtr = std::shared_ptr<const NormalDefinition>;

struct FinishDefinition {
  Finish value;
  // POV-Ray 3.1 had these here: they become the interior's.
  std::optional<double> ior, caustics, fade_distance, fade_power;
  double refraction = 1;
  bool diffuse_is_albedo = false, phong_is_albedo = false,
       specular_is_albedo = false; ///< until it is complete
  UnsupportedPtr unsupported;
  [[no_unique_address]] Counted<FinishDefinition> counted;
};
using FinishPtr = std::shared_ptr<const FinishDefinition>;

/// Another texture that a texture looks like. A copy, which is made to be changed, has none.
struct Original {
  TexturePtr texture;

  Original() = default;
  Original(const Original&) {}
  Original& operator=(const Original&) {
    texture = nullptr;
    return *this;
  }
};

/// The scene's material that a texture has become, for the scene's builder. A copy has become none yet.
struct BuiltMaterial {
  mutable Index index = kNoIndex;

  BuiltMaterial() = default;
  BuiltMaterial(const BuiltMaterial&) {}
  BuiltMaterial& operator=(const BuiltMaterial&) {
    index = kNoIndex;
    return *this;
  }
};

struct TextureDefinition {
  PigmentDefinition pigment;
  NormalPtr normal; ///< null: smooth; a smooth one is what later normals start from
  SharedValue<FinishDefinition> finish;
  TexturePtr below;          ///< the layer under this one
  int layers = 1;            ///< with those below
  PatternDefinition pattern; ///< if there is one, the map is instead of all of the above
  TextureMapPtr map;
  bool uv_mapping = false;    ///< as a pigment's
  bool is_on_surface = false; ///< all of it is on surface coordinates, and only its normals turn any more
  BuiltMaterial built;        ///< of one that is the same everywhere
  Original original;          ///< of one that is the same everywhere and has only been moved
  UnsupportedPtr unsupported;
  [[no_unique_address]] Counted<TextureDefinition> counted;

  UnsupportedPtr first_unsupported() const;
  int depth() const { return map ? std::max(map->depth, 1 + pattern.inner_depth) : 0; }
  /// Nothing shines through, so that a layer below does not matter.
  bool is_opaque() const;
  /// As a pigment's.
  bool asks_for_surface() const;
  /// Whether it matters where in space it is.
  bool is_constant() const;
  /// Whether it has a pigment, normal and finish that can be changed, and can be a layer.
  bool is_plain() const { return !pattern.exists() && !is_on_surface; }
};

TexturePtr with_pigment(const TexturePtr& texture, const PigmentDefinition& pigment);
TexturePtr with_normal(const TexturePtr& texture, const NormalPtr& normal);
TexturePtr with_finish(const TexturePtr& texture, const FinishDefinition& finish);
TexturePtr with_unsupported(const TexturePtr& texture, const UnsupportedPtr& unsupported);
TexturePtr with_uv_mapping(const TexturePtr& texture);
/// Puts what is read on surface coordinates if it is to be.
void finish_uv_mapping(PigmentDefinition& pigment);
void finish_uv_mapping(NormalDefinition& normal);
TexturePtr with_finished_uv_mapping(const TexturePtr& texture);
/// The texture with all its layers on surface coordinates.
TexturePtr on_surface(const TexturePtr& texture);
/// The texture with all its layers moved. A pigment or normal without a pattern is moved, too: as in POV-Ray,
/// a pattern that it gets later finds it moved.
TexturePtr transformed(const TexturePtr& texture, const Transform& next);
/// `top` on `below` (null: nothing), neither of them with a pattern of textures: the top alone if it is
/// opaque.
TexturePtr layered(const TexturePtr& below, const TexturePtr& top);
/// The texture that has the same material: another one where that has only been moved, and is the same
/// everywhere.
const TexturePtr& original(const TexturePtr& texture);

/// The texture with what its layers filter transmitted instead: of all but the lowest one, or of that, too.
TexturePtr with_filter_as_transmit(const TexturePtr& texture, bool also_lowest);

struct SkySphereDefinition {
  std::vector<PigmentDefinition> pigments; ///< the last one is on top
  Vec3 emission{1, 1, 1};                  ///< what their colours count, but not as filters
  Location emission_where;
  UnsupportedPtr unsupported;
};
using SkySpherePtr = std::shared_ptr<const SkySphereDefinition>;

struct FogDefinition {
  Fog value;
  UnsupportedPtr unsupported;
};
using FogPtr = std::shared_ptr<const FogDefinition>;

struct RainbowDefinition {
  Rainbow value;
  UnsupportedPtr unsupported;
};
using RainbowPtr = std::shared_ptr<const RainbowDefinition>;

struct InteriorDefinition {
  double ior = 1;
  double fade_distance = 0;
  double fade_power = 0;
  Vec3 fade_colour{0, 0, 0};
  double caustics = 0;
  UnsupportedPtr unsupported;
};
using InteriorPtr = std::shared_ptr<const InteriorDefinition>;

struct MaterialDefinition {
  TexturePtr texture; ///< null: none given
  TexturePtr inside;  ///< likewise
  InteriorPtr interior;
  UnsupportedPtr unsupported;
};

} // namespace celltrace::pov
