// Objects: their shapes, parts, textures and limits.
#include <algorithm>
#include <cmath>

#include "pov/actions.hpp"
#include "pov/bounds_check.hpp"
#include "pov/light.hpp"

namespace celltrace::pov {

namespace {

/// Most objects inside one another, as loops make them that add to a union. A level takes 1.3 KB of the
/// stack.
constexpr int kDeepestObject = 1000;

} // namespace

void nest(Session& session, ObjectDefinition& object, const ObjectDefinition& part, const Location& where) {
  object.depth = std::max(object.depth, part.depth + 1);
  if (object.depth > kDeepestObject) session.fail(where, "objects are nested too deeply");
  object.size = std::min(object.size + part.size, ObjectDefinition::kMostParts);
}

TexturePtr texture_of(Session& session, const ObjectDefinition& object) {
  if (!object.texture) return session.builder.default_texture;
  return transformed(object.texture, *object.texture_transform);
}

TexturePtr plain_texture_of(Session& session, const ObjectDefinition& object, const Location& where) {
  TexturePtr texture = texture_of(session, object);
  require_plain(session, texture, where);
  return texture;
}

void set_texture(ObjectDefinition& object, const TexturePtr& texture) {
  object.texture = texture;
  object.texture_transform = Transform();
}

void add_layer(Session& session, ObjectDefinition& object, const TexturePtr& top, const Location& where) {
  const TexturePtr below = object.texture ? texture_of(session, object) : nullptr;
  set_texture(object, layer(session, below, top, where));
}

void set_uv_mapping(Session& session, ObjectDefinition& object, const Location& where) {
  if (object.texture) session.fail(where, "'uv_mapping' comes in front of the textures of an object");
  if (!object.uv_mapping) object.transform_before_uv = object.transform;
  object.uv_mapping = true;
}

void set_inside(Session& session, ObjectDefinition& object, const TexturePtr& top, const Location& where) {
  object.inside = layer(session, object.inside, top, where);
}

void check(Session& session, const ObjectDefinition& object, const Location& where) {
  if (object.inside && !object.texture)
    session.fail(where, "an object with an 'interior_texture' has to have a texture, too");
}

void ignore_colour(Session& session, const Location& where) {
  session.diagnostics.warn_once(where, "this colour is ignored: what gives an object one is its 'pigment'");
}

ObjectPtr complete(Session& session, std::shared_ptr<ObjectDefinition> object, const Location& where) {
  object->where = where;
  check(session, *object, where);
  object->reaches_out_of_bounds = reaches_out_of_bounds(session, *object, where);
  return own_object(session, std::move(object), where);
}

ObjectPtr located(std::shared_ptr<ObjectDefinition> object, const Location& where) {
  object->where = where;
  return object;
}

void ignore_colour_name(Session& session, const Quantity& value, const Location& where) {
  if (!value.is_colour) session.fail(where, "unexpected " + session.tokens.describe_last());
  ignore_colour(session, where);
}

void append_argument(Session& session, WrittenShape& written, const ShapeArgument& argument) {
  if (argument.value.is_colour && is_complete(written.number, written.arguments.size()))
    ignore_colour(session, argument.where);
  else
    append(session, written.arguments, argument, argument.where);
}

namespace {

/// Makes a cone with a radius below 0 the two that meet in its apex, or one with radii above.
void split_cone(Session& session, ObjectDefinition& object, const Cone& cone, const Location& where) {
  const double base = std::fabs(cone.base_radius), cap = std::fabs(cone.cap_radius);
  if (std::max(cone.base_radius, cone.cap_radius) < std::max(base, cap))
    session.diagnostics.warn_once(where,
                                  "POV-Ray shows a part of this cone only: its greater radius is below 0");
  if (cone.base_radius * cone.cap_radius >= 0) {
    object.shape = Shape(Cone{cone.base, cone.cap, base, cap, cone.open});
    return;
  }
  const Vec3 apex = cone.base + (cone.cap - cone.base) * (base / (base + cap));
  Compound both;
  for (const Cone& half :
       {Cone{cone.base, apex, base, 0, cone.open}, Cone{apex, cone.cap, 0, cap, cone.open}}) {
    auto part = std::make_shared<ObjectDefinition>();
    part->shape = Shape(half);
    nest(session, object, *part, where);
    both.parts.push_back(std::move(part));
  }
  object.shape = std::make_shared<const Compound>(std::move(both));
}

} // namespace

std::shared_ptr<ObjectDefinition> shape(Session& session, const WrittenShape& written) {
  auto object = std::make_shared<ObjectDefinition>();
  Shape shape = read_shape(session, written);
  const auto* cone = std::get_if<Cone>(&shape);
  if (cone != nullptr && (cone->base_radius < 0 || cone->cap_radius < 0))
    split_cone(session, *object, *cone, written.where);
  else
    object->shape = std::move(shape);
  return object;
}

std::shared_ptr<ObjectDefinition> polynomial(Session& session, double degree,
                                             const std::vector<double>& coefficients, const Location& where) {
  constexpr int kGreatestDegree = 35;
  if (!(degree >= 2 && degree <= kGreatestDegree)) session.fail(where, "the degree of a poly is 2 to 35");
  auto polynomial = std::make_shared<Polynomial>();
  polynomial->degree = static_cast<int>(degree);
  if (coefficients.size() != Polynomial::count(polynomial->degree))
    session.fail(where, "a polynomial of degree " + std::to_string(polynomial->degree) + " has " +
                            std::to_string(Polynomial::count(polynomial->degree)) + " coefficients, found " +
                            std::to_string(coefficients.size()));
  polynomial->coefficients = coefficients;
  auto object = std::make_shared<ObjectDefinition>();
  object->shape = Shape(std::shared_ptr<const Polynomial>(polynomial));
  return object;
}

void set_curve(Session& session, WrittenShape& written, Spline::Kind kind, const Location& where) {
  switch (kind) {
  case Spline::Kind::linear:
    written.curve = CurveKind::linear;
    return;
  case Spline::Kind::quadratic:
    written.curve = CurveKind::quadratic;
    return;
  case Spline::Kind::cubic:
    written.curve = CurveKind::cubic;
    return;
  case Spline::Kind::natural:
    session.fail(where, "a shape has no natural_spline");
  }
}
void set_curve(Session&, WrittenShape& written, CurveWord word, const Location&) {
  switch (word) {
  case CurveWord::bezier:
    written.curve = CurveKind::bezier;
    return;
  case CurveWord::b_spline:
    written.curve = CurveKind::b_spline;
    return;
  case CurveWord::linear_sweep:
  case CurveWord::conic_sweep:
    written.is_swept = true;
    written.is_conic = word == CurveWord::conic_sweep;
    return;
  }
}

double degree_of_pattern(Session& session, int pattern, const Location& where) {
  if (quoted_pattern(pattern) != "'cubic'") session.fail(where, "expected an object, found " + quoted_pattern(pattern));
  return 3;
}

std::shared_ptr<ObjectDefinition> blob_component(Session& session, WrittenShape written) {
  written.is_component = true;
  return shape(session, written);
}

void set_strength(Session& session, ObjectDefinition& object, double strength, const Location& where) {
  auto* const shape = std::get_if<Shape>(&object.shape);
  const auto* const blob = shape != nullptr ? std::get_if<std::shared_ptr<const Blob>>(shape) : nullptr;
  if (blob == nullptr || (*blob)->components.size() != 1)
    session.fail(where, "only a component of a blob has 'strength'");
  auto changed = std::make_shared<Blob>(**blob);
  changed->components.front().strength = strength;
  *shape = std::shared_ptr<const Blob>(changed);
}

namespace {

void append_component(Session& session, Blob& blob, const Blob::Component& component, const Location& where) {
  constexpr std::size_t kMostComponents = 300000;
  if (blob.components.size() >= kMostComponents) session.fail(where, "this blob has too many components");
  blob.components.push_back(component);
}

} // namespace

void add_component(Session& session, WrittenBlob& written, ObjectDefinition& object, const Location& where) {
  const auto* const shape = std::get_if<Shape>(&object.shape);
  const auto* const own = shape != nullptr ? std::get_if<std::shared_ptr<const Blob>>(shape) : nullptr;
  if (own == nullptr) session.fail(where, "a component of a blob is a sphere or a cylinder");
  Blob::Component component = (*own)->components.front();
  component.transform = object.transform;
  append_component(session, written.blob, component, where);
  if (object.texture) mark(written.unsupported, make_unsupported("a texture of a blob's component", where));
}
void add_component(Session& session, WrittenBlob& written, double strength, double radius, const Vec3& centre,
                   const Location& where) {
  Blob::Component component;
  component.a = component.b = centre;
  component.radius = radius;
  component.strength = strength;
  append_component(session, written.blob, component, where);
}

std::shared_ptr<ObjectDefinition> blob(Session& session, const WrittenBlob& written, const Location& where) {
  if (written.blob.components.empty()) session.fail(where, "a blob has at least one component");
  auto object = std::make_shared<ObjectDefinition>();
  object->shape = Shape(std::make_shared<const Blob>(written.blob));
  object->unsupported = written.unsupported;
  return object;
}

std::shared_ptr<ObjectDefinition> open_shape(Session& session, WrittenShape written) {
  written.is_open = true;
  return shape(session, written);
}

/// Whether a union is nothing but its parts, placed with it.
bool is_mere_union(const ObjectDefinition& object) {
  const auto* const compound = std::get_if<std::shared_ptr<const Compound>>(&object.shape);
  return compound != nullptr && (*compound)->operation == Csg::Operation::union_ &&
         !(*compound)->is_light_group && !object.texture && !object.inside && !object.uv_mapping &&
         !object.interior && !object.no_shadow && !object.no_image && !object.no_reflection &&
         !object.is_lit_through && !object.hollow && !object.inverse && object.clipped_by.empty() &&
         object.bounded_by.empty() && !object.unsupported && !object.missing && !object.is_photon_target &&
         object.role == ObjectDefinition::Role::none;
}

/// Takes the parts of unions that nest deeply in place of these: scenes make long rows of objects by loops
/// in which each round makes a union of all rounds before and one object more.
void flatten(std::vector<ObjectPtr>& parts) {
  constexpr int kDeep = 500; // sooner the copies are not worth it
  if (std::none_of(parts.begin(), parts.end(), [](const ObjectPtr& part) { return part->depth >= kDeep; }))
    return;
  std::vector<ObjectPtr> flat;
  for (ObjectPtr& part : parts) {
    if (part->depth < kDeep || !is_mere_union(*part)) {
      flat.push_back(std::move(part));
      continue;
    }
    for (const ObjectPtr& inner : std::get<std::shared_ptr<const Compound>>(part->shape)->parts) {
      const ObjectPtr named = part->is_declared ? declared(inner) : inner;
      if (part->transform.is_identity()) {
        flat.push_back(named);
        continue;
      }
      auto moved = std::make_shared<ObjectDefinition>(*named);
      moved->apply(part->transform);
      flat.push_back(std::move(moved));
    }
  }
  parts = std::move(flat);
}

std::shared_ptr<ObjectDefinition> csg(Session& session, Compound compound, const Location& where) {
  if (compound.parts.size() < 2 && !compound.is_light_group)
    session.diagnostics.warn_once(where, "this CSG has less than two objects");
  if (compound.operation == Csg::Operation::union_ && !compound.is_light_group) flatten(compound.parts);
  auto object = std::make_shared<ObjectDefinition>();
  for (const ObjectPtr& part : compound.parts)
    nest(session, *object, *part, where);
  object->shape = std::make_shared<const Compound>(std::move(compound));
  return object;
}

void set_global_lights(ObjectDefinition& object, bool are_on) {
  auto& compound = std::get<std::shared_ptr<const Compound>>(object.shape);
  auto changed = std::make_shared<Compound>(*compound);
  changed->global_lights = are_on;
  compound = std::move(changed);
}

ObjectPtr declared(const ObjectPtr& object) {
  if (object->is_declared || !std::holds_alternative<std::shared_ptr<const Compound>>(object->shape))
    return object;
  auto named = std::make_shared<ObjectDefinition>(*object);
  named->is_declared = true;
  return named;
}

ObjectPtr limiting(Session& session, const ObjectPtr& object, const Location& where) {
  if (object->light()) session.fail(where, "a light source has no inside");
  return object;
}

pattern::Inside inside_of(Session& session, const Limit& object, const Location& where) {
  ObjectDefinition moved = *limiting(session, object.object, where);
  moved.apply(object.transform);
  return {session.builder.make_solid(moved, where)};
}

void limit(Session& session, ObjectDefinition& object, std::vector<Limit>& list,
           const std::vector<Limit>& added, const Location& where) {
  const auto* mesh = std::get_if<std::shared_ptr<MeshDefinition>>(&object.shape);
  if (mesh && (*mesh)->ignores_clips) {
    if (&list == &object.clipped_by)
      session.diagnostics.warn_once(where, "'clipped_by' has no effect on a bicubic_patch, as in POV-Ray");
    return;
  }
  for (const Limit& limit : added)
    nest(session, object, *limit.object, where);
  list.insert(list.end(), added.begin(), added.end());
}

void apply(Session& session, const std::shared_ptr<const MaterialDefinition>& material,
           ObjectDefinition& object, const Location& where) {
  mark(object.unsupported, material->unsupported);
  if (material->texture) add_layer(session, object, material->texture, where);
  if (material->inside) set_inside(session, object, material->inside, where);
  if (material->interior) object.interior = material->interior;
}

} // namespace celltrace::pov
