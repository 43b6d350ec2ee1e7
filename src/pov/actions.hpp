// Actions of the grammar's rules that take more than a line.
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

/// Adds to a list of the scene; fails if a loop would make the list endless.
template <class T, class A, class U = T>
void append(Session& session, std::vector<T, A>& list, U&& element, const Location& where) {
  if (list.size() >= session.options.limits.list_entries)
    session.exceed(where, &ParseLimits::list_entries, "this list has", "entries");
  list.push_back(std::forward<U>(element));
}

// ---- Numbers ----

/// Returns whether a quantity has the component with this number (Names::Entry::component).
bool has_component(const Quantity& quantity, int which);
/// Returns the component that a word behind a dot names, as in v.x or c.red.
double component(Session& session, const Quantity& quantity, int which, const Location& where);
/// Adds a component to a vector that is being read.
void append_component(Session& session, Quantity& vector, double component, const Location& where);
Transform scale(Session& session, const Quantity& factors, const Location& where);
Transform matrix(Session& session, const std::vector<ListEntry>& numbers, const Location& where);
/// The contents of transform { }.
struct WrittenTransform {
  Transform items;
  bool is_inverse = false;
};
Transform complete(Session& session, const WrittenTransform& written, const Location& where);

/// Divides; warns of a division by zero, which gives an infinity.
Quantity divided(Session& session, const Quantity& a, const Quantity& b, const Location& where);

/// Converts a colour from sRGB to the space of the scene's colours. The scene's assumed_gamma, which sets
/// that space, must be known by now.
Quantity decoded(Session& session, const Quantity& colour, const Location& where);

// ---- Arrays (arrays.cpp) ----

/// Returns a deep copy: arrays are values.
std::shared_ptr<Array> copy(Session& session, const Array& array, const Location& where);
Array to_array(const std::vector<Quantity>& numbers);
std::size_t array_size(Session& session, double size, const Location& where);
/// Returns an array of the given dimensions from `level` on, without values.
std::shared_ptr<Array> make_array(Session& session, const std::vector<std::size_t>& dimensions,
                                  std::size_t level, const Location& where);
/// Returns an array as make_array() does, with the given elements, which must fit it.
std::shared_ptr<Array> filled_array(Session& session, const std::vector<std::size_t>& dimensions,
                                    const std::shared_ptr<Array>& elements, const Location& where);
int dimensions(const Array& array);
/// Returns the size of a dimension; 0 if the array does not have that dimension.
double dimension_size(const Array& array, double dimension);

// ---- Functions and splines ----

Quantity call(Session& session, const UserFunction& function, const std::vector<Value>& arguments,
              const Location& where);
/// Returns the point where a ray hits the object, or 0. Also writes the normal there, or 0, to the name
/// `normal`.
Quantity trace(Session& session, const ObjectDefinition& object, const Quantity& origin,
               const Quantity& direction, std::optional<NameId> normal, const Location& where);
void add(Session& session, Spline& spline, double at, const Quantity& value, const Location& where);
/// Returns the spline; fails if it has no knots.
SplinePtr finished(Session& session, const std::shared_ptr<Spline>& spline, const Location& where);

// ---- Scene ----

void set_assumed_gamma(Session& session, double gamma, const Location& where);
/// Sets how colours are encoded; without a gamma, as sRGB. As in POV-Ray, a scene's first setting counts.
void set_assumed_gamma(Session& session, std::optional<double> gamma, const Location& where);
void set_max_trace_level(Session& session, double level, const Location& where);
void set_noise_generator(Session& session, double number, const Location& where);
void set_adc_bailout(Session& session, double share, const Location& where);
void set_number_of_waves(Session& session, double number, const Location& where);

// ---- Textures ----

/// The effect that a pattern's word, or a modifier such as `frequency 2`, has on a pattern.
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
/// Returns the change to a fractal pattern. `constant` is Julia's, or null for the Mandelbrot set; `magnet`
/// is 0, 1 or 2.
PatternChange fractal(Session& session, double magnet, const Quantity* constant, double iterations,
                      const Location& where);
/// Gives a fractal as many iterations as can be counted. For a number below 0, POV-Ray's value is 0.55
/// everywhere.
void set_iterations(Session& session, pattern::Fractal& fractal, double number, const Location& where);
/// Returns the change to the magnet of this kind; `pattern` is the Mandelbrot set.
PatternChange magnet(Session& session, double kind, int pattern, const Quantity& iterations,
                     const Location& where);
/// Returns the change to a slope pattern; fails if the slope has neither a direction nor an altitude.
PatternChange slope(Session& session, const pattern::Slope& slope, const Location& where);
/// Sets a range of a slope; if its width would be 0, the range stays 0 to 1.
void set_range(double& from, double& to, double least, double most);
/// Returns the change of an integer that only fractals have; fails unless the value is 0 to `most`.
PatternChange set_fractal(int pattern::Fractal::*member, double value, int most, const Location& where);
/// Returns the change of a fractal's power; as in POV-Ray, the power is 2 if the value is not 2 to 33.
PatternChange fractal_exponent(double value, const Location& where);
PatternChange exterior(double type, double factor, const Location& where);
PatternChange interior(double type, double factor, const Location& where);
/// Returns the change to the grey value of a pigment.
PatternChange grey(const PigmentDefinition& pigment);
PatternChange unsupported_change(const UnsupportedPtr& unsupported);
PatternChange warp(const SpaceStep& warp, const Location& where);
/// Moves a black hole's copies so far apart that they do not overlap.
void keep_apart(Session& session, warp::BlackHole& hole, const Location& where);
/// Returns a repetition along the only axis for which `width` is not 0.
warp::Repeat repeat(Session& session, const Vec3& width, const Location& where);
/// Returns the offset of a repetition; `option`, the word before it, has to be "offset".
Vec3 offset(Session& session, int option, const Quantity& value, const Location& where);
/// Returns the warp that a pattern's word stands for.
warp::Mapping mapping(Session& session, int pattern, const Location& where);
/// Returns the value; fails unless it is positive.
double positive(Session& session, double value, const char* what, const Location& where);
int octaves(double number);
/// Returns the number of a noise generator; 0 for the scene's.
int noise_generator(Session& session, double number, const Location& where);

/// Applies a change, unless the pattern is on surface coordinates.
void change(Session& session, PatternDefinition& pattern, const PatternChange& change);
TexturePtr changed(Session& session, const TexturePtr& texture, const PatternChange& change,
                   const Location& where);
/// Fails for a texture whose pattern is one of textures, or which is on surface coordinates: such a texture
/// has no pigment, normal or finish of its own.
void require_plain(Session& session, const TexturePtr& texture, const Location& where);
/// Returns `given` as a layer on `below`, which may be null. Fails for textures that cannot be layers. Up to
/// version 3.1, a layer on another one transmits what it filters.
TexturePtr layer(Session& session, const TexturePtr& below, const TexturePtr& given, const Location& where);
TexturePtr transformed(Session& session, const TexturePtr& texture, const Transform& next,
                       const Location& where);

void set_colour(PigmentDefinition& pigment, const Pigment& colour);
/// Sets the colour that replaces the pigment in pictures of low quality.
void set_quick_colour(Session& session, PigmentDefinition& pigment, const Pigment& colour);

/// Adds a layer to the sky; fails if the pigment depends on a surface, which a sky lacks.
void add_layer(Session& session, SkySphereDefinition& sky, const PigmentDefinition& pigment,
               const Location& where);
/// Moves the pigments that the sky has so far.
void transform(Session& session, SkySphereDefinition& sky, const Transform& next, const Location& where);

bool is_ground_fog(Session& session, double type, const Location& where);
/// Sets a fog's colour or, from a single number, its distance.
void set_colour_or_distance(Session& session, Fog& fog, const Quantity& value, const Location& where);
/// Transforms a fog; as in POV-Ray, only its up direction turns.
void transform(Fog& fog, const Transform& next);
/// Sets the up direction of a fog; 0 if the vector has no direction.
void set_up(Fog& fog, const Vec3& up);
/// Makes a complete fog black where POV-Ray would divide by zero.
void settle(Session& session, Fog& fog, const Location& where);

// Textures as they were before version 3.0 (old_textures.cpp)

/// Returns the texture with a colour; a single number is the texture's graininess.
TexturePtr with_old_colour(Session& session, const TexturePtr& texture, const Quantity& colour);
/// Gives the texture's normal, or else its pigment, the pattern of a word. `number` is the number after the
/// word, such as the depth of bumps.
TexturePtr with_old_pattern(Session& session, const TexturePtr& texture, int pattern,
                            std::optional<double> number);
/// Returns the texture with a change to the pattern of its pigment.
TexturePtr with_old_pattern(Session& session, const TexturePtr& texture, const PatternChange& change);
/// Returns the texture with a change to the waves of its normal.
TexturePtr with_old_waves(Session& session, const TexturePtr& texture, const PatternChange& change);
TexturePtr with_old_finish(const TexturePtr& texture, const std::function<void(FinishDefinition&)>& change);

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
/// Appends the entries of another map.
void add(Session& session, PigmentMap& map, const PigmentMap& entries, const Location& where);

void add(Session& session, std::vector<SlopePoint>& map, double position, const Vec3& height_and_slope,
         const Location& where);
/// Returns the map with positions as maps have them: ascending.
std::vector<SlopePoint> ascending(std::vector<SlopePoint> map);

void set_map(Session& session, PigmentDefinition& pigment, const PigmentMap& map, const Location& where);
/// Sets the map; its pattern may follow, as before version 3.0.
void set_old_map(Session& session, PigmentDefinition& pigment, const PigmentMap& map, const Location& where);
void set_map(Session& session, NormalDefinition& normal, const NormalMap& map, const Location& where);
TexturePtr with_map(Session& session, const TexturePtr& texture, const TextureMap& map,
                    const Location& where);
/// Gives a list to a pattern that takes one. If the list is too short, POV-Ray's colours or the defaults
/// follow.
void set_colours(Session& session, PigmentDefinition& pigment, int pattern, PigmentMap list,
                 const Location& where);
void set_list(Session& session, PigmentDefinition& pigment, int pattern, PigmentMap list,
              const Location& where);
void set_list(Session& session, NormalDefinition& normal, int pattern, NormalMap list, const Location& where);
TexturePtr with_pattern(Session& session, const TexturePtr& texture, const PatternChange& pattern);
TexturePtr with_list(Session& session, const TexturePtr& texture, int pattern, TextureMap list,
                     const Location& where);
/// Returns a texture in the checker pattern; as in POV-Ray, `second` takes the places of checker's first
/// colour.
TexturePtr with_tiles(Session& session, const TexturePtr& texture, const TexturePtr& first,
                      const TexturePtr& second, const Location& where);

/// Returns a texture in the pattern of an object.
TexturePtr with_object(Session& session, const TexturePtr& texture, const Limit& object, TextureMap list,
                       const Location& where);

// Fails if a pattern lacks something that it needs.
void check(Session& session, const PigmentDefinition& pigment, const Location& where);
/// Fails as above, and resolves an `accuracy` of 0.
void check(Session& session, NormalDefinition& normal, const Location& where);
void check(Session& session, const TexturePtr& texture, const Location& where);

/// The contents of reflection { }; the finish keeps all properties that are not given here.
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

/// Sets the old form of reflection, one colour.
void set_diffuse(FinishDefinition& finish, bool is_albedo, double before, double behind);
/// Converts albedos, the shares of light that a surface scatters in all directions together, to the factors
/// of the shading formulas.
void settle_albedos(FinishDefinition& finish);
void set_reflection(Finish& finish, const Vec3& colour);
double roughness(Session& session, double value, const Location& where);
double exponent(Session& session, double value, const Location& where);
/// Returns an index of refraction: 1 for 0, as in POV-Ray; negative values are accepted.
double ior(Session& session, double value, const Location& where);
/// Returns the index of refraction; nothing unless it is positive.
std::optional<double> ior_of_finish(Session& session, double value, const Location& where);

// ---- Objects ----

/// Counts `part` as nested in `object`.
void nest(Session& session, ObjectDefinition& object, const ObjectDefinition& part, const Location& where);
/// Returns the texture that an object's pigment, normal or finish changes.
TexturePtr texture_of(Session& session, const ObjectDefinition& object);
/// Returns the same texture; fails unless it has a pigment, normal and finish of its own.
TexturePtr plain_texture_of(Session& session, const ObjectDefinition& object, const Location& where);
void set_texture(ObjectDefinition& object, const TexturePtr& texture);
void add_layer(Session& session, ObjectDefinition& object, const TexturePtr& top, const Location& where);
/// Puts an object's textures on its surface coordinates. Fails if the object has a texture already.
void set_uv_mapping(Session& session, ObjectDefinition& object, const Location& where);
/// Gives parts of an intersection or difference without a texture the texture of the parts that they cut
/// (cutaway_textures.cpp).
void set_cutaway_textures(Session& session, ObjectDefinition& object, const Location& where);
/// Adds a layer to the texture of the object's inside.
void set_inside(Session& session, ObjectDefinition& object, const TexturePtr& top, const Location& where);
/// Fails if a complete object lacks something that it needs.
void check(Session& session, const ObjectDefinition& object, const Location& where);
/// Warns that a colour among an object's modifiers is ignored, as in POV-Ray.
void ignore_colour(Session& session, const Location& where);
/// Adds an argument that follows others without a comma. A colour after a complete shape counts as an object
/// modifier, which is ignored.
void append_argument(Session& session, WrittenShape& written, const ShapeArgument& argument);
std::shared_ptr<ObjectDefinition> shape(Session& session, const WrittenShape& written);
/// Returns a rainbow with POV-Ray's defaults: no direction, the greatest distance, and a full arc.
std::shared_ptr<RainbowDefinition> new_rainbow();
void set_colours(Rainbow& rainbow, const PigmentMap& map);
/// Fails if a rainbow lacks something that it needs.
void check(Session& session, const Rainbow& rainbow, const Location& where);
std::shared_ptr<ObjectDefinition> csg(Session& session, Compound compound, const Location& where);
/// Sets whether the global lights shine on a light group.
void set_global_lights(ObjectDefinition& object, bool are_on);
/// Returns the object that a name stands for, once the object gets a name.
ObjectPtr declared(const ObjectPtr& object);
/// Returns an object by which others can be limited; fails if they cannot.
ObjectPtr limiting(Session& session, const ObjectPtr& object, const Location& where);
/// Returns a pattern of an object's inside; `object` has been moved to its place.
pattern::Inside inside_of(Session& session, const Limit& object, const Location& where);
void limit(Session& session, ObjectDefinition& object, std::vector<Limit>& list,
           const std::vector<Limit>& added, const Location& where);
void apply(Session& session, const std::shared_ptr<const MaterialDefinition>& material,
           ObjectDefinition& object, const Location& where);

// ---- Meshes ----

std::shared_ptr<ObjectDefinition>
lone_triangle(Session& session, std::shared_ptr<TriangleDefinition> triangle, const Location& where);
void add_triangle(Session& session, MeshBuilder& builder, const TriangleDefinition& triangle,
                  const Location& where);
/// Sets a triangle's textures; fails unless there are three.
void set_textures(Session& session, TriangleDefinition& triangle, const std::vector<TexturePtr>& textures,
                  const Location& where);
/// Sets a triangle's surface coordinates; fails unless they are finite.
void set_coordinates(Session& session, TriangleDefinition& triangle, const std::array<Vec3, 3>& uv,
                     const Location& where);
/// Returns the inside vector; fails unless it is finite.
Vec3 inside_vector(Session& session, const Quantity& vector, const Location& where);
std::shared_ptr<ObjectDefinition> mesh(Session& session, MeshBuilder& builder, const Location& where);
std::shared_ptr<ObjectDefinition> mesh2(Session& session, Mesh2Definition& definition, const Location& where);
/// Fails unless the count at the head of a list of mesh2 is right.
void check_count(Session& session, double announced, std::size_t found, const Location& where);
/// Returns the list without the count at its head, which must be right.
CountedList counted(Session& session, std::vector<ListEntry>& list, const Location& where);
/// Returns such a list of face_indices, where the count is the number of vectors.
CountedList faces(Session& session, std::vector<ListEntry>& list, const Location& where);
/// Returns such a list in which every entry must be finite.
CountedList vectors(Session& session, std::vector<ListEntry>& list, const Location& where);

// ---- What is not supported ----

std::string quoted(Session& session, NameId name);
std::string quoted_pattern(int pattern);
UnsupportedPtr make_unsupported(const std::string& what, const Location& where);
/// Returns a mark for a feature, and skips the feature's arguments.
UnsupportedPtr unsupported_feature(Session& session, const std::string& what, const Location& where);
/// Returns whether the picture includes effects that POV-Ray renders from quality 9 on: media, photons and
/// radiosity.
bool renders_media(const Session& session);
/// Returns the mark of a word with a block in braces, which is not skipped; nothing if the block has no
/// effect at the picture's quality.
UnsupportedPtr unsupported_block(Session& session, NameId word, const Location& where);
/// Returns the mark of a feature with this value; null for 0.
UnsupportedPtr unless_zero(const std::string& what, double value, const Location& where);
/// Returns an object that is left out, or an error, where it is placed.
ObjectPtr unsupported_object(const std::string& what, const Location& where);

} // namespace celltrace::pov
