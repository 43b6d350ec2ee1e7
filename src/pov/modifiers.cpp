#include "pov/modifiers.hpp"

#include "pov/camera.hpp"
#include "pov/light.hpp"

namespace celltrace::pov {

namespace {

void modify(Session& session, PatternDefinition& pattern, const Modifier& modifier) {
  if (const auto* warp = std::get_if<PatternChange>(&modifier.what)) change(session, pattern, *warp);
  if (const auto* next = std::get_if<Transform>(&modifier.what))
    move(session, pattern, *next, modifier.where);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier.what)) mark(pattern.unsupported, *missing);
}

} // namespace

void modify(Session& session, PigmentDefinition& pigment, const Modifier& modifier) {
  if (const auto* item = std::get_if<Item>(&modifier.what)) return apply(session, pigment, *item);
  modify(session, pigment.pattern, modifier);
}

void modify(Session& session, NormalDefinition& normal, const Modifier& modifier) {
  if (const auto* item = std::get_if<Item>(&modifier.what)) return apply(session, normal, *item);
  modify(session, normal.pattern, modifier);
}

void modify(Session& session, FinishDefinition& finish, const Modifier& modifier) {
  if (const auto* item = std::get_if<Item>(&modifier.what)) apply(session, finish, *item);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier.what)) mark(finish.unsupported, *missing);
}

void modify(Session& session, InteriorDefinition& interior, const Modifier& modifier) {
  if (const auto* item = std::get_if<Item>(&modifier.what)) apply(session, interior, *item);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier.what)) mark(interior.unsupported, *missing);
}

void modify(Session& session, RainbowDefinition& rainbow, const Modifier& modifier) {
  if (const auto* item = std::get_if<Item>(&modifier.what)) apply(session, rainbow, *item);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier.what)) mark(rainbow.unsupported, *missing);
}

void modify(Session& session, FogDefinition& fog, const Modifier& modifier) {
  if (const auto* item = std::get_if<Item>(&modifier.what)) apply(session, fog, *item);
  if (const auto* next = std::get_if<Transform>(&modifier.what)) transform(fog.value, *next);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier.what)) mark(fog.unsupported, *missing);
}

void modify(Session& session, SkySphereDefinition& sky, const Modifier& modifier) {
  if (const auto* item = std::get_if<Item>(&modifier.what)) apply(session, sky, *item);
  if (const auto* next = std::get_if<Transform>(&modifier.what))
    transform(session, sky, *next, modifier.where);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier.what)) mark(sky.unsupported, *missing);
}

void modify(Session& session, CameraDefinition& camera, const Modifier& modifier) {
  if (const auto* item = std::get_if<Item>(&modifier.what)) apply(session, camera, *item);
  if (const auto* next = std::get_if<Transform>(&modifier.what)) transform(camera, *next);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier.what)) mark(camera.unsupported, *missing);
}

void modify(Session& session, ObjectDefinition& object, const Modifier& modifier) {
  if (const auto* item = std::get_if<Item>(&modifier.what)) apply(session, object, *item);
  if (const auto* next = std::get_if<Transform>(&modifier.what)) object.apply(*next);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier.what)) mark(object.unsupported, *missing);
}

void modify(Session& session, MaterialDefinition& material, const Modifier& modifier) {
  if (const auto* next = std::get_if<Transform>(&modifier.what))
    transform(session, material, *next, modifier.where);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier.what)) mark(material.unsupported, *missing);
}

void modify_light(Session& session, ObjectDefinition& light, const Modifier& modifier) {
  if (const auto* item = std::get_if<Item>(&modifier.what)) apply(session, light, *item);
  if (const auto* next = std::get_if<Transform>(&modifier.what)) transform(light, *next);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier.what)) mark(light.unsupported, *missing);
}

void modify_settings(Session& session, const Modifier& modifier) {
  if (const auto* item = std::get_if<Item>(&modifier.what)) apply_setting(session, *item);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier.what))
    session.diagnostics.supports(*missing, modifier.where);
}

TexturePtr modified(Session& session, const TexturePtr& texture, const Modifier& modifier) {
  if (const auto* item = std::get_if<Item>(&modifier.what))
    return changed(session, texture, pattern_change(session, *item), modifier.where);
  if (const auto* warp = std::get_if<PatternChange>(&modifier.what))
    return changed(session, texture, *warp, modifier.where);
  if (const auto* next = std::get_if<Transform>(&modifier.what))
    return transformed(session, texture, *next, modifier.where);
  return with_pattern(session, texture, unsupported_change(std::get<UnsupportedPtr>(modifier.what)));
}

TexturePtr modified_old(Session& session, const TexturePtr& texture, const Modifier& modifier) {
  if (const auto* item = std::get_if<Item>(&modifier.what)) return with_old_item(session, texture, *item);
  if (const auto* warp = std::get_if<PatternChange>(&modifier.what))
    return with_old_pattern(session, texture, *warp);
  return modified(session, texture, modifier);
}

} // namespace celltrace::pov
