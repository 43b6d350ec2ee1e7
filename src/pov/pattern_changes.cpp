// Changes of a pattern, and the warps of its space.
#include <algorithm>
#include <cmath>

#include "celltrace/error.hpp"
#include "pov/actions.hpp"
#include "scene_image/function_code.hpp"

namespace celltrace::pov {

namespace {

constexpr int kMostType = 8; // largest number of `exterior` and `interior`

} // namespace

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

/// Returns a change to a fractal: to the Mandelbrot set if `constant` is null, otherwise to a Julia set with
/// it. `magnet` is 0, 1 or 2.
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

PatternChange function_pattern(Session& session, const FunctionPtr& function, const Location& where) {
  const auto* const code = std::get_if<std::shared_ptr<const FunctionCode>>(&function->body);
  if (code == nullptr) {
    const UnsupportedPtr missing = make_unsupported("a pattern of such a function", where);
    return [=](Session&, PatternDefinition& pattern) { mark(pattern.unsupported, missing); };
  }
  if (function->parameters != 3) session.fail(where, "a pattern's function has the parameters x, y and z");
  try {
    function_code(**code);
  } catch (const InputError& error) {
    const UnsupportedPtr missing = make_unsupported(error.what(), where);
    return [=](Session&, PatternDefinition& pattern) { mark(pattern.unsupported, missing); };
  }
  return [code = *code](Session&, PatternDefinition& pattern) { choose(pattern, pattern::Function{code}); };
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
    pattern.inner_depends_on_surface = pigment.depends_on_surface();
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

} // namespace celltrace::pov
