// How textures, and what has some, get their parts.
#include "pov/actions.hpp"
#include "pov/finite.hpp"

namespace celltrace::pov {

TexturePtr with(Session& session, const TexturePtr& texture, const PigmentPtr& pigment,
                const Location& where) {
  require_plain(session, texture, where);
  return with_pigment(texture, *pigment);
}

TexturePtr with(Session& session, const TexturePtr& texture, const NormalPtr& normal, const Location& where) {
  require_plain(session, texture, where);
  return with_normal(texture, normal);
}

TexturePtr with(Session& session, const TexturePtr& texture, const FinishPtr& finish, const Location& where) {
  require_plain(session, texture, where);
  return with_finish(texture, *finish);
}

TexturePtr with_named(const TexturePtr& texture, const Value& part) {
  if (const auto* pigment = std::get_if<PigmentPtr>(&part)) return with_pigment(texture, **pigment);
  if (const auto* normal = std::get_if<NormalPtr>(&part)) return with_normal(texture, *normal);
  return with_finish(texture, *std::get<FinishPtr>(part));
}

TexturePtr with_named(Session& session, const TexturePtr& texture, const Value& part, const Location& where) {
  require_plain(session, texture, where);
  return with_named(texture, part);
}

void start_part(Session& session, TexturePtr texture) {
  session.base_texture = texture;
  session.unfinished.emplace_back(std::move(texture));
}

void start_part(Session& session, std::shared_ptr<ObjectDefinition> object, const Location& where) {
  session.base_texture = plain_texture_of(session, *object, where);
  session.unfinished.emplace_back(std::move(object));
}

void start_part(Session& session, MaterialDefinition material) {
  session.base_interior = material.interior;
  session.unfinished.emplace_back(std::move(material));
}

void start_interior(Session& session, std::shared_ptr<ObjectDefinition> object) {
  session.base_interior = object->interior;
  session.unfinished.emplace_back(std::move(object));
}

void start_irid(Session& session, std::shared_ptr<FinishDefinition> finish, double amount) {
  finish->value.irid = amount;
  session.unfinished.emplace_back(std::move(finish));
}

Finish& irid(Session& session) {
  return std::get<std::shared_ptr<FinishDefinition>>(session.unfinished.back())->value;
}

std::shared_ptr<ObjectDefinition> dressed(Session& session, const PigmentDefinition& pigment) {
  auto object = kept<std::shared_ptr<ObjectDefinition>>(session);
  set_texture(*object, with_pigment(texture_of(session, *object), pigment));
  return object;
}

std::shared_ptr<ObjectDefinition> dressed(Session& session, const NormalPtr& normal) {
  auto object = kept<std::shared_ptr<ObjectDefinition>>(session);
  set_texture(*object, with_normal(texture_of(session, *object), normal));
  return object;
}

std::shared_ptr<ObjectDefinition> dressed(Session& session, const FinishDefinition& finish) {
  auto object = kept<std::shared_ptr<ObjectDefinition>>(session);
  set_texture(*object, with_finish(texture_of(session, *object), finish));
  return object;
}

std::shared_ptr<ObjectDefinition> with_interior(Session& session, const InteriorDefinition& interior) {
  auto object = kept<std::shared_ptr<ObjectDefinition>>(session);
  object->interior = copy_of(interior);
  return object;
}

std::shared_ptr<NormalDefinition> copy_of_normal(const NormalPtr& normal) {
  return normal ? copy_of(*normal) : std::make_shared<NormalDefinition>();
}

TexturePtr with_texture(const TexturePtr& before, const TexturePtr& declared) {
  return before->uv_mapping ? with_uv_mapping(declared) : declared;
}

TexturePtr finished_texture(Session& session, const TexturePtr& texture, const Location& where) {
  check(session, texture, where);
  return with_finished_uv_mapping(texture);
}

void transform(Session& session, MaterialDefinition& material, const Transform& next, const Location& where) {
  for (TexturePtr* texture : {&material.texture, &material.inside})
    if (*texture) *texture = transformed(session, *texture, next, where);
}

TexturePtr changed(Session& session, const TexturePtr& texture, const PatternChange& change,
                   const Location& where) {
  if (!texture->pattern.exists() && !texture->pattern.unsupported)
    session.fail(where, "this texture has no pattern of textures");
  auto result = std::make_shared<TextureDefinition>(*texture);
  change(session, result->pattern);
  return result;
}

void require_plain(Session& session, const TexturePtr& texture, const Location& where) {
  if (texture->pattern.exists())
    session.fail(where,
                 "a texture that is a pattern of textures has no pigment, normal or finish of its own");
  if (!texture->is_plain())
    session.fail(where, "the pigment, normal and finish of a texture with 'uv_mapping' stay as they are");
}

TexturePtr layer(Session& session, const TexturePtr& below, const TexturePtr& given, const Location& where) {
  constexpr double kVersionOfFilteringLayers = 3.11;
  const TexturePtr top = session.builder.is_before(kVersionOfFilteringLayers)
                             ? with_filter_as_transmit(given, below != nullptr)
                             : given;
  if (!below) return top;
  if (below->pattern.exists() || top->pattern.exists())
    session.fail(where, "a pattern of textures cannot be one of several layers");
  if (!below->is_plain() || !top->is_plain())
    session.fail(where, "a texture with 'uv_mapping' cannot be one of several layers");
  const TexturePtr both = layered(below, top);
  if (both->layers > kMostLayers)
    session.fail(where, "a texture has at most " + std::to_string(kMostLayers) + " layers");
  return both;
}

TexturePtr transformed(Session& session, const TexturePtr& texture, const Transform& next,
                       const Location& where) {
  if (!is_finite(next)) return transformed(texture, spread_point(session, where));
  if (is_singular(next)) session.fail(where, "this transformation is singular: it has no inverse");
  return transformed(texture, next);
}

void set_colour(PigmentDefinition& pigment, const Pigment& colour) {
  pigment.value = colour;
  pigment.pattern.number = kNoPattern;
  pigment.pattern.unsupported = nullptr;
  pigment.map = nullptr;
  pigment.unsupported = nullptr;
}

void set_quick_colour(Session& session, PigmentDefinition& pigment, const Pigment& colour) {
  constexpr int kBestWithout = 5;
  if (session.options.quality <= kBestWithout) pigment.quick_colour = colour;
}

} // namespace celltrace::pov
