#include "pov/functions.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <iterator>

#include <glm/geometric.hpp>

#include "geometry/function_operations.hpp"
#include "geometry/noise.hpp"
#include "pov/characters.hpp"

namespace celltrace::pov {

namespace {

/// The arguments of a call, already of the types in the function's signature.
class Call {
public:
  Call(Session& session, const std::vector<Value>& arguments, const Location& where)
      : session_(session), arguments_(arguments), where_(where) {}

  std::size_t count() const { return arguments_.size(); }
  const Quantity& quantity(std::size_t i) const { return std::get<Quantity>(arguments_[i]); }
  double number(std::size_t i) const { return quantity(i).v[0]; }
  Vec3 vector(std::size_t i) const { return quantity(i).vec3(); }
  const std::string& text(std::size_t i) const { return std::get<std::string>(arguments_[i]); }
  int whole(std::size_t i, double least, double most) const {
    const double value = number(i);
    require(value >= least && value <= most, "an argument is out of range");
    return static_cast<int>(value);
  }
  void require(bool condition, const char* what) const {
    if (!condition) session_.fail(where_, what);
  }
  Session& session() const { return session_; }

private:
  Session& session_;
  const std::vector<Value>& arguments_;
  const Location& where_;
};

Quantity select(const Call& call) {
  const double chooser = call.number(0);
  if (chooser < 0) return call.number(1);
  return call.count() == 4 && chooser != 0 ? call.number(3) : call.number(2);
}

template <class Better> Quantity best(const Call& call, Better better) {
  double result = call.number(0);
  for (std::size_t i = 1; i < call.count(); ++i)
    if (better(call.number(i), result)) result = call.number(i);
  return result;
}

/// Combines the arguments as ints, from the first to the last.
template <class Combine> Quantity bitwise(const Call& call, Combine combine) {
  auto result = static_cast<std::int32_t>(to_int(call.number(0)));
  for (std::size_t i = 1; i < call.count(); ++i)
    result = combine(result, static_cast<std::int32_t>(to_int(call.number(i))));
  return static_cast<double>(result);
}

Quantity seed(const Call& call) {
  auto& streams = call.session().random_streams;
  call.require(streams.size() < call.session().options.limits.list_entries, "too many random streams");
  streams.push_back(static_cast<std::uint32_t>(static_cast<std::int32_t>(to_int(call.number(0)))));
  return static_cast<double>(streams.size() - 1);
}

Quantity random(const Call& call) {
  auto& streams = call.session().random_streams;
  const double stream = call.number(0);
  call.require(stream >= 0 && stream < static_cast<double>(streams.size()),
               "rand() needs what seed() has given");
  std::uint32_t& state = streams[static_cast<std::size_t>(stream)];
  state = state * 1812433253u + 12345u;
  return state / 4294967295.0;
}

Quantity value_of(const Call& call) {
  const std::string& text = call.text(0);
  const char* at = text.data() + std::min(text.find_first_not_of(" \t+"), text.size());
  const char* const end = text.data() + text.size();
  double value = 0;
  const bool is_hexadecimal = end - at > 2 && at[0] == '0' && (at[1] == 'x' || at[1] == 'X');
  if (is_hexadecimal)
    std::from_chars(at + 2, end, value, std::chars_format::hex);
  else
    std::from_chars(at, end, value);
  return value;
}

/// Returns v turned about an axis by an angle in degrees: Rodrigues' formula.
Quantity rotate_about(const Call& call) {
  const Vec3 v = call.vector(0);
  const double length = glm::length(call.vector(1)); // for a length of 0, the result is NaN as in POV-Ray
  const Vec3 axis = call.vector(1) / length;
  const double angle = call.number(2) / kDegreesPerRadian;
  return Quantity::vector(v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
                          axis * (glm::dot(axis, v) * (1 - std::cos(angle))));
}

Quantity normalize(const Call& call) {
  const Vec3 v = call.vector(0);
  const double length = glm::length(v);
  return Quantity::vector(length == 0 ? Vec3(0, 0, 0) : v / length);
}

/// Limit on characters in a number.
constexpr int kMostDigits = 254;

std::string format(double value, int width, int digits, std::chars_format notation) {
  char buffer[1024]; // room for 309 digits, the point and kMostDigits more
  const int precision = digits < 0 ? 6 : std::min(digits, 2 * kMostDigits);
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value, notation, precision);
  std::string text(buffer, result.ptr);
  const auto wanted = static_cast<std::size_t>(std::abs(width));
  if (text.size() >= wanted) return text;
  const bool is_padded_with_zeros = width < 0 && std::isfinite(value);
  const bool has_sign = is_padded_with_zeros && text[0] == '-';
  text.insert(has_sign ? 1 : 0, wanted - text.size(), is_padded_with_zeros ? '0' : ' ');
  return text;
}

/// Formats a number as printf's f in the C locale, whatever the application's locale, or as its g if the
/// result is too long: a negative width pads with zeros, a negative precision stands for 6 digits.
std::string format(double value, double width, double digits) {
  constexpr const char* kTooLong = "<invalid>"; // POV-Ray's text
  width = to_int(width);
  if (std::fabs(width) > kMostDigits) return kTooLong;
  const int columns = static_cast<int>(width), precision = static_cast<int>(to_int(digits));
  std::string text = format(value, columns, precision, std::chars_format::fixed);
  if (text.size() > kMostDigits) text = format(value, columns, precision, std::chars_format::general);
  return text.size() > kMostDigits ? kTooLong : text;
}

std::string number_text(const Call& call) {
  return format(call.number(0), call.number(1), call.number(2));
}

std::string vector_text(const Call& call) {
  const int count = std::clamp(call.whole(0, -1e9, 1e9), 2, 5);
  const Quantity& vector = call.quantity(1); // missing components of a float or a shorter vector are 0
  std::string result;
  for (int i = 0; i < count; ++i)
    result += (i > 0 ? call.text(2) : std::string()) +
              format(vector.v[static_cast<std::size_t>(i)], call.number(3), call.number(4));
  return result;
}

std::string concatenate(const Call& call) {
  std::string result;
  for (std::size_t i = 0; i < call.count(); ++i) {
    call.require(result.size() + call.text(i).size() <= call.session().options.limits.string_bytes,
                 "this string is too long");
    result += call.text(i);
  }
  return result;
}

std::string substring(const Call& call) {
  const std::string& text = call.text(0);
  const double size = static_cast<double>(text.size());
  const double first = call.number(1);
  const double length = call.number(2);
  if (first >= 0 && first < 1 && length <= size) return {}; // as in POV-Ray
  call.require(first >= 1 && length >= 0 && first + length - 1 <= size,
               "substr() reaches outside its string");
  return text.substr(static_cast<std::size_t>(first) - 1, static_cast<std::size_t>(length));
}

std::string in_case(std::string text, bool upper) {
  for (char& c : text) {
    if (upper && c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    if (!upper && c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

Quantity turbulence(const Call& call) {
  constexpr double kMostOctaves = 10;
  const auto octaves = static_cast<int>(std::clamp(call.number(2), 1.0, kMostOctaves));
  // Uses single precision where POV-Ray does.
  const auto lambda = static_cast<float>(call.number(0)), omega = static_cast<float>(call.number(1));
  return Quantity::vector(turbulence_vector(call.vector(3), octaves, lambda, omega));
}

/// Returns the difference of the first characters in which texts differ, an end counting as 0; 0 if the texts
/// are equal.
double difference(const std::string& a, const std::string& b) {
  const auto [at, other] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  const auto code = [](const std::string& text, std::string::const_iterator i) {
    return i == text.end() ? 0 : static_cast<int>(static_cast<unsigned char>(*i));
  };
  return code(a, at) - code(b, other);
}

/// The beginning of the year 2000, in seconds of Unix time.
constexpr double kSecondsTo2000 = 946684800;
constexpr double kSecondsPerDay = 86400;

/// Formats a date as strftime() does.
std::string date_text(const Call& call) {
  const double seconds = call.number(0) * kSecondsPerDay + kSecondsTo2000;
  call.require(std::fabs(seconds) < 1e11, "this date is out of range");
  const auto time = static_cast<std::time_t>(std::floor(seconds + 0.5));
  std::tm parts{};
  call.require(gmtime_r(&time, &parts) != nullptr, "this date is out of range");
  const std::string format = call.count() > 1 ? call.text(1) : "%Y-%m-%d %H:%M:%SZ";
  if (format.empty()) return {};
  char text[1024];
  const std::size_t size = std::strftime(text, sizeof text, format.c_str(), &parts);
  call.require(size > 0, "this date's text is empty or too long");
  return {text, size};
}

bool file_exists(const Call& call) {
  const auto file = call.session().sources.find_file(call.text(0), call.session().tokens.current_folder());
  return file && file->may_be_read;
}

double logarithm(const Call& call, double (*function)(double)) {
  call.require(!(call.number(0) <= 0), "the logarithm of a number that is not positive");
  return function(call.number(0));
}

double square_root(const Call& call) {
  call.require(!(call.number(0) < 0), "the square root of a negative number");
  return std::sqrt(call.number(0));
}

/// A function and its signature: n is a float, v a vector, s a string; a trailing + repeats the last one, a
/// trailing ? makes it optional.
struct Function {
  const char* name;
  const char* signature;
  Value (*evaluate)(const Call&);
};

#define CELLTRACE_NUMERIC(expression) [](const Call& c) -> Value { return Quantity(expression); }
#define CELLTRACE_TEXT(...) [](const Call& c) -> Value { return std::string(__VA_ARGS__); }

const Function kFunctions[] = {
    {"abs", "n", CELLTRACE_NUMERIC(std::fabs(c.number(0)))},
    {"acos", "n", CELLTRACE_NUMERIC(std::acos(std::clamp(c.number(0), -1.0, 1.0)))},
    {"acosh", "n", CELLTRACE_NUMERIC(std::acosh(c.number(0)))},
    {"asc", "s", CELLTRACE_NUMERIC(first_code(c.text(0)))},
    {"asin", "n", CELLTRACE_NUMERIC(std::asin(std::clamp(c.number(0), -1.0, 1.0)))},
    {"asinh", "n", CELLTRACE_NUMERIC(std::asinh(c.number(0)))},
    {"atan", "n", CELLTRACE_NUMERIC(std::atan(c.number(0)))},
    {"atan2", "nn", CELLTRACE_NUMERIC(std::atan2(c.number(0), c.number(1)))},
    {"atanh", "n", CELLTRACE_NUMERIC(std::atanh(c.number(0)))},
    {"bitwise_and", "n+", CELLTRACE_NUMERIC(bitwise(c, std::bit_and<>()))},
    {"bitwise_or", "n+", CELLTRACE_NUMERIC(bitwise(c, std::bit_or<>()))},
    {"bitwise_xor", "n+", CELLTRACE_NUMERIC(bitwise(c, std::bit_xor<>()))},
    {"ceil", "n", CELLTRACE_NUMERIC(std::ceil(c.number(0)))},
    {"cos", "n", CELLTRACE_NUMERIC(std::cos(c.number(0)))},
    {"cosh", "n", CELLTRACE_NUMERIC(std::cosh(c.number(0)))},
    {"degrees", "n", CELLTRACE_NUMERIC(c.number(0) * kDegreesPerRadian)},
    {"div", "nn", CELLTRACE_NUMERIC(to_int(c.number(0) / c.number(1)))},
    {"exp", "n", CELLTRACE_NUMERIC(std::exp(c.number(0)))},
    {"file_exists", "s", CELLTRACE_NUMERIC(file_exists(c) ? 1 : 0)},
    {"floor", "n", CELLTRACE_NUMERIC(std::floor(c.number(0)))},
    {"int", "n", CELLTRACE_NUMERIC(to_int(c.number(0)))},
    {"ln", "n", CELLTRACE_NUMERIC(logarithm(c, std::log))},
    {"log", "n", CELLTRACE_NUMERIC(logarithm(c, std::log10))},
    {"max", "n+", CELLTRACE_NUMERIC(best(c, std::greater<>()))},
    {"min", "n+", CELLTRACE_NUMERIC(best(c, std::less<>()))},
    {"mod", "nn", CELLTRACE_NUMERIC(std::fmod(c.number(0), c.number(1)))},
    {"pow", "nn", CELLTRACE_NUMERIC(std::pow(c.number(0), c.number(1)))},
    {"radians", "n", CELLTRACE_NUMERIC(c.number(0) / kDegreesPerRadian)},
    {"rand", "n", CELLTRACE_NUMERIC(random(c))},
    {"seed", "n", CELLTRACE_NUMERIC(seed(c))},
    {"select", "nnnn?", CELLTRACE_NUMERIC(select(c))},
    {"sin", "n", CELLTRACE_NUMERIC(std::sin(c.number(0)))},
    {"sinh", "n", CELLTRACE_NUMERIC(std::sinh(c.number(0)))},
    {"sqrt", "n", CELLTRACE_NUMERIC(square_root(c))},
    {"strcmp", "ss", CELLTRACE_NUMERIC(difference(c.text(0), c.text(1)))},
    {"strlen", "s", CELLTRACE_NUMERIC(static_cast<double>(c.text(0).size()))},
    {"tan", "n", CELLTRACE_NUMERIC(std::tan(c.number(0)))},
    {"tanh", "n", CELLTRACE_NUMERIC(std::tanh(c.number(0)))},
    {"val", "s", CELLTRACE_NUMERIC(value_of(c))},
    {"vaxis_rotate", "vvn", CELLTRACE_NUMERIC(rotate_about(c))},
    {"vturbulence", "nnnv", CELLTRACE_NUMERIC(turbulence(c))},
    {"vcross", "vv", CELLTRACE_NUMERIC(Quantity::vector(glm::cross(c.vector(0), c.vector(1))))},
    {"vdot", "vv", CELLTRACE_NUMERIC(glm::dot(c.vector(0), c.vector(1)))},
    {"vlength", "v", CELLTRACE_NUMERIC(glm::length(c.vector(0)))},
    {"vnormalize", "v", CELLTRACE_NUMERIC(normalize(c))},
    {"vrotate", "vv",
     CELLTRACE_NUMERIC(Quantity::vector(Transform::rotate(c.vector(1)).direction(c.vector(0))))},
    {"chr", "n", CELLTRACE_TEXT(character(static_cast<unsigned>(c.whole(0, 0, 65535))))},
    {"concat", "s+", CELLTRACE_TEXT(concatenate(c))},
    {"datetime", "ns?", CELLTRACE_TEXT(date_text(c))},
    {"str", "nnn", CELLTRACE_TEXT(number_text(c))},
    {"strlwr", "s", CELLTRACE_TEXT(in_case(c.text(0), false))},
    {"strupr", "s", CELLTRACE_TEXT(in_case(c.text(0), true))},
    {"substr", "snn", CELLTRACE_TEXT(substring(c))},
    {"vstr", "nvsnn", CELLTRACE_TEXT(vector_text(c))},
};

#undef CELLTRACE_NUMERIC
#undef CELLTRACE_TEXT

constexpr const char* kFirstTextFunction = "chr";

bool fits(const Value& argument, char type) {
  if (type == 's') return std::holds_alternative<std::string>(argument);
  const auto* quantity = std::get_if<Quantity>(&argument);
  return quantity && (type == 'v' || quantity->is_float());
}

const char* type_name(char type) {
  return type == 's' ? "a string" : type == 'v' ? "a vector" : "a float";
}

/// Returns the types of this many arguments. Fails if the function takes another number.
std::string argument_types(Session& session, const Function& function, std::size_t count,
                           const Location& where) {
  std::string types = function.signature;
  const char last = types.empty() ? '\0' : types.back();
  const bool repeats = last == '+';
  const bool is_optional = last == '?';
  if (repeats || is_optional) types.pop_back();
  if (is_optional && count + 1 == types.size()) types.pop_back();
  if (repeats && count > types.size()) types.resize(count, types.back());
  if (count != types.size())
    session.fail(where, std::string(function.name) + "() takes " + std::to_string(types.size()) +
                            (types.size() == 1 ? " argument" : " arguments") + ", not " +
                            std::to_string(count));
  return types;
}

Value evaluate(Session& session, int number, const std::vector<Value>& arguments, const Location& where) {
  const Function& function = kFunctions[number];
  const std::string types = argument_types(session, function, arguments.size(), where);
  for (std::size_t i = 0; i < types.size(); ++i)
    if (!fits(arguments[i], types[i]))
      session.fail(where, "argument " + std::to_string(i + 1) + " of " + function.name + "() must be " +
                              type_name(types[i]) + ", not " + kind_name(arguments[i]));
  return function.evaluate(Call(session, arguments, where));
}

} // namespace

std::vector<FunctionName> function_names() {
  std::vector<FunctionName> names;
  bool returns_text = false;
  for (const Function& function : kFunctions) {
    returns_text = returns_text || std::strcmp(function.name, kFirstTextFunction) == 0;
    names.push_back({function.name, returns_text});
  }
  return names;
}

void check_numeric_call(Session& session, int function, std::size_t arguments, const Location& where) {
  const Function& called = kFunctions[function];
  const std::string types = argument_types(session, called, arguments, where);
  if (called.name[0] == 'v' || types.find_first_not_of('n') != std::string::npos)
    session.fail(where, std::string(called.name) + "() is no function of floats");
}

double days_now() {
  return (static_cast<double>(std::time(nullptr)) - kSecondsTo2000) / kSecondsPerDay;
}

bool is_pure(int function) {
  const char* const name = kFunctions[function].name;
  const auto is_name = [name](const char* other) { return std::strcmp(name, other) == 0; };
  return !is_name("rand") && !is_name("seed") && !is_name("file_exists");
}

Quantity call_numeric(Session& session, int function, const std::vector<Value>& arguments,
                      const Location& where) {
  return std::get<Quantity>(evaluate(session, function, arguments, where));
}

std::string call_text(Session& session, int function, const std::vector<Value>& arguments,
                      const Location& where) {
  std::string text = std::get<std::string>(evaluate(session, function, arguments, where));
  session.count_text(text.size(), where);
  return text;
}

} // namespace celltrace::pov
