// Changes of a pattern, and the warps of its space.
#pragma once

#include <functional>

#include "pov/session.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

/// Change that a word or a modifier such as `frequency 2` makes to a pattern.
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
/// Sets a fractal's iterations, at most as many as can be counted. With less than 0 iterations a fractal is
/// 0.55 everywhere, as in POV-Ray.
void set_iterations(Session& session, pattern::Fractal& fractal, double number, const Location& where);
/// Makes `pattern`, which is the Mandelbrot set, one of the magnet's kind.
PatternChange magnet(Session& session, double kind, int pattern, const Quantity& iterations,
                     const Location& where);
/// Sets a slope. Fails if the slope has neither a direction nor an altitude.
/// Returns the change that makes a pattern a function. Fails if the function has no number of a point.
PatternChange function_pattern(Session& session, const FunctionPtr& function, const Location& where);
PatternChange slope(Session& session, const pattern::Slope& slope, const Location& where);
/// Sets a range of a slope; a range without a width becomes the one from 0 to 1.
void set_range(double& from, double& to, double least, double most);
/// Sets a number that only fractals understand; fails unless the number is one of 0 to `most`.
PatternChange set_fractal(int pattern::Fractal::*member, double value, int most, const Location& where);
/// Sets the exponent of a fractal. An exponent that is none of 2 to 33 counts as 2, as in POV-Ray.
PatternChange fractal_exponent(double value, const Location& where);
PatternChange exterior(double type, double factor, const Location& where);
PatternChange interior(double type, double factor, const Location& where);
/// Makes the pattern the grey of a pigment.
PatternChange grey(const PigmentDefinition& pigment);
PatternChange unsupported_change(const UnsupportedPtr& unsupported);
/// Adds a warp. `items_where` is the place of the first word in its block.
PatternChange warp(Session& session, SpaceStep warp, const Location& items_where, const Location& where);
/// Moves a black hole's copies apart, so that none reaches into another.
void keep_apart(Session& session, warp::BlackHole& hole, const Location& where);
/// Returns a repetition along the only axis of which `width` is not 0.
warp::Repeat repeat(Session& session, const Vec3& width, const Location& where);
/// Returns an offset. `option` is the word of it, which has to be "offset".
Vec3 offset(Session& session, int option, const Quantity& value, const Location& where);
/// Returns the mapping that a pattern's word stands for.
warp::Mapping mapping(Session& session, int pattern, const Location& where);
warp::Mapping mapping(Session& session, int pattern, const Vec3& orientation, double distance,
                      const Location& where);
/// Returns `value`; fails unless it is greater than 0.
double positive(Session& session, double value, const char* what, const Location& where);
int octaves(double number);
/// Returns the number of a noise generator; 0: the scene's.
int noise_generator(Session& session, double number, const Location& where);

/// Makes a change, unless the pattern is on surface coordinates.
void change(Session& session, PatternDefinition& pattern, const PatternChange& change);

} // namespace celltrace::pov
