// Collects what a scene places and sets, and makes the Scene of it.
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

  /// What textures start from and objects without one get: black, with the default finish, until #default
  /// changes it. It does not move with the objects that get it.
  TexturePtr default_texture = std::make_shared<TextureDefinition>();
  CameraDefinition default_camera;

  /// Puts an object into the scene: unions are taken apart unless they are inverse or clipped, meshes shared
  /// between their instances. A light source in CSG shines on everything and is no part of it. What is not
  /// supported is left out.
  void place(const ObjectPtr& object, const Location& where);

  /// An object of which only the inside counts, without meshes.
  std::shared_ptr<const Object> make_solid(const ObjectDefinition& object, const Location& where);

  /// The last camera is the scene's.
  void set_camera(std::shared_ptr<const CameraDefinition> camera) { camera_ = std::move(camera); }
  /// As if over black, for what it transmits, from version 3.7 on; before, without regard to that.
  void set_background(const Pigment& colour);
  /// The last one is the scene's.
  void set_sky_sphere(const SkySphereDefinition& sky, const Location& where);
  /// They add up.
  void add_fog(const FogDefinition& fog, const Location& where);
  /// As many are seen at once as there are.
  void add_rainbow(const RainbowDefinition& rainbow, const Location& where);
  void set_ambient_light(const Vec3& rgb) { scene_.ambient_light = rgb; }
  void set_max_trace_level(int level) { scene_.max_trace_level = level; }
  void set_noise_generator(int number) { noise_generator_ = number; }
  /// As it is by now.
  int noise_generator() const;
  void set_number_of_waves(int number) { scene_.number_of_waves = number; }
  void set_irid_wavelength(const Vec3& rgb) { scene_.irid_wavelength = rgb; }
  void set_adc_bailout(double weight) { scene_.adc_bailout = weight; }
  /// Without a value: `assumed_gamma srgb`.
  void set_assumed_gamma(std::optional<double> gamma);
  bool gamma_is_given() const { return gamma_given_; }
  /// A channel of a colour in sRGB as the scene's colours have it.
  double from_srgb(double channel) const;
  /// What there is to say about photons. They matter if any object is a target.
  void set_photons(UnsupportedPtr photons) { photons_ = std::move(photons); }
  void set_version(double version);
  /// What `version` says: 3.7 until #version changes it.
  double version() const { return version_.value_or(3.7); }
  /// Whether it is less than this one. POV-Ray counts in hundredths.
  bool is_before(double version) const;
  /// Whether a sign starts a number of its own where no parentheses are around it, as before version 1.5.
  bool has_old_signs() const { return has_old_signs_; }
  /// Whether textures may have the parts of pigments, normals and finishes, as before version 3.0.
  bool has_old_textures() const { return has_old_textures_; }

  /// As it was declared, whether it has been placed or not.
  const Mesh& mesh_of(const std::shared_ptr<MeshDefinition>& definition) const;
  /// Counts towards the limit on triangles.
  void count_triangles(std::size_t count, const Location& where);

  /// The finished scene; call once.
  Scene finish(const std::string& name);

private:
  // placement.cpp: from objects as declared to the Scene's

  /// What an object takes from the CSG around it.
  struct Inherited {
    Transform transform; ///< to the scene
    TexturePtr texture;
    Transform texture_transform;  ///< to the scene
    bool uv_mapping = false;      ///< all textures are on surface coordinates
    bool has_cut_texture = false; ///< the texture is Compound::cut_texture
    bool is_taken_away = false;   ///< from what has that
    Index interior = kNoIndex;
    Index csg_interior = kNoIndex; ///< of the parts that have or inherit none
    bool no_shadow = false;
    bool no_image = false;
    bool no_reflection = false;
    bool is_lit_through = false;
    bool hollow = false;
    TexturePtr inner_texture;     ///< what it looks like from inside; null: the same
    Transform inner_transform;    ///< to the scene
    bool is_part = false;         ///< placed in the space of a CSG, not of the scene
    bool clips = false;           ///< only its inside matters
    NameId name = kNoName;        ///< of the innermost object around it that has one
    int depth = 0;                ///< CSG and clipping around it
    Index light_group = kNoIndex; ///< whose lights shine on it
    bool is_copy = false;         ///< it is part of an object that has a name
    const char* inside = nullptr; ///< in what its inside counts, for messages; null: it does not
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
  /// As one of the scene's, or several.
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
  std::shared_ptr<const Mesh> placed_mesh(const std::shared_ptr<MeshDefinition>& definition,
                                          const Transform& transform, bool uv_mapping, const Location& where);
  std::shared_ptr<const Mesh> with_inside(const std::shared_ptr<const Mesh>& mesh,
                                          std::shared_ptr<const Material> inside, const Location& where);

  /// A texture that depends on where it is.
  struct PlacedTexture {
    TexturePtr texture;
    Transform transform;
    bool operator<(const PlacedTexture& other) const;
  };

  void settle_gamma();
  void show_background(const Location& where);
  /// Empties the scene.
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
  std::map<PlacedTexture, TexturePtr> mapped_textures_; ///< on surface coordinates
  std::unordered_map<TexturePtr, std::shared_ptr<const Material>> shared_materials_; ///< layers and entries
  std::unordered_map<std::shared_ptr<MeshDefinition>, std::shared_ptr<const Mesh>> meshes_;
  /// Copies of meshes whose triangles have textures of their own, for objects with an interior_texture.
  std::map<std::pair<std::shared_ptr<const Mesh>, std::shared_ptr<const Material>>,
           std::shared_ptr<const Mesh>>
      meshes_with_insides_;
};

} // namespace celltrace::pov
