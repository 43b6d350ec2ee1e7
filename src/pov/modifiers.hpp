// What can stand in most blocks besides what they consist of: items, transformations, warps of patterns and
// what is not supported.
#pragma once

#include <variant>

#include "pov/item_tables.hpp"

namespace celltrace::pov {

struct Modifier {
  std::variant<Item, PatternChange, Transform, UnsupportedPtr> what; ///< PatternChange: a warp
  Location where;
};

// Each does what a modifier says.
void modify(Session& session, PigmentDefinition& pigment, const Modifier& modifier);
void modify(Session& session, NormalDefinition& normal, const Modifier& modifier);
void modify(Session& session, FinishDefinition& finish, const Modifier& modifier);
void modify(Session& session, InteriorDefinition& interior, const Modifier& modifier);
void modify(Session& session, MaterialDefinition& material, const Modifier& modifier);
void modify(Session& session, FogDefinition& fog, const Modifier& modifier);
void modify(Session& session, RainbowDefinition& rainbow, const Modifier& modifier);
void modify(Session& session, SkySphereDefinition& sky, const Modifier& modifier);
void modify(Session& session, CameraDefinition& camera, const Modifier& modifier);
void modify(Session& session, ObjectDefinition& object, const Modifier& modifier);
void modify_light(Session& session, ObjectDefinition& light, const Modifier& modifier);
/// Of global_settings.
void modify_settings(Session& session, const Modifier& modifier);
TexturePtr modified(Session& session, const TexturePtr& texture, const Modifier& modifier);
/// The same before version 3.0.
TexturePtr modified_old(Session& session, const TexturePtr& texture, const Modifier& modifier);

} // namespace celltrace::pov
