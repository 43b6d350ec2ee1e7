// The tables of items, and what their items do.
#pragma once

#include "pov/actions.hpp"
#include "pov/items.hpp"

namespace celltrace::pov {

std::vector<ItemWord> scene_items();
std::vector<ItemWord> setting_items();
void apply_setting(Session& session, const Item& item);

std::vector<ItemWord> finish_items();
std::vector<ItemWord> reflection_items();
std::vector<ItemWord> irid_items();
void apply(Session& session, FinishDefinition& finish, const Item& item);
void apply(Session& session, ReflectionDefinition& reflection, const Item& item);
/// Sets what irid { } says of a finish.
void apply(Session& session, Finish& finish, const Item& item);

/// Lists the parts of finishes and pigments that textures before version 3.0 have without a block around
/// them.
std::vector<ItemWord> old_texture_items();
TexturePtr with_old_item(Session& session, const TexturePtr& texture, const Item& item);

std::vector<ItemWord> interior_items();
void apply(Session& session, InteriorDefinition& interior, const Item& item);

std::vector<ItemWord> fog_items();
std::vector<ItemWord> rainbow_items();
std::vector<ItemWord> sky_sphere_items();
void apply(Session& session, FogDefinition& fog, const Item& item);
void apply(Session& session, RainbowDefinition& rainbow, const Item& item);
void apply(Session& session, SkySphereDefinition& sky, const Item& item);

std::vector<ItemWord> camera_items();
void apply(Session& session, CameraDefinition& camera, const Item& item);

std::vector<ItemWord> light_source_items();
std::vector<ItemWord> light_group_items();
std::vector<ItemWord> object_items();
/// Takes items of any of these three tables.
void apply(Session& session, ObjectDefinition& object, const Item& item);

struct PhotonsDefinition {
  bool is_target = false; ///< some are to be aimed at the object
};
std::vector<ItemWord> photons_items();
void apply(Session& session, PhotonsDefinition& photons, const Item& item);

std::vector<ItemWord> mesh2_items();
void apply(Session& session, Mesh2Definition& mesh, int row, std::vector<ListEntry> list,
           const Location& where);

std::vector<ItemWord> picture_items();
void apply(Session& session, WrittenPicture& picture, const Item& item);
std::vector<ItemWord> height_field_items();
std::vector<ItemWord> bicubic_patch_items();
void apply(Session& session, PatchDefinition& patch, const Item& item);

std::vector<ItemWord> pattern_items();
std::vector<ItemWord> pigment_items();
std::vector<ItemWord> normal_items();
std::vector<ItemWord> warp_items();
void apply(Session& session, PigmentDefinition& pigment, const Item& item);
void apply(Session& session, NormalDefinition& normal, const Item& item);
/// Returns the change that an item makes to any pattern.
PatternChange pattern_change(Session& session, const Item& item);
/// Tells `frequency` and `phase`, which belong to a normal's waves before version 3.0.
bool is_of_waves(const Item& item);

/// Makes the warp that its first item stands for; fails if that makes none.
SpaceStep warp_of(Session& session, const Item& item);
/// Sets what a later item says; fails if that means nothing to this warp.
void apply(Session& session, SpaceStep& warp, const Item& item);

} // namespace celltrace::pov
