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
  if (const auto* item = std::get_if<Item>(&modifier)) apply(session, finish, *item);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier)) mark(finish.unsupported, *missing);
}

void modify(Session& session, InteriorDefinition& interior, const Modifier& modifier, const Location&) {
  if (const auto* item = std::get_if<Item>(&modifier)) apply(session, interior, *item);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier)) mark(interior.unsupported, *missing);
}

void modify(Session& session, RainbowDefinition& rainbow, const Modifier& modifier, const Location&) {
  if (const auto* item = std::get_if<Item>(&modifier)) apply(session, rainbow, *item);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier)) mark(rainbow.unsupported, *missing);
}

void modify(Session& session, FogDefinition& fog, const Modifier& modifier, const Location&) {
  if (const auto* item = std::get_if<Item>(&modifier)) apply(session, fog, *item);
  if (const auto* next = std::get_if<Transform>(&modifier)) transform(fog.value, *next);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier)) mark(fog.unsupported, *missing);
}

void modify(Session& session, SkySphereDefinition& sky, const Modifier& modifier, const Location& where) {
  if (const auto* item = std::get_if<Item>(&modifier)) apply(session, sky, *item);
  if (const auto* next = std::get_if<Transform>(&modifier)) transform(session, sky, *next, where);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier)) mark(sky.unsupported, *missing);
}

void modify(Session& session, CameraDefinition& camera, const Modifier& modifier, const Location&) {
  if (const auto* item = std::get_if<Item>(&modifier)) apply(session, camera, *item);
  if (const auto* next = std::get_if<Transform>(&modifier)) transform(camera, *next);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier)) mark(camera.unsupported, *missing);
}

void modify(Session& session, ObjectDefinition& object, const Modifier& modifier, const Location&) {
  if (const auto* item = std::get_if<Item>(&modifier)) apply(session, object, *item);
  if (const auto* next = std::get_if<Transform>(&modifier)) object.apply(*next);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier)) mark(object.unsupported, *missing);
}

void modify(Session& session, MaterialDefinition& material, const Modifier& modifier, const Location& where) {
  if (const auto* next = std::get_if<Transform>(&modifier)) transform(session, material, *next, where);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier)) mark(material.unsupported, *missing);
}

void modify_light(Session& session, ObjectDefinition& light, const Modifier& modifier, const Location&) {
  if (const auto* item = std::get_if<Item>(&modifier)) apply(session, light, *item);
  if (const auto* next = std::get_if<Transform>(&modifier)) transform(light, *next);
  if (const auto* missing = std::get_if<UnsupportedPtr>(&modifier)) mark(light.unsupported, *missing);
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
