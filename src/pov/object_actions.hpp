// Objects: their shapes, parts, textures and limits.
#pragma once

#include "pov/object.hpp"
#include "pov/session.hpp"
#include "pov/shapes.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

/// Counts `part` as one that is inside `object`.
void nest(Session& session, ObjectDefinition& object, const ObjectDefinition& part, const Location& where);
/// The texture that an object's pigment, normal or finish changes.
TexturePtr texture_of(Session& session, const ObjectDefinition& object);
/// The same, for one that has a pigment, normal and finish of its own.
TexturePtr plain_texture_of(Session& session, const ObjectDefinition& object, const Location& where);
void set_texture(ObjectDefinition& object, const TexturePtr& texture);
void add_layer(Session& session, ObjectDefinition& object, const TexturePtr& top, const Location& where);
/// Puts an object's textures on its surface coordinates. Fails if it has one already.
void set_uv_mapping(Session& session, ObjectDefinition& object, const Location& where);
/// Parts of an intersection or difference without a texture look like those that they cut
/// (cutaway_textures.cpp).
void set_cutaway_textures(Session& session, ObjectDefinition& object, const Location& where);
/// Adds a layer to what the object looks like from inside.
void set_inside(Session& session, ObjectDefinition& object, const TexturePtr& top, const Location& where);
/// Fails unless an object has all that it needs when it ends.
void check(Session& session, const ObjectDefinition& object, const Location& where);
/// Checks an object that has been read to its end.
ObjectPtr complete(Session& session, std::shared_ptr<ObjectDefinition> object, const Location& where);
/// Notes where an object stands that needs no checks.
ObjectPtr located(std::shared_ptr<ObjectDefinition> object, const Location& where);
/// Ignores a colour among an object's modifiers, as POV-Ray does.
void ignore_colour(Session& session, const Location& where);
/// Ignores a name likewise, and fails if that is no colour's. Must come before the next token is read.
void ignore_colour_name(Session& session, const Quantity& value, const Location& where);
/// Adds what stands behind other arguments without a comma: that may also be the name of a colour, which is
/// such a modifier where the shape is complete.
void append_argument(Session& session, WrittenShape& written, const ShapeArgument& argument);
std::shared_ptr<ObjectDefinition> shape(Session& session, const WrittenShape& written);
/// Makes a shape with `open` behind the arguments.
std::shared_ptr<ObjectDefinition> open_shape(Session& session, WrittenShape written);
std::shared_ptr<ObjectDefinition> csg(Session& session, Compound compound, const Location& where);
/// Says whether the lights of the scene light a light group.
void set_global_lights(ObjectDefinition& object, bool are_on);
/// Returns the object that a name stands for.
ObjectPtr declared(const ObjectPtr& object);
/// An object that other ones can be limited by.
ObjectPtr limiting(Session& session, const ObjectPtr& object, const Location& where);
/// Returns the inside that a pattern is of; `object` has been moved.
pattern::Inside inside_of(Session& session, const Limit& object, const Location& where);
/// Adds to one of the object's own lists of limits.
void limit(Session& session, ObjectDefinition& object, std::vector<Limit>& list,
           const std::vector<Limit>& added, const Location& where);
void apply(Session& session, const std::shared_ptr<const MaterialDefinition>& material,
           ObjectDefinition& object, const Location& where);

} // namespace celltrace::pov
