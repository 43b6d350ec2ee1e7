// POV-Ray's number: a float, a vector of 2 to 4 components or a colour of 5, and its arithmetic.
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "celltrace/scene.hpp"

namespace celltrace::pov {

/// Formats a number for messages and files, as printf's %g, whatever the locale.
std::string short_text(double number);

/// The difference below which relational operators count values as equal.
inline constexpr double kComparisonTolerance = 1e-10;

/// The component number of `.gray`, past those of colours.
inline constexpr int kGreyComponent = 5;
/// The component number of `.hf`, the height that a height field would take from a colour; in functions only.
inline constexpr int kHeightComponent = 6;

/// A float, a vector or a colour: red, green, blue, filter, transmit. Components past `count` are zero.
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

  /// Returns the quantity with `wanted` components: a float fills all of them, a shorter vector is padded
  /// with zeros.
  Quantity promoted(int wanted) const;
  /// Returns a point, a direction or the like.
  Vec3 vec3() const;
  /// Returns a colour: a float fills filter and transmit too, as in `color 0.5`.
  Pigment pigment() const;
};

struct Token;
/// Returns the value of a number or vector token.
Quantity literal_of(const Token& token);

/// The words rgb, rgbf, rgbt and rgbft, which say what the components of a colour are.
enum class ColourModel { rgb, rgbf, rgbt, rgbft };
Quantity make_colour(ColourModel model, const Quantity& value);

/// A channel of a colour, as in `red 0.5`.
enum class Channel { red, green, blue, filter, transmit };
Quantity with_channel(const Quantity& colour, Channel channel, double value);

/// Component-wise arithmetic after promotion; a division by zero gives an infinity, which few uses accept.
Quantity operator+(const Quantity& a, const Quantity& b);
Quantity operator-(const Quantity& a, const Quantity& b);
Quantity operator*(const Quantity& a, const Quantity& b);
Quantity operator/(const Quantity& a, const Quantity& b);

enum class Relation { less, less_equal, equal, not_equal, greater_equal, greater };
/// Compares component-wise; 1 where the relation is true.
Quantity compare(Relation relation, const Quantity& a, const Quantity& b);

enum class Junction { both, either };
/// Joins component-wise; 1 where both, or either of them, are true.
Quantity join(Junction junction, const Quantity& a, const Quantity& b);

/// Returns whether a value counts as true: it differs from 0 by more than kComparisonTolerance.
bool is_true(double value);

/// The prefix operators in front of an operand, - + and !, from the outermost inwards.
class Signs {
public:
  void add(char sign);
  Quantity apply(const Quantity& operand) const;

private:
  bool negated_ = false;
  bool logical_ = false; ///< a ! was seen: whatever is further in only matters as true or false
  bool inverted_ = false;
};

} // namespace celltrace::pov
