// SceneBuilder: from textures and interiors as declared to the Scene's materials.
#include <cstring>

#include "pov/scene_builder.hpp"
#include "pov/scene_room.hpp"

namespace celltrace::pov {

/// The object's own interior, else the inherited one. POV-Ray 3.1's ior of a finish makes one where there is
/// none and changes the one there is, even if it is inherited.
Index SceneBuilder::interior_index(const ObjectDefinition& object, Index inherited,
                                   const TextureDefinition& texture, const Location& where) {
  const FinishDefinition& finish = texture.finish;
  Index index = inherited;
  if (object.interior) {
    const InteriorDefinition& interior = *object.interior;
    diagnostics_.supports(interior.unsupported, where);
    Interior made;
    made.ior = interior.ior;
    made.fade_distance = interior.fade_distance;
    made.fade_power = interior.fade_power;
    made.fade_colour = interior.fade_colour;
    made.caustics = interior.caustics;
    index = scene_.add(made);
  }
  if (finish.ior || finish.caustics || finish.fade_distance || finish.fade_power) {
    if (index == kNoIndex) index = scene_.add(Interior{});
    Interior& made = scene_.interiors[index];
    made.ior = finish.ior.value_or(made.ior);
    constexpr double kInteriorsUnit = 45; // as in POV-Ray
    if (finish.caustics) made.caustics = *finish.caustics / kInteriorsUnit;
    made.fade_distance = finish.fade_distance.value_or(made.fade_distance);
    made.fade_power = finish.fade_power.value_or(made.fade_power);
  }
  // Unlike those, it is always said, but a pattern of textures has no finish.
  if (!texture.map) {
    if (index == kNoIndex && finish.refraction != 1) index = scene_.add(Interior{});
    if (index != kNoIndex) scene_.interiors[index].refraction = finish.refraction;
  }
  return index;
}

bool SceneBuilder::PlacedTexture::operator<(const PlacedTexture& other) const {
  if (texture != other.texture) return texture < other.texture;
  return std::memcmp(&transform, &other.transform, sizeof transform) < 0;
}

/// A texture on surface coordinates, after it has been moved.
TexturePtr SceneBuilder::mapped_texture(const TexturePtr& texture, const Transform& transform) {
  const bool is_constant = texture->is_constant();
  const PlacedTexture placed =
      is_constant ? PlacedTexture{original(texture), Transform()} : PlacedTexture{texture, transform};
  const auto [known, is_new] = mapped_textures_.try_emplace(placed);
  if (is_new) known->second = on_surface(transformed(placed.texture, placed.transform));
  return known->second;
}

Index SceneBuilder::material_index(const TexturePtr& texture, const Transform& transform,
                                   const Location& where) {
  if (texture->is_constant()) {
    Index& known = original(texture)->built.index;
    if (known == kNoIndex) known = add_material(*texture, where);
    return known;
  }
  const auto [known, is_new] = placed_material_indices_.try_emplace(PlacedTexture{texture, transform});
  if (is_new) known->second = add_material(*transformed(texture, transform), where);
  return known->second;
}

Index SceneBuilder::add_material(const TextureDefinition& texture, const Location& where) {
  Material material = make_material(texture, where);
  make_room(scene_.materials, tokens_);
  scene_.materials.push_back(std::move(material));
  return static_cast<Index>(scene_.materials.size() - 1);
}

Material SceneBuilder::make_material(const TextureDefinition& texture, const Location& where) {
  diagnostics_.supports(texture.first_unsupported(), where);
  Material material;
  if (texture.normal && texture.normal->is_undefined) return material;
  if (texture.map) {
    auto map = std::make_shared<PatternMap<Material>>();
    map->pattern = texture.pattern.value();
    map->is_average = texture.pattern.is_average();
    for (const auto& [position, entry] : texture.map->entries)
      map->entries.push_back({position, *shared_material(entry, where)});
    check_pattern(map->pattern, map->entries.size(), where);
    material.map = std::move(map);
    return material;
  }
  material.pigment = texture.pigment.finish();
  if (const auto& map = material.pigment.map) check_pattern(map->pattern, map->entries.size(), where);
  material.finish = texture.finish->value;
  if (texture.normal && !texture.normal->is_smooth()) {
    material.normal = std::make_shared<const Normal>(texture.normal->finish());
    const auto& map = material.normal->map;
    check_pattern(map ? map->pattern : material.normal->pattern, map ? map->entries.size() : 0, where);
  }
  if (texture.below) material.below = shared_material(texture.below, where);
  return material;
}

std::shared_ptr<const Material> SceneBuilder::shared_material(const TexturePtr& texture,
                                                              const Location& where) {
  const TexturePtr& key = original(texture);
  if (const auto known = shared_materials_.find(key); known != shared_materials_.end()) return known->second;
  return shared_materials_[key] = std::make_shared<const Material>(make_material(*texture, where));
}

/// Every place of a texture with maps has its own copy of them, and its own transformations.
void SceneBuilder::check_pattern(const Pattern& pattern, std::size_t entries, const Location& where) {
  for (const SpaceStep& step : pattern.space)
    if (const auto* transform = std::get_if<Transform>(&step); transform && is_singular(*transform))
      diagnostics_.fail(where, "the transformation of this object's texture is singular: it has no inverse");
  map_entries_ += entries;
  if (map_entries_ > limits_.map_entries)
    diagnostics_.exceed(where, &ParseLimits::map_entries, "the maps of all textures have", "entries");
}

} // namespace celltrace::pov
