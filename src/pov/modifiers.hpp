// Modifiers, which stand in most blocks: items, transformations, warps of patterns, and words for features
// that are not supported.
#pragma once

#include <variant>

#include "pov/item_tables.hpp"

namespace celltrace::pov {

/// A modifier as it was read; a PatternChange is a warp.
using Modifier = std::variant<Item, PatternChange, Transform, UnsupportedPtr>;

// Apply a modifier.
void modify(Session& session, PigmentDefinition& pigment, const Modifier& modifier, const Location& where);
void modify(Session& session, NormalDefinition& normal, const Modifier& modifier, const Location& where);
void modify(Session& session, FinishDefinition& finish, const Modifier& modifier, const Location& where);
void modify(Session& session, InteriorDefinition& interior, const Modifier& modifier, const Location& where);
void modify(Session& session, MaterialDefinition& material, const Modifier& modifier, const Location& where);
void modify(Session& session, FogDefinition& fog, const Modifier& modifier, const Location& where);
void modify(Session& session, RainbowDefinition& rainbow, const Modifier& modifier, const Location& where);
void modify(Session& session, SkySphereDefinition& sky, const Modifier& modifier, const Location& where);
void modify(Session& session, CameraDefinition& camera, const Modifier& modifier, const Location& where);
void modify(Session& session, ObjectDefinition& object, const Modifier& modifier, const Location& where);
void modify_light(Session& session, ObjectDefinition& light, const Modifier& modifier, const Location& where);
/// Sets one of the global_settings.
void modify_settings(Session& session, const Modifier& modifier, const Location& where);
TexturePtr modified(Session& session, const TexturePtr& texture, const Modifier& modifier,
                    const Location& where);
/// Modifies a texture as before version 3.0.
TexturePtr modified_old(Session& session, const TexturePtr& texture, const Modifier& modifier,
                        const Location& where);

} // namespace celltrace::pov
