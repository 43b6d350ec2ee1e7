#include "pov/actions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "celltrace/error.hpp"
#include "pov/bounds_check.hpp"
#include "pov/finite.hpp"
#include "pov/light.hpp"
#include "pov/object_queries.hpp"

namespace celltrace::pov {

namespace {

/// Of objects inside one another, as loops make them that add to a union. A level takes 1.3 KB of the stack.
constexpr int kDeepestObject = 1000;

constexpr std::size_t kMostKnots = 20000; // of a spline
constexpr int kMostType = 8;              // of what is counted of a fractal

/// The number that leads a list.
double list_count(Session& session, const std::vector<ListEntry>& list, const Location& where) {
  const ListEntry& count = list.front();
  if (!count.is_float) session.fail(where, "expected a float, found a vector");
  if (!is_finite(count.v)) session.fail(where, "this number is not finite");
  return count.v.x;
}

/// Exporters write meshes whose triangles are all degenerate.
void warn_if_empty(Session& session, const Mesh& mesh, const Location& where) {
  if (mesh.triangles.empty())
    session.diagnostics.warn_once(where,
                                  "this mesh has no triangle with an area: there is nothing to see of it");
}

std::shared_ptr<ObjectDefinition> make_object(std::shared_ptr<MeshDefinition> mesh) {
  auto object = std::make_shared<ObjectDefinition>();
  object->shape = std::move(mesh);
  return object;
}

} // namespace

double positive(Session& session, double value, const char* what, const Location& where) {
  if (!(value > 0)) session.fail(where, std::string(what) + " must be greater than 0");
  return value;
}

bool has_component(const Quantity& quantity, int which) {
  return which == kGreyComponent ? quantity.count >= 3 : which < quantity.count;
}

double component(Session& session, const Quantity& quantity, int which, const Location& where) {
  if (which == kGreyComponent) {
    if (!has_component(quantity, which)) session.fail(where, "only a colour has a grey value");
    return quantity.grey();
  }
  if (!has_component(quantity, which))
    session.fail(where, std::string(kind_name(quantity)) + " of " + std::to_string(quantity.count) +
                            " components has no such component");
  return quantity.v[static_cast<std::size_t>(which)];
}

void append_component(Session& session, Quantity& vector, double component, const Location& where) {
  if (vector.count == 5) session.fail(where, "a vector has at most five components");
  vector.v[static_cast<std::size_t>(vector.count++)] = component;
}

Quantity vector(Session& session, const Quantity& components, const Location& where) {
  if (components.is_float()) session.fail(where, "a vector has at least two components");
  return components;
}

Transform scale(Session& session, const Quantity& factors, const Location& where) {
  const Vec3 v = factors.vec3();
  if (v.x == 0 || v.y == 0 || v.z == 0)
    session.diagnostics.warn_once(where, "a scale by 0 counts as one by 1");
  return Transform::scale(v);
}

Quantity divided(Session& session, const Quantity& a, const Quantity& b, const Location& where) {
  const Quantity divisor = b.promoted(a.count);
  const auto* end = divisor.v.data() + divisor.count;
  if (std::find(divisor.v.data(), end, 0.0) != end) session.diagnostics.warn_once(where, "division by zero");
  return a / b;
}

namespace {

/// POV-Ray makes a scale by 1 of a column that is zero, as exporters write it for flat parts.
void replace_zero_columns(double (&values)[12], Session& session, const Location& where) {
  constexpr double kZero = 1e-10;
  for (std::size_t column = 0; column < 3; ++column) {
    const auto is_zero = [&](std::size_t row) { return std::fabs(values[3 * row + column]) < kZero; };
    if (!is_zero(0) || !is_zero(1) || !is_zero(2)) continue;
    session.diagnostics.warn_once(where, "a matrix with a column of zeros: it counts as a scale by 1");
    values[3 * column + column] = 1;
  }
}

} // namespace

Transform matrix(Session& session, const std::vector<ListEntry>& numbers, const Location& where) {
  if (numbers.size() != 12)
    session.fail(where, "a matrix has 12 numbers, not " + std::to_string(numbers.size()));
  double values[12];
  for (std::size_t i = 0; i < 12; ++i) {
    const ListEntry& entry = numbers[i];
    if (!entry.is_float) session.fail(where, "expected a float, found a vector");
    values[i] = entry.v.x;
  }
  replace_zero_columns(values, session, where);
  return Transform::matrix(values);
}

Transform complete(Session& session, const WrittenTransform& written, const Location& where) {
  if (!written.is_inverse || !is_finite(written.items)) return written.items;
  try {
    return written.items.inverse();
  } catch (const InputError&) {
    session.fail(where, "this transformation is singular: it has no inverse");
  }
}

Quantity decoded(Session& session, const Quantity& colour, const Location& where) {
  if (!session.builder.gamma_is_given())
    session.fail(where, "colours in sRGB need an 'assumed_gamma' in front of them");
  Quantity result = colour;
  for (std::size_t i = 0; i < 3; ++i)
    result.v[i] = session.builder.from_srgb(colour.v[i]);
  return result;
}

Quantity call(Session& session, const UserFunction& function, const std::vector<Value>& arguments,
              const Location& where) {
  check_argument_count(session, function, arguments.size(), where);
  double numbers[kMostParameters];
  std::transform(arguments.begin(), arguments.end(), numbers, [&](const Value& argument) {
    const auto* quantity = std::get_if<Quantity>(&argument);
    if (!quantity)
      session.fail(where, std::string("the arguments of a function are floats, not ") + kind_name(argument));
    return session.any_number(*quantity, where);
  });
  return call_function(session, function, numbers, arguments.size(), where);
}

Quantity trace(Session& session, const ObjectDefinition& object, const Quantity& origin,
               const Quantity& direction, std::optional<NameId> normal, const Location& where) {
  const ObjectHit hit =
      trace(session, object, session.vector(origin, where), session.vector(direction, where), where)
          .value_or(ObjectHit{Vec3(0), Vec3(0)});
  if (normal) session.symbols.declare(*normal, Quantity::vector(hit.normal));
  return Quantity::vector(hit.point);
}

void add(Session& session, Spline& spline, double at, const Quantity& value, const Location& where) {
  if (spline.size() >= kMostKnots) session.fail(where, "this spline is too long");
  spline.add(at, value);
}

SplinePtr finished(Session& session, const std::shared_ptr<Spline>& spline, const Location& where) {
  if (spline->size() == 0) session.fail(where, "this spline has no vectors");
  return spline;
}

void set_assumed_gamma(Session& session, double gamma, const Location& where) {
  set_assumed_gamma(session, std::optional(positive(session, gamma, "assumed_gamma", where)), where);
}

void set_assumed_gamma(Session& session, std::optional<double> gamma, const Location& where) {
  if (session.builder.gamma_is_given())
    session.diagnostics.warn_once(where,
                                  "this assumed_gamma is ignored: the first one of a scene is its gamma");
  else
    session.builder.set_assumed_gamma(gamma);
}

void set_max_trace_level(Session& session, double level, const Location& where) {
  constexpr double kMost = 256;
  if (level > kMost) session.diagnostics.warn(where, "max_trace_level is 256, which is the most there is");
  session.builder.set_max_trace_level(level >= 1 ? static_cast<int>(std::min(level, kMost)) : 1);
}

void set_adc_bailout(Session& session, double share, const Location& where) {
  if (share > 1)
    session.diagnostics.warn_once(where, "an adc_bailout above 1 cuts all rays: the picture is black");
  session.builder.set_adc_bailout(share);
}

void set_noise_generator(Session& session, double number, const Location& where) {
  if (!(number >= 1 && number < 4)) session.fail(where, "there are noise generators 1, 2 and 3");
  session.builder.set_noise_generator(static_cast<int>(number));
}

void set_number_of_waves(Session& session, double number, const Location& where) {
  constexpr double kMost = 1000;
  if (!(number < kMost + 1)) session.fail(where, "there are at most 1000 waves");
  session.builder.set_number_of_waves(static_cast<int>(std::max(number, 1.0)));
}

void set_photons(Session& session, const Location& where) {
  if (renders_media(session)) session.builder.set_photons(make_unsupported("'photons'", where));
  session.tokens.skip_group();
}

void refuse_radiosity(Session& session, const Location& where) {
  if (renders_media(session)) session.diagnostics.supports(make_unsupported("'radiosity'", where), where);
  session.tokens.skip_group();
}

void refuse_block(Session& session, NameId word, const Location& where) {
  session.diagnostics.supports(unsupported_block(session, word, where), where);
  session.tokens.skip_group();
}

void set_unsupported_default(Session& session, NameId word, const Location& where) {
  TexturePtr& texture = session.builder.default_texture;
  texture = with_unsupported(texture, unsupported_block(session, word, where));
  session.tokens.skip_group();
}

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

void start_from(Session& session, const TexturePtr& texture) {
  session.base_texture = texture;
}

void start_from(Session& session, const ObjectDefinition& object, const Location& where) {
  session.base_texture = plain_texture_of(session, object, where);
}

void start_interior(Session& session, const ObjectDefinition& object) {
  session.base_interior = object.interior;
}

void start_from(Session& session, const MaterialDefinition& material) {
  session.base_interior = material.interior;
}

void dress(Session& session, ObjectDefinition& object, const PigmentDefinition& pigment) {
  set_texture(object, with_pigment(texture_of(session, object), pigment));
}

void dress(Session& session, ObjectDefinition& object, const NormalPtr& normal) {
  set_texture(object, with_normal(texture_of(session, object), normal));
}

void dress(Session& session, ObjectDefinition& object, const FinishDefinition& finish) {
  set_texture(object, with_finish(texture_of(session, object), finish));
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

void start_irid(Session& session, FinishDefinition& finish, double amount) {
  finish.value.irid = amount;
  session.irid = &finish.value;
}

void transform(Session& session, MaterialDefinition& material, const Transform& next, const Location& where) {
  for (TexturePtr* texture : {&material.texture, &material.inside})
    if (*texture) *texture = transformed(session, *texture, next, where);
}

PatternChange chosen(int number) {
  return [=](Session&, PatternDefinition& pattern) { choose(pattern, number); };
}

PatternChange chosen(int number, const Quantity& argument, const Location& where) {
  return [=](Session& session, PatternDefinition& pattern) {
    choose(pattern, number);
    set_argument(session, pattern, argument, where);
  };
}

PatternChange poly_wave(double exponent) {
  return [=](Session&, PatternDefinition& pattern) {
    pattern.own().wave = Pattern::Wave::poly;
    pattern.own().wave_exponent = exponent;
  };
}

PatternChange option(int number, const Quantity& value, const Location& where) {
  return [=](Session& session, PatternDefinition& pattern) {
    set_option(session, pattern, number, value, where);
  };
}

namespace {

/// `constant`: Julia's, or null for the Mandelbrot set. `magnet`: 0, 1 or 2.
PatternChange fractal(Session& session, double magnet, const Quantity* constant, double iterations,
                      const Location& where) {
  pattern::Fractal fractal;
  if (magnet != 0 && magnet != 1 && magnet != 2) session.fail(where, "a magnet is of kind 1 or 2");
  fractal.magnet = static_cast<int>(magnet);
  if (constant) {
    const Vec3 c = session.vector(*constant, where);
    fractal.is_julia = true;
    fractal.c[0] = c.x;
    fractal.c[1] = c.y;
  }
  set_iterations(session, fractal, iterations, where);
  return [=](Session&, PatternDefinition& pattern) { choose(pattern, fractal); };
}

} // namespace

PatternChange julia(Session& session, double magnet, const Quantity& constant, double iterations,
                    const Location& where) {
  return fractal(session, magnet, &constant, iterations, where);
}

void set_iterations(Session& session, pattern::Fractal& fractal, double number, const Location& where) {
  constexpr double kMost = 65535, kBelowZero = 0.55;
  if (number <= -1) {
    session.diagnostics.warn_once(where, "a fractal with less than 0 iterations is 0.55 everywhere");
    fractal.interior_factor = kBelowZero;
  }
  if (number >= kMost + 1)
    session.diagnostics.warn_once(where, "this fractal has 65535 iterations, which is the most there is");
  fractal.iterations = static_cast<int>(std::clamp(number, 0.0, kMost));
}

PatternChange magnet(Session& session, double kind, int pattern, const Quantity& iterations,
                     const Location& where) {
  if (std::string(pattern_words()[static_cast<std::size_t>(pattern)].word) != "mandel")
    session.fail(where, "expected 'mandel' or 'julia'");
  return fractal(session, kind, nullptr, session.number(iterations, where), where);
}

PatternChange slope(Session& session, const pattern::Slope& slope, const Location& where) {
  if (slope.direction == Vec3(0) && slope.altitude == Vec3(0))
    session.fail(where, "this slope has neither a direction nor an altitude");
  return [=](Session&, PatternDefinition& pattern) { choose(pattern, slope); };
}

void set_range(double& from, double& to, double least, double most) {
  from = least == most ? 0 : least;
  to = least == most ? 1 : most;
}

PatternChange set_fractal(int pattern::Fractal::*member, double value, int most, const Location& where) {
  return [=](Session& session, PatternDefinition& pattern) {
    if (!std::holds_alternative<pattern::Fractal>(pattern.value().kind))
      session.fail(where, "this word means something to fractals only");
    if (!(value >= 0 && value < most + 1))
      session.fail(where, "this number must lie between 0 and " + std::to_string(most));
    std::get<pattern::Fractal>(pattern.own().kind).*member = static_cast<int>(value);
  };
}

PatternChange fractal_exponent(double value, const Location& where) {
  return [=](Session& session, PatternDefinition& pattern) {
    constexpr int kLeast = 2, kMost = 33;
    const bool is_known = value >= kLeast && value < kMost + 1;
    if (!is_known)
      session.diagnostics.warn_once(where, "a fractal's exponent is one of 2 to 33: this one counts as 2");
    set_fractal(&pattern::Fractal::exponent, is_known ? value : kLeast, kMost, where)(session, pattern);
  };
}

PatternChange exterior(double type, double factor, const Location& where) {
  return [=](Session& session, PatternDefinition& pattern) {
    set_fractal(&pattern::Fractal::exterior, type, kMostType, where)(session, pattern);
    std::get<pattern::Fractal>(pattern.own().kind).exterior_factor = factor;
  };
}

PatternChange interior(double type, double factor, const Location& where) {
  return [=](Session& session, PatternDefinition& pattern) {
    set_fractal(&pattern::Fractal::interior, type, kMostType, where)(session, pattern);
    std::get<pattern::Fractal>(pattern.own().kind).interior_factor = factor;
  };
}

PatternChange grey(const PigmentDefinition& pigment) {
  return [=](Session&, PatternDefinition& pattern) {
    choose(pattern, pattern::Grey{std::make_shared<const Pigment>(pigment.finish())});
    pattern.inner_depth = std::max(pigment.depth(), 1);
    pattern.inner_asks_for_surface = pigment.asks_for_surface();
    mark(pattern.unsupported, pigment.first_unsupported());
  };
}

PatternChange unsupported_change(const UnsupportedPtr& unsupported) {
  return [=](Session&, PatternDefinition& pattern) { mark(pattern.unsupported, unsupported); };
}

PatternChange warp(Session& reading, SpaceStep warp, const Location& items_where, const Location& where) {
  if (auto* hole = std::get_if<warp::BlackHole>(&warp)) keep_apart(reading, *hole, items_where);
  return [=](Session& session, PatternDefinition& pattern) {
    const auto* mapping = std::get_if<warp::Mapping>(&warp);
    if (mapping != nullptr && mapping->orientation == Vec3(0))
      return move(session, pattern, spread_point(session, where), where);
    const auto* hole = std::get_if<warp::BlackHole>(&warp);
    if (hole == nullptr || hole->radius > 0)
      bend(session, pattern, warp, where);
    else
      session.diagnostics.warn_once(where, "a black hole whose radius is not above 0 bends nothing");
  };
}

void keep_apart(Session& session, warp::BlackHole& hole, const Location& where) {
  for (int i = 0; i < 3; ++i) {
    const double least = 2 * hole.radius + hole.turbulence[i];
    if (!(hole.repeat[i] > 0 && hole.repeat[i] < least)) continue;
    hole.repeat[i] = least;
    session.diagnostics.warn_once(where, "this black hole repeats less than its size apart: as far as that");
  }
}

warp::Repeat repeat(Session& session, const Vec3& width, const Location& where) {
  warp::Repeat repeat;
  int axes = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (width[axis] != 0) {
      repeat.axis = axis;
      repeat.width = width[axis];
      ++axes;
    }
  if (axes != 1) session.fail(where, "a warp repeats along one axis");
  return repeat;
}

Vec3 offset(Session& session, int option, const Quantity& value, const Location& where) {
  const std::string word = pattern_options()[static_cast<std::size_t>(option)].word;
  if (word != "offset") session.fail(where, '\'' + word + "' means nothing to this warp");
  return session.vector(value, where);
}

warp::Mapping mapping(Session& session, int pattern, const Location& where) {
  const auto shape = mapping_shape(pattern);
  if (!shape) session.fail(where, quoted_pattern(pattern) + " is no warp");
  warp::Mapping mapping;
  mapping.shape = *shape;
  return mapping;
}

warp::Mapping mapping(Session& session, int pattern, const Vec3& orientation, double distance,
                      const Location& where) {
  warp::Mapping result = mapping(session, pattern, where);
  result.orientation = orientation;
  result.distance = distance;
  return result;
}

int octaves(double number) {
  constexpr double kMostOctaves = 10;
  return static_cast<int>(std::clamp(number, 1.0, kMostOctaves));
}

int noise_generator(Session& session, double number, const Location& where) {
  if (!(number >= 0 && number < 4)) session.fail(where, "there are noise generators 1, 2 and 3");
  return static_cast<int>(number);
}

void change(Session& session, PatternDefinition& pattern, const PatternChange& change) {
  if (!is_on_surface(pattern)) change(session, pattern);
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

void add_layer(Session& session, SkySphereDefinition& sky, const PigmentDefinition& pigment,
               const Location& where) {
  if (pigment.asks_for_surface()) session.fail(where, "a sky_sphere has no surface for this pigment");
  append(session, sky.pigments, pigment, where);
}

void check(Session& session, const SkySphereDefinition& sky, const Location& where) {
  if (sky.pigments.empty() && !sky.unsupported) session.fail(where, "a sky_sphere needs a pigment");
}

void transform(Session& session, SkySphereDefinition& sky, const Transform& next, const Location& where) {
  for (PigmentDefinition& pigment : sky.pigments)
    move(session, pigment.pattern, next, where);
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

bool is_ground_fog(Session& session, double type, const Location& where) {
  const double whole = std::trunc(type);
  if (whole != 1 && whole != 2)
    session.diagnostics.warn_once(where, "there are fogs of type 1 and 2: this is one of type 1");
  return whole == 2;
}

void set_colour_or_distance(Session& session, Fog& fog, const Quantity& value, const Location& where) {
  if (value.is_float()) {
    fog.distance = session.number(value, where);
    return;
  }
  const Pigment colour = session.colour(value, where);
  fog.colour = colour.rgb;
  fog.filter = colour.filter;
  fog.transmit = colour.transmit;
}

void transform(Fog& fog, const Transform& next) {
  if (is_finite(next)) set_up(fog, next.direction(fog.up));
}

void set_up(Fog& fog, const Vec3& up) {
  const double length = glm::length(up);
  fog.up = length > 0 ? up / length : Vec3(0);
}

void settle(Session& session, Fog& fog, const Location& where) {
  if (!fog.is_ground || fog.distance == 0) return;
  const bool has_up = fog.up != Vec3(0);
  if (has_up && fog.altitude != 0) return;
  session.diagnostics.warn_once(where, has_up
                                           ? "a ground fog without 'fog_alt' is black where it is"
                                           : "a ground fog whose 'up' has no direction is black everywhere");
  constexpr double kThick = 1e-4, kThin = 1e-10;
  fog.is_ground = has_up;
  fog.altitude = kThin;
  fog.distance = kThick;
  fog.colour = Vec3(0);
  fog.filter = fog.transmit = 0;
  fog.turbulence.amount = Vec3(0);
}

std::shared_ptr<RainbowDefinition> new_rainbow() {
  // POV-Ray takes its default for radians.
  constexpr double kEndless = 360 * 180 / std::numbers::pi;
  constexpr double kFarthest = 1e7;
  auto rainbow = std::make_shared<RainbowDefinition>();
  rainbow->value.distance = kFarthest;
  rainbow->value.direction = Vec3(0);
  rainbow->value.arc_angle = rainbow->value.falloff_angle = kEndless;
  return rainbow;
}

void set_colours(Rainbow& rainbow, const PigmentMap& map) {
  rainbow.colours.clear();
  for (const auto& [position, pigment] : map.entries)
    rainbow.colours.push_back({position, pigment.rgb, pigment.filter, pigment.transmit});
}

void check(Session& session, const Rainbow& rainbow, const Location& where) {
  constexpr double kLeast = 1e-10;
  const double length = glm::length(rainbow.direction);
  if (length < kLeast) session.fail(where, "this rainbow's direction has no length");
  const Vec3 across = glm::cross(rainbow.direction, rainbow.up);
  if (glm::length(across) < kLeast * length)
    session.fail(where, "this rainbow's direction and 'up' are one line");
  const bool is_given = rainbow.falloff_angle < new_rainbow()->value.falloff_angle;
  if (is_given && rainbow.arc_angle < rainbow.falloff_angle)
    session.fail(where, "this rainbow's 'arc_angle' is less than its 'falloff_angle'");
}

void ReflectionDefinition::set(const Vec3& only) {
  max = only;
}

void ReflectionDefinition::set(const Vec3& first, const Vec3& second) {
  min = first;
  max = second;
  has_min = true;
}

void ReflectionDefinition::apply(Finish& finish) const {
  // A single colour is the whole range, except that Fresnel's law needs one.
  finish.reflection_min = has_min || is_fresnel.value_or(false) ? min : max;
  finish.reflection_max = max;
  finish.reflection_falloff = falloff.value_or(finish.reflection_falloff);
  finish.reflection_exponent = exponent.value_or(finish.reflection_exponent);
  finish.reflection_metallic = metallic.value_or(finish.reflection_metallic);
  finish.reflection_fresnel = is_fresnel.value_or(finish.reflection_fresnel);
}

void set_diffuse(FinishDefinition& finish, bool is_albedo, double before, double behind) {
  finish.value.diffuse = before;
  finish.value.diffuse_behind = behind;
  finish.diffuse_is_albedo |= is_albedo; // as POV-Ray has it, also if it is said again without
}

/// The formulas are POV-Ray's.
void settle_albedos(FinishDefinition& finish) {
  Finish& value = finish.value;
  if (finish.diffuse_is_albedo) {
    value.diffuse *= (value.brilliance + 1) / 2;
    value.diffuse_behind *= (value.brilliance + 1) / 2;
  }
  if (finish.phong_is_albedo) value.phong *= (value.phong_size + 1) / 2;
  if (finish.specular_is_albedo) {
    const double exponent = 1 / value.roughness;
    value.specular *= (exponent + 2) / (4 * (2 - std::exp2(-exponent / 2)));
  }
  finish.diffuse_is_albedo = finish.phong_is_albedo = finish.specular_is_albedo = false;
}

void set_reflection(Finish& finish, const Vec3& colour) {
  finish.reflection_min = colour;
  finish.reflection_max = colour;
}

double roughness(Session& session, double value, const Location& where) {
  // As in POV-Ray, where it becomes an exponent of 0.
  constexpr double kSameEverywhere = 1e30;
  if (value > 0) return value;
  session.diagnostics.warn_once(where, value == 0 ? "with a roughness of 0 the highlight is everywhere"
                                                  : "with a negative roughness the highlight is everywhere");
  return kSameEverywhere;
}

double exponent(Session& session, double value, const Location& where) {
  // The colour's power is its inverse.
  constexpr double kNothingBelowWhite = 1e-6;
  if (value != 0) return value;
  session.diagnostics.warn_once(where, "with an exponent of 0 nothing but white is reflected");
  return kNothingBelowWhite;
}

double ior(Session& session, double value, const Location& where) {
  if (value != 0) return value;
  session.diagnostics.warn_once(where, "an ior of 0 counts as 1: nothing is refracted");
  return 1;
}

std::optional<double> ior_of_finish(Session& session, double value, const Location& where) {
  if (value > 0) return value;
  session.diagnostics.warn_once(where, "an ior that is not above 0 is ignored in a finish");
  return std::nullopt;
}

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

ObjectPtr complete(Session& session, const std::shared_ptr<ObjectDefinition>& object, const Location& where) {
  object->where = where;
  check(session, *object, where);
  object->reaches_out_of_bounds = reaches_out_of_bounds(session, *object, where);
  return own_object(session, object, where);
}

ObjectPtr located(const std::shared_ptr<ObjectDefinition>& object, const Location& where) {
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

std::shared_ptr<ObjectDefinition> open_shape(Session& session, WrittenShape written) {
  written.is_open = true;
  return shape(session, written);
}

std::shared_ptr<ObjectDefinition> shape_with_comma(Session& session, WrittenShape written,
                                                   const Location& comma) {
  written.comma = comma;
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

std::shared_ptr<ObjectDefinition>
lone_triangle(Session& session, std::shared_ptr<TriangleDefinition> triangle, const Location& where) {
  session.builder.count_triangles(1, where);
  auto object = std::make_shared<ObjectDefinition>();
  object->shape = std::move(triangle);
  return object;
}

void add_triangle(Session& session, MeshBuilder& builder, const TriangleDefinition& triangle,
                  const Location& where) {
  session.builder.count_triangles(1, where);
  if (!triangle.is_finite())
    session.diagnostics.warn_once(where, "this triangle is flat or left out: a number of it is not finite");
  try {
    builder.add(triangle);
  } catch (const InputError& error) {
    session.fail(where, error.what());
  }
}

std::shared_ptr<TriangleDefinition> flat_triangle(const Quantity& a, const Quantity& b, const Quantity& c) {
  auto triangle = std::make_shared<TriangleDefinition>();
  triangle->vertices = {a.vec3(), b.vec3(), c.vec3()};
  return triangle;
}

std::shared_ptr<TriangleDefinition> smooth_triangle(const std::array<Quantity, 3>& corners,
                                                    const std::array<Quantity, 3>& normals) {
  auto triangle = flat_triangle(corners[0], corners[1], corners[2]);
  triangle->normals = {normals[0].vec3(), normals[1].vec3(), normals[2].vec3()};
  triangle->is_smooth = true;
  return triangle;
}

void set_textures(Session& session, Mesh2Definition& mesh, double count, std::vector<TexturePtr> textures,
                  const Location& where) {
  check_count(session, count, textures.size(), where);
  mesh.textures = std::move(textures);
}

void set_textures(Session& session, TriangleDefinition& triangle, const std::vector<TexturePtr>& textures,
                  const Location& where) {
  if (textures.size() != triangle.textures.size())
    session.fail(where, "the texture_list of a triangle has three textures, one for each corner");
  std::copy(textures.begin(), textures.end(), triangle.textures.begin());
}

void set_coordinates(Session& session, TriangleDefinition& triangle, const std::array<Vec3, 3>& uv,
                     const Location& where) {
  triangle.is_mapped = true;
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.coordinates[i] = Vec2f(uv[i]);
    if (std::isfinite(triangle.coordinates[i].x) && std::isfinite(triangle.coordinates[i].y)) continue;
    session.diagnostics.warn_once(where, "surface coordinates that are not finite count as 0");
    triangle.coordinates[i] = Vec2f(0);
  }
}

Vec3 inside_vector(Session& session, const Quantity& vector, const Location& where) {
  if (vector.is_finite()) return vector.vec3();
  session.diagnostics.warn_once(where, "an inside_vector that is not finite is ignored");
  return Vec3(0);
}

std::shared_ptr<ObjectDefinition> mesh(Session& session, MeshBuilder& builder, const Location& where) {
  if (builder.is_unused()) session.fail(where, "this mesh has no triangles");
  auto definition = builder.finish();
  warn_if_empty(session, definition->mesh, where);
  return make_object(std::move(definition));
}

std::shared_ptr<ObjectDefinition> mesh2(Session& session, Mesh2Definition& definition,
                                        const Location& where) {
  if (definition.face_indices.empty()) session.fail(where, "this mesh has no triangles");
  std::shared_ptr<MeshDefinition> mesh;
  try {
    mesh = make_mesh(std::move(definition), session.tokens);
  } catch (const SceneError&) {
    throw; // has its place
  } catch (const InputError& error) {
    session.fail(where, error.what());
  }
  warn_if_empty(session, mesh->mesh, where);
  session.builder.count_triangles(mesh->mesh.triangles.size(), where);
  return make_object(std::move(mesh));
}

void check_count(Session& session, double announced, std::size_t found, const Location& where) {
  if (std::floor(announced) != static_cast<double>(found))
    session.fail(where, "this list announces " +
                            std::to_string(static_cast<long long>(std::clamp(announced, -1e15, 1e15))) +
                            " entries, but has " + std::to_string(found));
}

CountedList counted(Session& session, std::vector<ListEntry>& list, const Location& where) {
  check_count(session, list_count(session, list, where), list.size() - 1, where);
  return CountedList(std::move(list));
}

CountedList faces(Session& session, std::vector<ListEntry>& list, const Location& where) {
  const double announced = list_count(session, list, where);
  CountedList faces(std::move(list));
  check_count(session, announced, count_faces(faces, session.tokens), where);
  return faces;
}

CountedList vectors(Session& session, std::vector<ListEntry>& list, const Location& where) {
  CountedList result = counted(session, list, where);
  for (const ListEntry& entry : result) {
    session.tokens.spend(1);
    if (!is_finite(entry.v))
      session.diagnostics.warn_once(where, "a vector of this mesh is not finite: triangles that have its "
                                           "place are left out, those that have its normal are flat");
  }
  return result;
}

std::string quoted(Session& session, NameId name) {
  return '\'' + session.names.text(name) + '\'';
}

std::string quoted_pattern(int pattern) {
  return '\'' + std::string(pattern_words()[static_cast<std::size_t>(pattern)].word) + '\'';
}

UnsupportedPtr make_unsupported(const std::string& what, const Location& where) {
  return std::make_shared<Unsupported>(Unsupported{what, where});
}

UnsupportedPtr unsupported_feature(Session& session, const std::string& what, const Location& where) {
  session.tokens.skip_arguments();
  return make_unsupported(what, where);
}

bool renders_media(const Session& session) {
  return session.options.quality >= 9;
}

UnsupportedPtr unsupported_block(Session& session, NameId word, const Location& where) {
  if (session.names.text(word) == "media" && !renders_media(session)) return nullptr;
  return make_unsupported(quoted(session, word), where);
}

UnsupportedPtr unless_zero(const std::string& what, double value, const Location& where) {
  return value == 0 ? nullptr : make_unsupported(what, where);
}

ObjectPtr unsupported_object(const std::string& what, const Location& where) {
  auto object = std::make_shared<ObjectDefinition>();
  object->missing = make_unsupported(what, where);
  return object;
}

} // namespace celltrace::pov
