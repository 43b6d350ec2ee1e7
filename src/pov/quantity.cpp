#include "pov/quantity.hpp"

#include <algorithm>
#include <charconv>

#include "pov/token.hpp"

namespace celltrace::pov {

namespace {

template <class Operation>
Quantity component_wise(const Quantity& a, const Quantity& b, Operation operation) {
  const int count = std::max(a.count, b.count);
  const Quantity left = a.promoted(count);
  const Quantity right = b.promoted(count);
  Quantity result;
  result.count = count;
  result.is_colour = a.is_colour || b.is_colour;
  for (int i = 0; i < count; ++i)
    result.v[i] = operation(left.v[i], right.v[i]);
  return result;
}

/// Compares as POV-Ray does: NaN, such as the difference of two infinities, counts as equal to everything.
bool holds(Relation relation, double a, double b) {
  const double difference = a - b;
  switch (relation) {
  case Relation::less:
    return a < b;
  case Relation::less_equal:
    return !(difference > kComparisonTolerance);
  case Relation::equal:
    return !(std::fabs(difference) >= kComparisonTolerance);
  case Relation::not_equal:
    return std::fabs(difference) >= kComparisonTolerance;
  case Relation::greater_equal:
    return !(difference < -kComparisonTolerance);
  case Relation::greater:
    return a > b;
  }
  return false;
}

} // namespace

std::string short_text(double number) {
  constexpr int kDigits = 6;
  char buffer[32];
  const auto result =
      std::to_chars(buffer, buffer + sizeof buffer, number, std::chars_format::general, kDigits);
  return {buffer, result.ptr};
}

Quantity Quantity::vector(const Vec3& value) {
  Quantity result;
  result.count = 3;
  result.v = {value.x, value.y, value.z};
  return result;
}

Quantity Quantity::colour(const Vec3& rgb, double filter, double transmit) {
  Quantity result;
  result.count = 5;
  result.is_colour = true;
  result.v = {rgb.x, rgb.y, rgb.z, filter, transmit};
  return result;
}

bool Quantity::is_finite() const {
  return std::all_of(v.begin(), v.end(), [](double component) { return std::isfinite(component); });
}

Quantity Quantity::promoted(int wanted) const {
  Quantity result = *this;
  if (count == 1) std::fill(result.v.begin(), result.v.begin() + wanted, v[0]);
  result.count = std::max(count, wanted);
  return result;
}

Vec3 Quantity::vec3() const {
  const Quantity three = promoted(3);
  return {three.v[0], three.v[1], three.v[2]};
}

Pigment Quantity::pigment() const {
  const Quantity five = promoted(5);
  return {{five.v[0], five.v[1], five.v[2]}, five.v[3], five.v[4]};
}

Quantity literal_of(const Token& token) {
  Quantity literal;
  literal.count = token.kind == Token::Kind::vector ? token.symbol : 1;
  std::copy_n(token.number, literal.count, literal.v.begin());
  return literal;
}

Quantity make_colour(ColourModel model, const Quantity& value) {
  const bool is_float = value.is_float();
  const auto component = [&](int i) { return is_float ? value.v[0] : value.v[i]; };
  const Vec3 rgb{component(0), component(1), component(2)};
  switch (model) {
  case ColourModel::rgb: // a longer vector also sets filter and transmit
    return is_float ? Quantity::colour(rgb) : Quantity::colour(rgb, value.v[3], value.v[4]);
  case ColourModel::rgbf:
    return Quantity::colour(rgb, component(3), is_float ? 0 : value.v[4]);
  case ColourModel::rgbt:
    return value.count == 5 ? Quantity::colour(rgb, value.v[3], value.v[4])
                            : Quantity::colour(rgb, 0, component(3));
  case ColourModel::rgbft:
    return Quantity::colour(rgb, component(3), component(4));
  }
  return value;
}

Quantity with_channel(const Quantity& colour, Channel channel, double value) {
  Quantity result = colour.promoted(5);
  result.is_colour = true;
  result.v[static_cast<std::size_t>(channel)] = value;
  return result;
}

Quantity operator+(const Quantity& a, const Quantity& b) {
  return component_wise(a, b, [](double x, double y) { return x + y; });
}

Quantity operator-(const Quantity& a, const Quantity& b) {
  return component_wise(a, b, [](double x, double y) { return x - y; });
}

Quantity operator*(const Quantity& a, const Quantity& b) {
  return component_wise(a, b, [](double x, double y) { return x * y; });
}

Quantity operator/(const Quantity& a, const Quantity& b) {
  return component_wise(
      a, b, [](double x, double y) { return y == 0 ? std::numeric_limits<double>::infinity() : x / y; });
}

Quantity compare(Relation relation, const Quantity& a, const Quantity& b) {
  return component_wise(a, b, [relation](double x, double y) { return holds(relation, x, y) ? 1.0 : 0.0; });
}

Quantity join(Junction junction, const Quantity& a, const Quantity& b) {
  return component_wise(a, b, [junction](double x, double y) {
    const bool holds = junction == Junction::both ? is_true(x) && is_true(y) : is_true(x) || is_true(y);
    return holds ? 1.0 : 0.0;
  });
}

bool is_true(double value) {
  return std::fabs(value) > kComparisonTolerance;
}

void Signs::add(char sign) {
  if (sign == '-') {
    if (!logical_) negated_ = !negated_;
  } else if (sign == '!') {
    logical_ = true;
    inverted_ = !inverted_;
  }
}

Quantity Signs::apply(const Quantity& operand) const {
  Quantity result = operand;
  for (int i = 0; i < result.count; ++i) {
    double& value = result.v[static_cast<std::size_t>(i)];
    if (logical_) value = is_true(value) != inverted_ ? 1 : 0;
    if (negated_) value = -value;
  }
  return result;
}

} // namespace celltrace::pov
