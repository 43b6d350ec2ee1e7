// POV-Ray's number: a float, a vector of 2 to 4 components or a colour of 5, and its arithmetic.
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "celltrace/scene.hpp"

namespace celltrace::pov {

/// A number for messages and files, as printf's %g, whatever the locale.
std::string short_text(double number);

/// Relational operators count values closer than this as equal.
inline constexpr double kComparisonTolerance = 1e-10;

/// What `.gray` counts as, past the components.
inline constexpr int kGreyComponent = 5;
/// What `.hf` counts as, the height that a height field would have from a colour; in functions alone.
inline constexpr int kHeightComponent = 6;

/// Components of a colour: red, green, blue, filter, transmit. Those past `count` are zero.
struct Quantity {
  int count = 1;
  bool is_colour = false;
  std::array<double, 5> v{};

  Quantity() = default;
  Quantity(double value) : v{value} {}
  static Quantity vector(const Vec3& value);
  static Quantity colour(const Vec3& rgb, double filter = 0, double transmit = 0);

  bool is_float() const { return count == 1; }
  double grey() const { return 0.297 * v[0] + 0.589 * v[1] + 0.114 * v[2]; }
  bool is_finite() const;

  /// With `wanted` components: a float fills all of them, a shorter vector is padded with zeros.
  Quantity promoted(int wanted) const;
  /// As a point, direction or the like.
  Vec3 vec3() const;
  /// As a colour: a float fills filter and transmit too, as in `color 0.5`.
  Pigment pigment() const;
};

struct Token;
/// Of a number or a vector.
Quantity literal_of(const Token& token);

/// What stands behind rgb, rgbf, rgbt and rgbft.
enum class ColourModel { rgb, rgbf, rgbt, rgbft };
Quantity make_colour(ColourModel model, const Quantity& value);

/// A colour's channels, as in `red 0.5`.
enum class Channel { red, green, blue, filter, transmit };
Quantity with_channel(const Quantity& colour, Channel channel, double value);

/// Component-wise after promotion; a division by zero gives an infinity, which few things accept.
Quantity operator+(const Quantity& a, const Quantity& b);
Quantity operator-(const Quantity& a, const Quantity& b);
Quantity operator*(const Quantity& a, const Quantity& b);
Quantity operator/(const Quantity& a, const Quantity& b);

enum class Relation { less, less_equal, equal, not_equal, greater_equal, greater };
/// Component-wise, 1 where it holds.
Quantity compare(Relation relation, const Quantity& a, const Quantity& b);

enum class Junction { both, either };
/// Component-wise, 1 where both or either of them hold.
Quantity join(Junction junction, const Quantity& a, const Quantity& b);

/// Whether a condition holds: no component is zero.
bool is_true(double value);

/// The prefix operators in front of an operand, - + and !, gathered from the outermost inwards.
class Signs {
public:
  void add(char sign);
  Quantity apply(const Quantity& operand) const;

private:
  bool negated_ = false;
  bool logical_ = false; ///< a ! was seen: what stands further in only matters as true or false
  bool inverted_ = false;
};

} // namespace celltrace::pov
