// Surfaces and insides as a scene declares them: pigments, normals, finishes, textures, interiors, materials,
// and the maps that patterns make of them.
//
// Features of POV-Ray that this program lacks are kept, marked as unsupported; they become an error only if
// an object uses them.
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
/// A shared texture. Equal pointers become one material, so that a texture that is only referred to is not
/// copied.
using TexturePtr = std::shared_ptr<const TextureDefinition>;

/// The entries of a map or of a pattern's list: colours, pigments, normals or textures.
template <class T> struct MapDefinition {
  std::vector<typename PatternMap<T>::Entry> entries;
  int depth = 1;                   ///< levels of nested maps
  bool is_opaque = true;           ///< no entry lets light through
  bool depends_on_surface = false; ///< some entry depends on more of a surface than points
  UnsupportedPtr unsupported;      ///< first unsupported feature in any entry
};
using PigmentMap = MapDefinition<Pigment>;
using NormalMap = MapDefinition<Normal>;
using TextureMap = MapDefinition<TexturePtr>;
using PigmentMapPtr = std::shared_ptr<const PigmentMap>;
using NormalMapPtr = std::shared_ptr<const NormalMap>;
using TextureMapPtr = std::shared_ptr<const TextureMap>;
using SlopeMapPtr = std::shared_ptr<const std::vector<SlopePoint>>;

struct PigmentDefinition {
  Pigment value; ///< pigment without a map, used if there is no pattern
  PatternDefinition pattern;
  PigmentMapPtr map;                   ///< null: the pattern's own colours
  std::optional<Pigment> quick_colour; ///< replaces everything else if the quality is low enough
  bool uv_mapping = false; ///< true while the pigment is read: it will be put on surface coordinates
  UnsupportedPtr unsupported;
  [[no_unique_address]] Counted<PigmentDefinition> counted;

  UnsupportedPtr first_unsupported() const;
  int depth() const {
    return !pattern.exists() ? 0 : std::max(map ? map->depth : 1, 1 + pattern.inner_depth);
  }
  /// Returns whether the pigment lets no light through.
  bool is_opaque() const;
  /// Returns whether the pigment, or something in its map, is on surface coordinates, or a slope.
  bool depends_on_surface() const;
  Pigment finish() const;
};
using PigmentPtr = std::shared_ptr<const PigmentDefinition>;

struct NormalDefinition {
  PatternDefinition pattern; ///< none: the surface is smooth
  double amount = 0.5;
  double accuracy = 0.02;
  std::vector<SlopePoint> slopes; ///< slope map; empty: the pattern's own values
  NormalMapPtr map;               ///< null: the pattern's own slopes
  bool uv_mapping = false;        ///< as PigmentDefinition::uv_mapping
  bool is_undefined = false;      ///< true: makes its surface black
  UnsupportedPtr unsupported;
  [[no_unique_address]] Counted<NormalDefinition> counted;

  UnsupportedPtr first_unsupported() const;
  bool depends_on_surface() const;
  int depth() const { return map ? std::max(map->depth, 1 + pattern.inner_depth) : pattern.inner_depth; }
  bool is_smooth() const { return !pattern.exists(); }
  Normal finish() const;
};
using NormalPtr = std::shared_ptr<const NormalDefinition>;

struct FinishDefinition {
  Finish value;
  // Properties that POV-Ray 3.1 had in finishes: they become the interior's.
  std::optional<double> ior, caustics, fade_distance, fade_power;
  double refraction = 1;
  bool diffuse_is_albedo = false, phong_is_albedo = false,
       specular_is_albedo = false; ///< until the finish is complete
  UnsupportedPtr unsupported;
  [[no_unique_address]] Counted<FinishDefinition> counted;
};
using FinishPtr = std::shared_ptr<const FinishDefinition>;

/// Another texture that a texture looks like. Copies, which are made to be changed, have none.
struct Original {
  TexturePtr texture;

  Original() = default;
  Original(const Original&) {}
  Original& operator=(const Original&) {
    texture = nullptr;
    return *this;
  }
};

/// The scene's material that a texture has become, set by the scene's builder. A copy starts without one.
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
  NormalPtr normal; ///< null: smooth; any other smooth normal is kept as the start of later normals
  SharedValue<FinishDefinition> finish;
  TexturePtr below;          ///< the layer under this one
  int layers = 1;            ///< number of layers, with those below
  PatternDefinition pattern; ///< if it exists, the texture map replaces all members above
  TextureMapPtr map;
  bool uv_mapping = false;    ///< as PigmentDefinition::uv_mapping
  bool is_on_surface = false; ///< true: all layers are on surface coordinates, so that transformations turn
                              ///< nothing but normals
  BuiltMaterial built;        ///< material of a texture that is the same everywhere
  Original original;          ///< for a texture that is the same everywhere and has only been moved
  UnsupportedPtr unsupported;
  [[no_unique_address]] Counted<TextureDefinition> counted;

  UnsupportedPtr first_unsupported() const;
  int depth() const { return map ? std::max(map->depth, 1 + pattern.inner_depth) : 0; }
  /// Returns whether the texture lets no light through, so that a layer below does not matter.
  bool is_opaque() const;
  /// Returns whether the texture depends on more of a surface than points.
  bool depends_on_surface() const;
  /// Returns whether the texture is the same everywhere in space.
  bool is_constant() const;
  /// Returns whether the texture has a pigment, normal and finish that can be changed, and can be a layer.
  bool is_plain() const { return !pattern.exists() && !is_on_surface; }
};

TexturePtr with_pigment(const TexturePtr& texture, const PigmentDefinition& pigment);
TexturePtr with_normal(const TexturePtr& texture, const NormalPtr& normal);
TexturePtr with_finish(const TexturePtr& texture, const FinishDefinition& finish);
TexturePtr with_unsupported(const TexturePtr& texture, const UnsupportedPtr& unsupported);
TexturePtr with_uv_mapping(const TexturePtr& texture);
/// Puts what has been read on surface coordinates if uv_mapping is set.
void finish_uv_mapping(PigmentDefinition& pigment);
void finish_uv_mapping(NormalDefinition& normal);
TexturePtr with_finished_uv_mapping(const TexturePtr& texture);
/// Returns the texture with all its layers on surface coordinates.
TexturePtr on_surface(const TexturePtr& texture);
/// Returns the texture with all its layers moved. A pigment or normal without a pattern is moved, too: as in
/// POV-Ray, a pattern that it gets later is moved as well.
TexturePtr transformed(const TexturePtr& texture, const Transform& next);
/// Returns `top` as a layer on `below`, or `top` alone if it is opaque or `below` is null. Neither may have a
/// pattern of textures.
TexturePtr layered(const TexturePtr& below, const TexturePtr& top);
/// Returns the texture that `texture` was moved from if it is the same everywhere, since both have the same
/// material; otherwise `texture` itself.
const TexturePtr& original(const TexturePtr& texture);

/// Returns the texture with its layers transmitting what they filter: all layers but the lowest one, or all.
TexturePtr with_filter_as_transmit(const TexturePtr& texture, bool also_lowest);

struct SkySphereDefinition {
  std::vector<PigmentDefinition> pigments; ///< the last one is on top
  Vec3 emission{1, 1, 1};                  ///< factors of their colours, not applied to filter
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
  TexturePtr texture; ///< null: not given
  TexturePtr inside;  ///< null: not given
  InteriorPtr interior;
  UnsupportedPtr unsupported;
};

} // namespace celltrace::pov
