// What the grammar's rules do, where it takes more than a line.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pov/mesh.hpp"
#include "pov/object.hpp"
#include "pov/session.hpp"
#include "pov/shapes.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

/// Adds to a list of the scene's, which a loop must not make endless.
template <class T, class A, class U = T>
void append(Session& session, std::vector<T, A>& list, U&& element, const Location& where) {
  if (list.size() >= session.options.limits.list_entries)
    session.exceed(where, &ParseLimits::list_entries, "this list has", "entries");
  list.push_back(std::forward<U>(element));
}

template <class T> std::shared_ptr<T> copy_of(const T& definition) {
  return std::make_shared<T>(definition);
}

/// A copy of what a name stands for, which is a T.
template <class T> std::shared_ptr<T> copy_of_named(const Value& value) {
  return copy_of(*std::get<std::shared_ptr<const T>>(value));
}

// ---- Numbers ----

/// What stands in < >: at least two components.
Quantity vector(Session& session, const Quantity& components, const Location& where);
/// Whether there is a component of this number (Names::Entry::component).
bool has_component(const Quantity& quantity, int which);
/// The component a word behind a dot names, as in v.x or c.red.
double component(Session& session, const Quantity& quantity, int which, const Location& where);
/// Adds one to a vector being read.
void append_component(Session& session, Quantity& vector, double component, const Location& where);
Transform scale(Session& session, const Quantity& factors, const Location& where);
Transform matrix(Session& session, const std::vector<ListEntry>& numbers, const Location& where);
/// What stands in transform { }.
struct WrittenTransform {
  Transform items;
  bool is_inverse = false;
};
Transform complete(Session& session, const WrittenTransform& written, const Location& where);

/// Warns of a division by zero, which gives an infinity.
Quantity divided(Session& session, const Quantity& a, const Quantity& b, const Location& where);

/// From sRGB to what the scene's colours mean, as its assumed_gamma, which must be known by now, says.
Quantity decoded(Session& session, const Quantity& colour, const Location& where);

// ---- Arrays (arrays.cpp) ----

/// A deep copy: arrays are values.
std::shared_ptr<Array> copy(Session& session, const Array& array, const Location& where);
Array to_array(const std::vector<Quantity>& numbers);
std::size_t array_size(Session& session, double size, const Location& where);
/// An array of the given dimensions from `level` on, without values.
std::shared_ptr<Array> make_array(Session& session, const std::vector<std::size_t>& dimensions,
                                  std::size_t level, const Location& where);
/// The same with the given elements, which must fit it.
std::shared_ptr<Array> filled_array(Session& session, const std::vector<std::size_t>& dimensions,
                                    const std::shared_ptr<Array>& elements, const Location& where);
int dimensions(const Array& array);
/// 0 of dimensions that it does not have.
double dimension_size(const Array& array, double dimension);

// ---- Functions and splines ----

Quantity call(Session& session, const UserFunction& function, const std::vector<Value>& arguments,
              const Location& where);
/// The point, or 0; also writes the normal there, or 0, to a name.
Quantity trace(Session& session, const ObjectDefinition& object, const Quantity& origin,
               const Quantity& direction, std::optional<NameId> normal, const Location& where);
void add(Session& session, Spline& spline, double at, const Quantity& value, const Location& where);
/// Fails if the spline has no knots.
SplinePtr finished(Session& session, const std::shared_ptr<Spline>& spline, const Location& where);

// ---- Parts of textures ----

// The texture with another pigment, normal or finish. Fail if it has none of its own.
TexturePtr with(Session& session, const TexturePtr& texture, const PigmentPtr& pigment,
                const Location& where);
TexturePtr with(Session& session, const TexturePtr& texture, const NormalPtr& normal, const Location& where);
TexturePtr with(Session& session, const TexturePtr& texture, const FinishPtr& finish, const Location& where);
/// The texture with the pigment, normal or finish that a name stands for.
TexturePtr with_named(const TexturePtr& texture, const Value& part);
/// Has what is read next start from the parts of a texture.
void start_from(Session& session, const TexturePtr& texture);
/// The same for an object's texture.
void start_from(Session& session, const ObjectDefinition& object, const Location& where);
/// Has the interior that is read next start from an object's or a material's.
void start_interior(Session& session, const ObjectDefinition& object);
void start_from(Session& session, const MaterialDefinition& material);
/// Gives an object's texture a pigment, normal or finish.
void dress(Session& session, ObjectDefinition& object, const PigmentDefinition& pigment);
void dress(Session& session, ObjectDefinition& object, const NormalPtr& normal);
void dress(Session& session, ObjectDefinition& object, const FinishDefinition& finish);
/// A copy to change; a new one of null.
std::shared_ptr<NormalDefinition> copy_of_normal(const NormalPtr& normal);
/// The declared texture in place of `before`, on surface coordinates if that was to be.
TexturePtr with_texture(const TexturePtr& before, const TexturePtr& declared);
/// What has been read, complete.
TexturePtr finished_texture(Session& session, const TexturePtr& texture, const Location& where);
/// Has what is read next say how a finish is iridescent.
void start_irid(Session& session, FinishDefinition& finish, double amount);
void transform(Session& session, MaterialDefinition& material, const Transform& next, const Location& where);

// ---- Scene ----

void set_assumed_gamma(Session& session, double gamma, const Location& where);
/// Without a gamma colours are encoded as sRGB. As in POV-Ray, the first one of a scene counts.
void set_assumed_gamma(Session& session, std::optional<double> gamma, const Location& where);
void set_max_trace_level(Session& session, double level, const Location& where);
void set_noise_generator(Session& session, double number, const Location& where);
void set_adc_bailout(Session& session, double share, const Location& where);
void set_number_of_waves(Session& session, double number, const Location& where);

void set_photons(Session& session, const Location& where);
/// Passes over radiosity { }, which is not supported at qualities that have it.
void refuse_radiosity(Session& session, const Location& where);
/// Passes over a block of the scene's that is not supported.
void refuse_block(Session& session, NameId word, const Location& where);

/// Has a pigment, normal or finish be that of the default texture.
template <class Part>
void set_default(Session& session, const std::shared_ptr<const Part>& part, const Location& where) {
  TexturePtr& texture = session.builder.default_texture;
  texture = with(session, texture, part, where);
}
/// Passes over a block that is not supported.
void set_unsupported_default(Session& session, NameId word, const Location& where);

// ---- Textures ----

/// What a pattern's word or a modifier such as `frequency 2` does to a pattern.
using PatternChange = std::function<void(Session&, PatternDefinition&)>;

PatternChange chosen(int number);
PatternChange chosen(int number, const Quantity& argument, const Location& where);
template <class T> PatternChange set(T Pattern::*member, T value) {
  return [=](Session&, PatternDefinition& pattern) { pattern.own().*member = value; };
}
template <class T> PatternChange set(T Turbulence::*member, T value) {
  return [=](Session&, PatternDefinition& pattern) { pattern.own().turbulence.*member = value; };
}
PatternChange poly_wave(double exponent);
PatternChange option(int number, const Quantity& value, const Location& where);
/// `magnet`: 0, 1 or 2.
PatternChange julia(Session& session, double magnet, const Quantity& constant, double iterations,
                    const Location& where);
/// Gives a fractal as many iterations as can be counted. With less than 0 POV-Ray has 0.55
/// everywhere.
void set_iterations(Session& session, pattern::Fractal& fractal, double number, const Location& where);
/// Of the magnet's kind, `pattern` being the Mandelbrot set.
PatternChange magnet(Session& session, double kind, int pattern, const Quantity& iterations,
                     const Location& where);
/// Fails if it has neither a direction nor an altitude.
PatternChange slope(Session& session, const pattern::Slope& slope, const Location& where);
/// Sets a range of a slope; without a width it stays the one from 0 to 1.
void set_range(double& from, double& to, double least, double most);
/// What only fractals understand; fails unless the number is one of 0 to `most`.
PatternChange set_fractal(int pattern::Fractal::*member, double value, int most, const Location& where);
/// The power of a fractal: 2, as in POV-Ray, if it is none of 2 to 33.
PatternChange fractal_exponent(double value, const Location& where);
PatternChange exterior(double type, double factor, const Location& where);
PatternChange interior(double type, double factor, const Location& where);
/// The grey of a pigment.
PatternChange grey(const PigmentDefinition& pigment);
PatternChange unsupported_change(const UnsupportedPtr& unsupported);
/// `items_where`: where the first word in it stands.
PatternChange warp(Session& session, SpaceStep warp, const Location& items_where, const Location& where);
/// A black hole's copies do not reach into one another: they are as far apart as that takes.
void keep_apart(Session& session, warp::BlackHole& hole, const Location& where);
/// Along the only axis of which `width` is not 0.
warp::Repeat repeat(Session& session, const Vec3& width, const Location& where);
/// `option`: the word, which has to be "offset".
Vec3 offset(Session& session, int option, const Quantity& value, const Location& where);
/// Of a pattern's word.
warp::Mapping mapping(Session& session, int pattern, const Location& where);
warp::Mapping mapping(Session& session, int pattern, const Vec3& orientation, double distance,
                      const Location& where);
/// Fails unless it has a length.
double positive(Session& session, double value, const char* what, const Location& where);
int octaves(double number);
/// 0: the scene's.
int noise_generator(Session& session, double number, const Location& where);

/// Makes a change, unless the pattern is on surface coordinates.
void change(Session& session, PatternDefinition& pattern, const PatternChange& change);
/// The texture with a change to its pattern, which it must have.
TexturePtr changed(Session& session, const TexturePtr& texture, const PatternChange& change,
                   const Location& where);
/// Fails for a texture whose pattern is one of textures, or which is on surface coordinates: it has no
/// pigment, normal or finish of its own.
void require_plain(Session& session, const TexturePtr& texture, const Location& where);
/// `given` on `below`, which may be null. Fails for textures that cannot be layers. Up to version 3.1 layers
/// that are on other ones transmit what they filter.
TexturePtr layer(Session& session, const TexturePtr& below, const TexturePtr& given, const Location& where);
TexturePtr transformed(Session& session, const TexturePtr& texture, const Transform& next,
                       const Location& where);

void set_colour(PigmentDefinition& pigment, const Pigment& colour);
/// What counts alone where the picture is of a quality that low.
void set_quick_colour(Session& session, PigmentDefinition& pigment, const Pigment& colour);

/// Fails if the pigment depends on a surface: a sky has none.
/// What a sky_sphere has to have.
void check(Session& session, const SkySphereDefinition& sky, const Location& where);
void add_layer(Session& session, SkySphereDefinition& sky, const PigmentDefinition& pigment,
               const Location& where);
/// Moves the pigments that it has got.
void transform(Session& session, SkySphereDefinition& sky, const Transform& next, const Location& where);

/// Whether a fog of this type is one that lies on the ground.
bool is_ground_fog(Session& session, double type, const Location& where);
/// A mere number is the distance.
void set_colour_or_distance(Session& session, Fog& fog, const Quantity& value, const Location& where);
/// As in POV-Ray, only the direction of its heights turns.
void transform(Fog& fog, const Transform& next);
/// 0 if it has no direction.
void set_up(Fog& fog, const Vec3& up);
/// Makes a complete fog black where POV-Ray divides by zero for it.
void settle(Session& session, Fog& fog, const Location& where);

// Textures as they were before version 3.0 (old_textures.cpp)

/// A mere number is how grainy the texture is.
TexturePtr with_old_colour(Session& session, const TexturePtr& texture, const Quantity& colour);
/// Gives the texture's normal, or else its pigment, the pattern of a word. `number`: what stands behind it,
/// as the depth of bumps.
TexturePtr with_old_pattern(Session& session, const TexturePtr& texture, int pattern,
                            std::optional<double> number);
/// Changes the pattern of the texture's pigment.
TexturePtr with_old_pattern(Session& session, const TexturePtr& texture, const PatternChange& change);
/// Changes the waves of the texture's normal.
TexturePtr with_old_waves(Session& session, const TexturePtr& texture, const PatternChange& change);
TexturePtr with_old_finish(const TexturePtr& texture, const std::function<void(FinishDefinition&)>& change);

TexturePtr with_old_colours(Session& session, const TexturePtr& texture, int pattern, const PigmentMap& list,
                            const Location& where);
TexturePtr with_old_map(Session& session, const TexturePtr& texture, const PigmentMap& map,
                        const Location& where);

// Maps and lists (maps.cpp)

void add(Session& session, PigmentMap& map, double position, const PigmentDefinition& pigment,
         const Location& where);
void add(Session& session, NormalMap& map, double position, const NormalDefinition& normal,
         const Location& where);
void add(Session& session, TextureMap& map, double position, const TexturePtr& texture,
         const Location& where);
void add(Session& session, PigmentMap& map, double position, const Pigment& colour, const Location& where);
void add_colour(Session& session, PigmentMap& map, double position, const Quantity& colour,
                const Location& where);
/// The entries of another one, behind its own.
void add(Session& session, PigmentMap& map, const PigmentMap& entries, const Location& where);

void add(Session& session, std::vector<SlopePoint>& map, double position, const Vec3& height_and_slope,
         const Location& where);
/// With positions as maps have them.
std::vector<SlopePoint> ascending(std::vector<SlopePoint> map);

void set_map(Session& session, PigmentDefinition& pigment, const PigmentMap& map, const Location& where);
/// As before version 3.0 the pattern may follow the map.
void set_old_map(Session& session, PigmentDefinition& pigment, const PigmentMap& map, const Location& where);
void set_map(Session& session, NormalDefinition& normal, const NormalMap& map, const Location& where);
TexturePtr with_map(Session& session, const TexturePtr& texture, const TextureMap& map,
                    const Location& where);
/// Gives a list to a pattern that takes one. Where it is too short, POV-Ray's colours or the defaults follow.
void set_colours(Session& session, PigmentDefinition& pigment, int pattern, PigmentMap list,
                 const Location& where);
void set_list(Session& session, PigmentDefinition& pigment, int pattern, PigmentMap list,
              const Location& where);
void set_list(Session& session, NormalDefinition& normal, int pattern, NormalMap list, const Location& where);
// The same for the pattern of an object.
void set_colours(Session& session, PigmentDefinition& pigment, const Limit& object, PigmentMap list,
                 const Location& where);
void set_list(Session& session, PigmentDefinition& pigment, const Limit& object, PigmentMap list,
              const Location& where);
void set_list(Session& session, NormalDefinition& normal, const Limit& object, NormalMap list,
              const Location& where);
TexturePtr with_pattern(Session& session, const TexturePtr& texture, const PatternChange& pattern);
TexturePtr with_list(Session& session, const TexturePtr& texture, int pattern, TextureMap list,
                     const Location& where);
/// Of the checker pattern: where that has its first colour, `second` is, as in POV-Ray.
TexturePtr with_tiles(Session& session, const TexturePtr& texture, const TexturePtr& first,
                      const TexturePtr& second, const Location& where);

/// Of the pattern of an object.
TexturePtr with_object(Session& session, const TexturePtr& texture, const Limit& object, TextureMap list,
                       const Location& where);

// Fail if a pattern lacks what it needs.
void check(Session& session, const PigmentDefinition& pigment, const Location& where);
/// Also settles what an `accuracy` of 0 comes to.
void check(Session& session, NormalDefinition& normal, const Location& where);
void check(Session& session, const TexturePtr& texture, const Location& where);

/// The inside of reflection { }. What it does not say stays as the finish has it.
struct ReflectionDefinition {
  Vec3 min{0, 0, 0};
  Vec3 max{0, 0, 0};
  bool has_min = false;
  std::optional<double> falloff, exponent, metallic;
  std::optional<bool> is_fresnel;

  void set(const Vec3& only);
  void set(const Vec3& first, const Vec3& second);
  void apply(Finish& finish) const;
};

/// The old form, one colour.
void set_diffuse(FinishDefinition& finish, bool is_albedo, double before, double behind);
/// Makes of albedos, the shares of light that are sent on to all sides together, what the formulas take.
void settle_albedos(FinishDefinition& finish);
void set_reflection(Finish& finish, const Vec3& colour);
double roughness(Session& session, double value, const Location& where);
double exponent(Session& session, double value, const Location& where);
/// 1 for 0, as in POV-Ray; negative ones are taken.
double ior(Session& session, double value, const Location& where);
/// Nothing unless it is positive.
std::optional<double> ior_of_finish(Session& session, double value, const Location& where);

// ---- Objects ----

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
/// What an object has to have when it ends.
void check(Session& session, const ObjectDefinition& object, const Location& where);
/// The object, which has been read to its end.
ObjectPtr complete(Session& session, const std::shared_ptr<ObjectDefinition>& object, const Location& where);
/// The same for what has nothing to be checked.
ObjectPtr located(const std::shared_ptr<ObjectDefinition>& object, const Location& where);
/// What POV-Ray makes of a colour among an object's modifiers.
void ignore_colour(Session& session, const Location& where);
/// The same of a name; fails if that is no colour's. Must come before the next token.
void ignore_colour_name(Session& session, const Quantity& value, const Location& where);
/// Adds what stands behind other arguments without a comma: that may also be the name of a colour, which is
/// such a modifier where the shape is complete.
void append_argument(Session& session, WrittenShape& written, const ShapeArgument& argument);
std::shared_ptr<ObjectDefinition> shape(Session& session, const WrittenShape& written);
/// The same with `open` behind the arguments, or with a comma.
std::shared_ptr<ObjectDefinition> open_shape(Session& session, WrittenShape written);
std::shared_ptr<ObjectDefinition> shape_with_comma(Session& session, WrittenShape written,
                                                   const Location& comma);
/// With POV-Ray's defaults: no direction, as far away as can be, and an arc without an end.
std::shared_ptr<RainbowDefinition> new_rainbow();
void set_colours(Rainbow& rainbow, const PigmentMap& map);
/// What a rainbow has to have.
void check(Session& session, const Rainbow& rainbow, const Location& where);
std::shared_ptr<ObjectDefinition> csg(Session& session, Compound compound, const Location& where);
/// Of a light group.
void set_global_lights(ObjectDefinition& object, bool are_on);
/// What a name stands for that is given to an object.
ObjectPtr declared(const ObjectPtr& object);
/// An object that other ones can be limited by.
ObjectPtr limiting(Session& session, const ObjectPtr& object, const Location& where);
/// What a pattern takes the inside of; `object` has been moved.
pattern::Inside inside_of(Session& session, const Limit& object, const Location& where);
/// Adds to one of the object's own lists of limits.
void limit(Session& session, ObjectDefinition& object, std::vector<Limit>& list,
           const std::vector<Limit>& added, const Location& where);
void apply(Session& session, const std::shared_ptr<const MaterialDefinition>& material,
           ObjectDefinition& object, const Location& where);

// ---- Meshes ----

std::shared_ptr<ObjectDefinition>
lone_triangle(Session& session, std::shared_ptr<TriangleDefinition> triangle, const Location& where);
void add_triangle(Session& session, MeshBuilder& builder, const TriangleDefinition& triangle,
                  const Location& where);
std::shared_ptr<TriangleDefinition> flat_triangle(const Quantity& a, const Quantity& b, const Quantity& c);
std::shared_ptr<TriangleDefinition> smooth_triangle(const std::array<Quantity, 3>& corners,
                                                    const std::array<Quantity, 3>& normals);
/// Of a mesh2; fails unless there are as many as announced.
void set_textures(Session& session, Mesh2Definition& mesh, double count, std::vector<TexturePtr> textures,
                  const Location& where);
/// Fails unless they are three.
void set_textures(Session& session, TriangleDefinition& triangle, const std::vector<TexturePtr>& textures,
                  const Location& where);
/// Fails unless they are finite.
void set_coordinates(Session& session, TriangleDefinition& triangle, const std::array<Vec3, 3>& uv,
                     const Location& where);
/// Fails unless it is finite.
Vec3 inside_vector(Session& session, const Quantity& vector, const Location& where);
std::shared_ptr<ObjectDefinition> mesh(Session& session, MeshBuilder& builder, const Location& where);
std::shared_ptr<ObjectDefinition> mesh2(Session& session, Mesh2Definition& definition, const Location& where);
/// Checks the count that leads a list of mesh2.
void check_count(Session& session, double announced, std::size_t found, const Location& where);
/// The list without the count that leads it, which must be right.
CountedList counted(Session& session, std::vector<ListEntry>& list, const Location& where);
/// The same for face_indices, where only the vectors count.
CountedList faces(Session& session, std::vector<ListEntry>& list, const Location& where);
/// The same where every entry must be finite.
CountedList vectors(Session& session, std::vector<ListEntry>& list, const Location& where);

// ---- What is not supported ----

std::string quoted(Session& session, NameId name);
std::string quoted_pattern(int pattern);
UnsupportedPtr make_unsupported(const std::string& what, const Location& where);
/// Passes over what belongs to it, too.
UnsupportedPtr unsupported_feature(Session& session, const std::string& what, const Location& where);
/// Null for zero.
/// Whether the picture will have what POV-Ray renders from quality 9 on: media, photons and radiosity.
bool renders_media(const Session& session);
/// A word with a block in braces, which is not passed over; nothing if it means nothing at the picture's
/// quality.
UnsupportedPtr unsupported_block(Session& session, NameId word, const Location& where);
UnsupportedPtr unless_zero(const std::string& what, double value, const Location& where);
/// An object that is left out, or refused, where it is placed.
ObjectPtr unsupported_object(const std::string& what, const Location& where);

} // namespace celltrace::pov
