// Objects: their shapes, parts, textures and limits.
#pragma once

#include "pov/object.hpp"
#include "pov/session.hpp"
#include "pov/shapes.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

/// Adds the size and the depth of a part to those of `object`. Fails if objects are nested too deeply.
void nest(Session& session, ObjectDefinition& object, const ObjectDefinition& part, const Location& where);
/// Returns the texture that a pigment, normal or finish of the object changes: its own, or the default one.
TexturePtr texture_of(Session& session, const ObjectDefinition& object);
/// Returns texture_of(). Fails if that texture has no pigment, normal and finish of its own.
TexturePtr plain_texture_of(Session& session, const ObjectDefinition& object, const Location& where);
void set_texture(ObjectDefinition& object, const TexturePtr& texture);
void add_layer(Session& session, ObjectDefinition& object, const TexturePtr& top, const Location& where);
/// Puts an object's textures on its surface coordinates. Fails if the object has a texture already.
void set_uv_mapping(Session& session, ObjectDefinition& object, const Location& where);
/// Gives parts of an intersection or difference without a texture the textures of the parts that they cut
/// (cutaway_textures.cpp).
void set_cutaway_textures(Session& session, ObjectDefinition& object, const Location& where);
/// Adds a layer to the object's interior_texture.
void set_inside(Session& session, ObjectDefinition& object, const TexturePtr& top, const Location& where);
/// Fails if an object that has been read to its end lacks something that it needs.
void check(Session& session, const ObjectDefinition& object, const Location& where);
/// Checks and returns an object that has been read to its end.
ObjectPtr complete(Session& session, std::shared_ptr<ObjectDefinition> object, const Location& where);
/// Sets the place of an object that needs no checks, and returns the object.
ObjectPtr located(std::shared_ptr<ObjectDefinition> object, const Location& where);
/// Ignores a colour among an object's modifiers, as POV-Ray does.
void ignore_colour(Session& session, const Location& where);
/// Ignores the name of a colour among an object's modifiers. Fails if the name is not that of a colour. Must
/// be called before the next token is read.
void ignore_colour_name(Session& session, const Quantity& value, const Location& where);
/// Adds an argument that follows other arguments without a comma. If it is a colour and the shape is
/// complete, it is a modifier, which is ignored.
void append_argument(Session& session, WrittenShape& written, const ShapeArgument& argument);
/// Sets the kind of a shape's curve by a word in front of its arguments.
void set_curve(Session& session, WrittenShape& written, Spline::Kind kind, const Location& where);
void set_curve(Session& session, WrittenShape& written, CurveWord word, const Location& where);
std::shared_ptr<ObjectDefinition> shape(Session& session, const WrittenShape& written);

/// Returns the degree of the shape that is written like a pattern: 3 for `cubic`.
double degree_of_pattern(Session& session, int pattern, const Location& where);
std::shared_ptr<ObjectDefinition> polynomial(Session& session, double degree,
                                             const std::vector<double>& coefficients, const Location& where);

/// A blob as far as it has been read.
struct WrittenBlob {
  Blob blob;
  UnsupportedPtr unsupported;
};
/// Returns a component of a blob, as an object. Without `strength` its last argument may be the strength.
std::shared_ptr<ObjectDefinition> blob_component(Session& session, WrittenShape written);
/// Sets the strength of a blob's component; fails if the object is none.
void set_strength(Session& session, ObjectDefinition& object, double strength, const Location& where);
void add_component(Session& session, WrittenBlob& blob, ObjectDefinition& object, const Location& where);
/// Adds a component of the old form: strength, radius and centre.
void add_component(Session& session, WrittenBlob& blob, double strength, double radius, const Vec3& centre,
                   const Location& where);
std::shared_ptr<ObjectDefinition> blob(Session& session, const WrittenBlob& written, const Location& where);
/// Makes a shape with `open` behind the arguments.
std::shared_ptr<ObjectDefinition> open_shape(Session& session, WrittenShape written);
std::shared_ptr<ObjectDefinition> csg(Session& session, Compound compound, const Location& where);
/// Says whether the lights of the scene light a light group.
void set_global_lights(ObjectDefinition& object, bool are_on);
/// Returns the object that a name stands for; a CSG is marked as declared.
ObjectPtr declared(const ObjectPtr& object);
/// Returns the object. Fails if other objects cannot be limited by it.
ObjectPtr limiting(Session& session, const ObjectPtr& object, const Location& where);
/// Returns the pattern of the inside of an object, with the transformation of `object`.
pattern::Inside inside_of(Session& session, const Limit& object, const Location& where);
/// Adds limits to `list`, which is one of the object's own lists.
void limit(Session& session, ObjectDefinition& object, std::vector<Limit>& list,
           const std::vector<Limit>& added, const Location& where);
void apply(Session& session, const std::shared_ptr<const MaterialDefinition>& material,
           ObjectDefinition& object, const Location& where);

} // namespace celltrace::pov
