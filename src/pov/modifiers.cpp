#include "pov/modifiers.hpp"

#include "pov/camera.hpp"
#include "pov/light.hpp"

namespace celltrace::pov {

namespace {

void modify(Session& session, PatternDefinition& pattern, const Modifier& modifier, const Location& where) {
  if (const auto* warp = std::get_if<PatternChange>(&modifier)) change(session, pattern, *warp);
  if (const auto* next = std::get_if<Transform>(&modifier)) move(session, pattern, *next, where);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier)) mark(pattern.unsupported, *missing);
}

/// Does what a modifier says to a part of the scene that `move` transforms.
template <class T, class Move>
void modify_part(Session& session, T& part, const Modifier& modifier, Move move) {
  if (const auto* item = std::get_if<Item>(&modifier)) apply(session, part, *item);
  if (const auto* next = std::get_if<Transform>(&modifier)) move(*next);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier)) mark(part.unsupported, *missing);
}
/// Stands for parts whose blocks have no transformations: TokenStream does not give them any.
void stays(const Transform&) {
}

} // namespace

void modify(Session& session, PigmentDefinition& pigment, const Modifier& modifier, const Location& where) {
  if (const auto* item = std::get_if<Item>(&modifier)) return apply(session, pigment, *item);
  modify(session, pigment.pattern, modifier, where);
}

void modify(Session& session, NormalDefinition& normal, const Modifier& modifier, const Location& where) {
  if (const auto* item = std::get_if<Item>(&modifier)) return apply(session, normal, *item);
  modify(session, normal.pattern, modifier, where);
}

void modify(Session& session, FinishDefinition& finish, const Modifier& modifier, const Location&) {
  modify_part(session, finish, modifier, stays);
}

void modify(Session& session, InteriorDefinition& interior, const Modifier& modifier, const Location&) {
  modify_part(session, interior, modifier, stays);
}

void modify(Session& session, RainbowDefinition& rainbow, const Modifier& modifier, const Location&) {
  modify_part(session, rainbow, modifier, stays);
}

void modify(Session& session, FogDefinition& fog, const Modifier& modifier, const Location&) {
  modify_part(session, fog, modifier, [&](const Transform& next) { transform(fog.value, next); });
}

void modify(Session& session, SkySphereDefinition& sky, const Modifier& modifier, const Location& where) {
  modify_part(session, sky, modifier, [&](const Transform& next) { transform(session, sky, next, where); });
}

void modify(Session& session, CameraDefinition& camera, const Modifier& modifier, const Location&) {
  modify_part(session, camera, modifier, [&](const Transform& next) { transform(camera, next); });
}

void modify(Session& session, ObjectDefinition& object, const Modifier& modifier, const Location&) {
  modify_part(session, object, modifier, [&](const Transform& next) { object.apply(next); });
}

void modify_light(Session& session, ObjectDefinition& light, const Modifier& modifier, const Location&) {
  modify_part(session, light, modifier, [&](const Transform& next) { transform(light, next); });
}

void modify(Session& session, MaterialDefinition& material, const Modifier& modifier, const Location& where) {
  if (const auto* next = std::get_if<Transform>(&modifier)) transform(session, material, *next, where);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier)) mark(material.unsupported, *missing);
}

void modify_settings(Session& session, const Modifier& modifier, const Location& where) {
  if (const auto* item = std::get_if<Item>(&modifier)) apply_setting(session, *item);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier))
    session.diagnostics.supports(*missing, where);
}

TexturePtr modified(Session& session, const TexturePtr& texture, const Modifier& modifier,
                    const Location& where) {
  if (const auto* item = std::get_if<Item>(&modifier))
    return changed(session, texture, pattern_change(session, *item), where);
  if (const auto* warp = std::get_if<PatternChange>(&modifier))
    return changed(session, texture, *warp, where);
  if (const auto* next = std::get_if<Transform>(&modifier))
    return transformed(session, texture, *next, where);
  return with_pattern(session, texture, unsupported_change(std::get<UnsupportedPtr>(modifier)));
}

TexturePtr modified_old(Session& session, const TexturePtr& texture, const Modifier& modifier,
                        const Location& where) {
  if (const auto* item = std::get_if<Item>(&modifier)) return with_old_item(session, texture, *item);
  if (const auto* warp = std::get_if<PatternChange>(&modifier))
    return with_old_pattern(session, texture, *warp);
  return modified(session, texture, modifier, where);
}

} // namespace celltrace::pov
