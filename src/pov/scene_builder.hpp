// Collects the objects and settings of a scene, and builds the Scene.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "celltrace/pov.hpp"
#include "pov/camera.hpp"
#include "pov/diagnostics.hpp"
#include "pov/object.hpp"
#include "pov/origins.hpp"

namespace celltrace::pov {

class TokenStream;

class SceneBuilder {
public:
  SceneBuilder(const ParseLimits& limits, Diagnostics& diagnostics, TokenStream& tokens,
               const Origins& origins)
      : limits_(limits), diagnostics_(diagnostics), tokens_(tokens), origins_(origins) {}

  /// The texture that others start from, and that objects without one get: black, with the default finish,
  /// until #default changes it. The default texture does not move with these objects.
  TexturePtr default_texture = std::make_shared<TextureDefinition>();
  CameraDefinition default_camera;

  /// Places an object in the scene: unions are taken apart unless they are inverse or clipped, and instances
  /// share their mesh. A light source in CSG shines on everything and is no part of the CSG. Unsupported
  /// objects are left out.
  void place(const ObjectPtr& object, const Location& where);

  /// Returns an object of which only the inside matters, without meshes.
  std::shared_ptr<const Object> make_solid(const ObjectDefinition& object, const Location& where);

  /// Sets the camera; the last one is the scene's.
  void set_camera(std::shared_ptr<const CameraDefinition> camera) { camera_ = std::move(camera); }
  /// Sets the background. From version 3.7 on, it covers black as far as it does not transmit; before,
  /// transmit is ignored.
  void set_background(const Pigment& colour);
  /// Sets the sky sphere; the last one is the scene's.
  void set_sky_sphere(const SkySphereDefinition& sky, const Location& where);
  /// Adds a fog; all fogs count together.
  void add_fog(const FogDefinition& fog, const Location& where);
  /// Adds a rainbow; all rainbows are visible at once.
  void add_rainbow(const RainbowDefinition& rainbow, const Location& where);
  void set_ambient_light(const Vec3& rgb) { scene_.ambient_light = rgb; }
  void set_max_trace_level(int level) { scene_.max_trace_level = level; }
  void set_noise_generator(int number) { noise_generator_ = number; }
  /// Returns the current noise generator.
  int noise_generator() const;
  void set_number_of_waves(int number) { scene_.number_of_waves = number; }
  void set_irid_wavelength(const Vec3& rgb) { scene_.irid_wavelength = rgb; }
  void set_adc_bailout(double weight) { scene_.adc_bailout = weight; }
  /// Sets the gamma; without a value, `assumed_gamma srgb`.
  void set_assumed_gamma(std::optional<double> gamma);
  bool gamma_is_given() const { return gamma_given_; }
  /// Returns the exponent of the working space: 1 if colours are linear, 2.2 for `assumed_gamma srgb`.
  double working_gamma() const { return scene_.gamma_mode == GammaMode::srgb ? 2.2 : scene_.assumed_gamma; }
  /// Converts a channel of an sRGB colour to the space of the scene's colours.
  double from_srgb(double channel) const;
  /// Sets the mark for photons, which matter if any object is a target.
  void set_photons(UnsupportedPtr photons) { photons_ = std::move(photons); }
  void set_version(double version);
  /// Returns the value of `version`: 3.7 until #version changes it.
  double version() const { return version_.value_or(3.7); }
  /// Returns whether the version is less than this one. POV-Ray compares hundredths.
  bool is_before(double version) const;
  /// Returns whether a sign outside of parentheses starts a new number, as before version 1.5.
  bool has_old_signs() const { return has_old_signs_; }
  /// Returns whether textures may contain the parts of pigments, normals and finishes, as before version 3.0.
  bool has_old_textures() const { return has_old_textures_; }

  /// Returns a mesh as it was declared, whether it has been placed or not.
  const Mesh& mesh_of(const std::shared_ptr<MeshDefinition>& definition) const;
  /// Counts triangles towards their limit.
  void count_triangles(std::size_t count, const Location& where);

  /// Returns the finished scene; call once.
  Scene finish(const std::string& name);

private:
  // placement.cpp: from objects as declared to the Scene's

  /// Properties that an object inherits from the CSG around it.
  struct Inherited {
    Transform transform; ///< to the scene
    TexturePtr texture;
    Transform texture_transform;  ///< to the scene
    bool uv_mapping = false;      ///< all textures are on surface coordinates
    bool has_cut_texture = false; ///< `texture` is Compound::cut_texture
    bool is_subtracted = false;   ///< is subtracted from objects with the cut texture
    Index interior = kNoIndex;
    Index csg_interior = kNoIndex; ///< interior of parts that neither have nor inherit one
    bool no_shadow = false;
    bool no_image = false;
    bool no_reflection = false;
    bool is_lit_through = false;
    bool hollow = false;
    TexturePtr inner_texture;     ///< texture of the inside; null: that of the outside
    Transform inner_transform;    ///< to the scene
    bool is_part = false;         ///< placed in the space of a CSG, not in that of the scene
    bool clips = false;           ///< only its inside matters
    NameId name = kNoName;        ///< name of the innermost named object around it
    int depth = 0;                ///< levels of CSG and clipping around it
    Index light_group = kNoIndex; ///< the group whose lights shine on it
    bool is_copy = false;         ///< is part of a named object
    const char* inside = nullptr; ///< name, for messages, of the feature that uses its inside; null: none
  };
  void place(const ObjectDefinition& object, const Inherited& around, const Location& where);
  [[noreturn]] void exceed_objects(const Location& where) const;
  Inherited inherit(const ObjectDefinition& object, const Inherited& around, const Location& where);
  std::optional<Object> make(const ObjectDefinition& object, const Inherited& around, const Location& where);
  bool make_shape(const ObjectDefinition& object, const Inherited& own, Object& made, const Location& where);
  std::shared_ptr<const Csg> make_csg(const Compound& compound, Inherited own, const Location& where);
  std::shared_ptr<const std::vector<Object>> make_clips(const ObjectDefinition& object,
                                                        const Inherited& around, const Location& where);
  void enter_solid(Inherited& own, const Location& where) const;
  void enter_light_group(const Compound& group, Inherited& own, const Location& where);
  Index add_light_group(const LightGroup& group, const Location& where);
  std::shared_ptr<const Object> make_projector(const ObjectDefinition& projector, Inherited around,
                                               const Location& where);
  void collect(const ObjectDefinition& object, const Inherited& around, const Location& where,
               std::vector<Object>& objects);
  /// Adds a light to the scene, or several, and returns their indices.
  std::vector<Index> add_light(const LightDefinition& definition, const Inherited& own,
                               const Location& where);
  void place_look(const LightDefinition& definition, Inherited own, const Location& where);
  void warn_of_size(const ObjectDefinition& object);
  void refuse(const std::string& what, const ObjectDefinition& object, const Location& where);
  Index interior_of(const Inherited& own);
  Index add_interior();
  Index interior_index(const ObjectDefinition& object, Index inherited, const TextureDefinition& texture,
                       const Location& where);
  TexturePtr mapped_texture(const TexturePtr& texture, const Transform& transform);
  Index material_index(const TexturePtr& texture, const Transform& transform, const Location& where);
  Index add_material(const TextureDefinition& texture, const Location& where);
  Material make_material(const TextureDefinition& texture, const Location& where);
  std::shared_ptr<const Material> shared_material(const TexturePtr& texture, const Location& where);
  void check_pattern(const Pattern& pattern, std::size_t entries, const Location& where);
  std::shared_ptr<const Mesh> placed_triangle(const TriangleDefinition& triangle, const Inherited& own,
                                              const Location& where, Vec3& base);
  std::shared_ptr<const Mesh> placed_patch(const BicubicPatch& patch, const Transform& transform,
                                           const Location& where);
  std::shared_ptr<const Mesh> placed_mesh(const std::shared_ptr<MeshDefinition>& definition,
                                          const Transform& transform, bool uv_mapping, const Location& where);
  std::shared_ptr<const Mesh> with_inside(const std::shared_ptr<const Mesh>& mesh,
                                          std::shared_ptr<const Material> inside, const Location& where);

  /// A texture at a place, on which it depends.
  struct PlacedTexture {
    TexturePtr texture;
    Transform transform;
    bool operator<(const PlacedTexture& other) const;
  };

  void resolve_gamma();
  void show_background(const Location& where);
  /// Removes objects, sky, fogs and rainbows, which leaves the background.
  void leave_background();

  const ParseLimits& limits_;
  Diagnostics& diagnostics_;
  TokenStream& tokens_;
  const Origins& origins_;
  Scene scene_;
  std::shared_ptr<const CameraDefinition> camera_;
  std::optional<double> version_;
  bool has_old_signs_ = false, has_old_textures_ = false;
  bool gamma_given_ = false;
  UnsupportedPtr photons_;
  bool has_photon_targets_ = false;
  std::uint64_t parts_placed_ = 0;
  std::uint64_t triangles_ = 0;
  std::optional<int> noise_generator_;
  std::uint64_t map_entries_ = 0;
  std::map<PlacedTexture, Index> placed_material_indices_;
  std::map<PlacedTexture, TexturePtr> mapped_textures_; ///< textures on surface coordinates
  std::unordered_map<TexturePtr, std::shared_ptr<const Material>>
      shared_materials_; ///< layers and map entries
  std::unordered_map<std::shared_ptr<MeshDefinition>, std::shared_ptr<const Mesh>> meshes_;
  /// Copies of meshes whose triangles have textures of their own, for objects with an interior_texture.
  std::map<std::pair<std::shared_ptr<const Mesh>, std::shared_ptr<const Material>>,
           std::shared_ptr<const Mesh>>
      meshes_with_insides_;
};

} // namespace celltrace::pov
