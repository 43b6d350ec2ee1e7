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
/// Gives a fractal as many iterations as can be counted. With less than 0 POV-Ray has 0.55
/// everywhere.
void set_iterations(Session& session, pattern::Fractal& fractal, double number, const Location& where);
/// Makes the Mandelbrot set, which is `pattern`, one of the magnet's kind.
PatternChange magnet(Session& session, double kind, int pattern, const Quantity& iterations,
                     const Location& where);
/// Fails if it has neither a direction nor an altitude.
PatternChange slope(Session& session, const pattern::Slope& slope, const Location& where);
/// Sets a range of a slope; without a width it stays the one from 0 to 1.
void set_range(double& from, double& to, double least, double most);
/// Sets a number that only fractals understand; fails unless the number is one of 0 to `most`.
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
/// Returns the mapping that a pattern's word stands for.
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

} // namespace celltrace::pov
