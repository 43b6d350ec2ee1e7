#include "pov/patterns.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>

#include <glm/geometric.hpp>

#include "pov/actions.hpp"
#include "pov/finite.hpp"
#include "pov/session.hpp"

namespace celltrace::pov {

namespace {

using Wave = Pattern::Wave;
using namespace pattern;

/// Limit on steps of space in a pattern: transformations between warps count as one.
constexpr std::size_t kMostSpaceSteps = 64;
constexpr double kMostArms = 1e6;

struct Colour {
  double position; ///< position in the default map; in lists the index
  Vec3 rgb;
};

/// The checked argument of an option or a pattern, for the pattern's kind.
class Argument {
public:
  Argument(Session& session, const Quantity& value, const Location& where)
      : session_(session), value_(value), where_(where) {}

  double number() const { return session_.number(value_, where_); }
  Vec3 vector() const { return session_.vector(value_, where_); }
  void set_iterations(Fractal& fractal) const { pov::set_iterations(session_, fractal, number(), where_); }
  void require(bool condition, const char* what) const {
    if (!condition) session_.fail(where_, what);
  }
  void warn(const char* what) const { session_.diagnostics.warn_once(where_, what); }

private:
  Session& session_;
  const Quantity& value_;
  const Location& where_;
};

using Setter = void (*)(Kind&, const Argument&);

struct Option {
  const char* word = nullptr;
  Setter set = nullptr;
  bool has_value = true;
};

struct PatternEntry {
  const char* word;
  Kind (*make)();
  PatternForm form = PatternForm::plain;
  Wave wave = Wave::ramp;
  std::vector<Colour> colours = {{0, {0, 0, 0}}, {1, {1, 1, 1}}};
  Setter set_argument = nullptr;
  std::vector<Option> options = {};
  double frequency = 1;
};

template <class T> Kind make() {
  return T{};
}

void set_direction(Kind& kind, const Argument& a) {
  const Vec3 direction = a.vector();
  if (direction != Vec3(0)) {
    std::get<Gradient>(kind).direction = direction;
    return;
  }
  a.warn("a gradient without a direction is 0 everywhere");
  Crackle nothing;
  std::fill(std::begin(nothing.form), std::end(nothing.form), 0.0);
  kind = nothing;
}

/// Sets `coords` of facets, which replace `size`: the first of the two counts.
void set_coords(Kind& kind, const Argument& a) {
  auto& facets = std::get<Facets>(kind);
  facets.coords = a.number();
  if (facets.coords != 0) facets.size = 0;
}

void set_size(Kind& kind, const Argument& a) {
  auto& facets = std::get<Facets>(kind);
  const double size = a.number();
  if (facets.coords == 0) facets.size = size;
}

void set_arms(Kind& kind, const Argument& a) {
  const double arms = std::trunc(a.number());
  a.require(std::fabs(arms) <= kMostArms, "a spiral has no more than a million arms");
  std::get<Spiral>(kind).arms = static_cast<int>(arms);
}

void set_brick_size(Kind& kind, const Argument& a) {
  const Vec3 size = a.vector();
  auto& brick = std::get<Brick>(kind);
  if (size.x != 0 && size.y != 0 && size.z != 0) {
    brick.size = size;
  } else {
    a.warn("bricks without a size leave nothing but mortar");
    constexpr double kCoversAll = 1e9;
    brick.mortar = kCoversAll;
  }
}

void set_metric(Kind& kind, const Argument& a) {
  const double metric = a.number();
  auto& crackle = std::get<Crackle>(kind);
  if (metric > 0) {
    crackle.metric = metric;
  } else {
    a.warn("a crackle whose metric is not above 0 is 0 everywhere");
    std::fill(std::begin(crackle.form), std::end(crackle.form), 0.0);
  }
}

void set_iterations(Kind& kind, const Argument& a) {
  a.set_iterations(std::get<Fractal>(kind));
}

void set_form(Kind& kind, const Argument& a) {
  const Vec3 form = a.vector();
  double(&factors)[3] = std::get<Crackle>(kind).form;
  factors[0] = form.x;
  factors[1] = form.y;
  factors[2] = form.z;
}

constexpr auto kList = PatternForm::list;
constexpr auto kPlain = PatternForm::plain;
constexpr auto kArgument = PatternForm::argument;

const Vec3 kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1}, kYellow{1, 1, 0}, kCyan{0, 1, 1},
    kMagenta{1, 0, 1};
const Vec3 kBlack{0, 0, 0}, kWhite{1, 1, 1};

const std::vector<Colour> kGrey{{0, kBlack}, {1, kWhite}};
const std::vector<Colour> kSix{{0, kRed}, {1, kGreen}, {2, kBlue}, {3, kYellow}, {4, kCyan}, {5, kMagenta}};

/// All patterns: word, kind, form of the arguments, wave, default colours, setter of the argument, options,
/// default frequency.
const PatternEntry kPatterns[] = {
    {"agate",
     make<Agate>,
     kPlain,
     Wave::ramp,
     {{0, kWhite},
      {0.5, {0.95, 0.75, 0.5}},
      {0.5, {0.9, 0.7, 0.5}},
      {0.6, {0.9, 0.7, 0.4}},
      {0.6, {1, 0.7, 0.4}},
      {1, {0.6, 0.3, 0}}},
     nullptr,
     {{"agate_turb", [](Kind& kind, const Argument& a) { std::get<Agate>(kind).turbulence = a.number(); }}}},
    {"average", make<Bozo>}, // has no pattern of its own: it averages its entries
    {"boxed", make<Boxed>},
    {"bozo",
     make<Bozo>,
     kPlain,
     Wave::ramp,
     {{0.4, kWhite}, {0.4, kGreen}, {0.6, kGreen}, {0.6, kBlue}, {0.8, kBlue}, {0.8, kRed}}},
    {"brick",
     make<Brick>,
     kList,
     Wave::ramp,
     {{0, {0.5, 0.5, 0.5}}, {1, {0.6, 0.15, 0.15}}},
     nullptr,
     {{"brick_size", set_brick_size},
      {"mortar", [](Kind& kind, const Argument& a) { std::get<Brick>(kind).mortar = a.number(); }}}},
    {"bumps", make<Bumps>},
    {"cells", make<Cells>},
    {"checker", make<Checker>, kList, Wave::ramp, {{0, kBlue}, {1, kGreen}}},
    {"crackle",
     make<Crackle>,
     kPlain,
     Wave::ramp,
     kGrey,
     nullptr,
     {{"form", set_form},
      {"metric", set_metric},
      {"offset", [](Kind& kind, const Argument& a) { std::get<Crackle>(kind).offset = a.number(); }},
      {"solid", [](Kind& kind, const Argument&) { std::get<Crackle>(kind).is_solid = true; }, false}}},
    {"cubic", make<Cubic>, kList, Wave::ramp, kSix},
    {"cylindrical", make<Cylindrical>},
    {"dents", make<Dents>},
    {"facets",
     make<Facets>,
     kPlain,
     Wave::ramp,
     kGrey,
     nullptr,
     {{"coords", set_coords}, {"size", set_size}}},
    {"gradient", make<Gradient>, kArgument, Wave::ramp, kGrey, set_direction},
    {"granite", make<Granite>},
    {"hexagon", make<Hexagon>, kList, Wave::ramp, {{0, kBlue}, {1, kGreen}, {2, kRed}}},
    {"leopard", make<Leopard>},
    {"mandel",
     make<Fractal>,
     kArgument,
     Wave::ramp,
     {{0.001, kBlack}, {0.001, kCyan}, {0.012, kYellow}, {0.015, kMagenta}, {0.1, kCyan}},
     set_iterations},
    {"marble",
     make<Marble>,
     kPlain,
     Wave::triangle,
     {{0, {0.9, 0.8, 0.8}}, {0.9, {0.9, 0.08, 0.08}}, {0.9, kBlack}, {1, kBlack}}},
    {"function", make<pattern::Function>, PatternForm::special, Wave::ramp, kGrey},
    {"image_map", make<ImageMap>, PatternForm::special},
    {"image_pattern", make<ImageGrey>, PatternForm::special},
    {"object", make<Inside>, PatternForm::special, Wave::ramp, {{0, kBlue}, {1, kGreen}}},
    {"onion", make<Onion>},
    {"pigment_pattern", make<Grey>, PatternForm::special},
    {"planar", make<Planar>},
    {"quilted",
     make<Quilted>,
     kPlain,
     Wave::ramp,
     kGrey,
     nullptr,
     {{"control0", [](Kind& kind, const Argument& a) { std::get<Quilted>(kind).control[0] = a.number(); }},
      {"control1", [](Kind& kind, const Argument& a) { std::get<Quilted>(kind).control[1] = a.number(); }}},
     0},
    {"radial",
     make<Radial>,
     kPlain,
     Wave::ramp,
     {{0, kCyan}, {0.333, kYellow}, {0.666, kMagenta}, {1, kCyan}}},
    {"ripples", make<Ripples>},
    {"slope", make<Slope>, PatternForm::special},
    {"spherical", make<Spherical>},
    {"spiral1", make<Spiral>, kArgument, Wave::triangle, kGrey, set_arms},
    {"spiral2",
     [] {
       return Kind{Spiral{1, true}};
     },
     kArgument, Wave::triangle, kGrey, set_arms},
    {"spotted", make<Bozo>},
    {"square", make<Square>, kList, Wave::ramp, {{0, kRed}, {1, kGreen}, {2, kBlue}, {3, kYellow}}},
    {"triangular", make<Triangular>, kList, Wave::ramp, kSix},
    {"waves", make<Waves>},
    {"wood", make<Wood>, kPlain, Wave::triangle, {{0.6, {0.666, 0.312, 0.2}}, {0.6, {0.4, 0.1333, 0.066}}}},
    {"wrinkles", make<Wrinkles>},
};

const PatternEntry& entry_of(const PatternDefinition& pattern) {
  return kPatterns[static_cast<std::size_t>(pattern.number)];
}

const Option* find_option(const PatternEntry& entry, const char* word) {
  const auto found = std::find_if(entry.options.begin(), entry.options.end(),
                                  [&](const Option& option) { return std::string(option.word) == word; });
  return found == entry.options.end() ? nullptr : &*found;
}

void check_steps(Session& session, const PatternDefinition& pattern, const Location& where) {
  if (pattern.value().space.size() >= kMostSpaceSteps)
    session.fail(where, "a pattern has no more than " + std::to_string(kMostSpaceSteps) +
                            " warps and transformations between them");
}

} // namespace

std::vector<PatternWord> pattern_words() {
  std::vector<PatternWord> words;
  std::transform(std::begin(kPatterns), std::end(kPatterns), std::back_inserter(words),
                 [](const PatternEntry& entry) {
                   return PatternWord{entry.word, entry.form};
                 });
  return words;
}

std::vector<PatternOption> pattern_options() {
  std::vector<PatternOption> options;
  for (const PatternEntry& entry : kPatterns)
    for (const Option& option : entry.options)
      options.push_back({option.word, option.has_value});
  return options;
}

const Pattern& PatternDefinition::value() const {
  static const Pattern kNew;
  return value_ ? *value_ : kNew;
}

Pattern& PatternDefinition::own() {
  if (!value_ || value_.use_count() > 1) value_ = std::make_shared<Pattern>(value());
  return *value_;
}

bool PatternDefinition::is_average() const {
  return number == average_number();
}

bool PatternDefinition::is_for_normals_alone() const {
  return exists() && std::string(entry_of(*this).word) == "facets";
}

std::size_t PatternDefinition::list_length() const {
  const bool is_list =
      exists() && (entry_of(*this).form == kList || std::holds_alternative<Inside>(value().kind));
  return is_list ? entry_of(*this).colours.size() : 0;
}

std::vector<PatternMap<Pigment>::Entry> PatternDefinition::default_colours() const {
  if (const auto* image = std::get_if<pattern::ImageMap>(&value().kind)) {
    const auto& texels = image->map.picture->texels;
    const bool is_clear =
        image->map.once || image->map.filter != 0 || image->map.transmit != 0 ||
        std::any_of(texels.begin(), texels.end(), [](const auto& texel) { return texel[3] != 0; });
    return {{0, Pigment{kWhite, 0, is_clear ? 1.0 : 0.0}}};
  }
  // Only the plain Mandelbrot set, of all fractals, has colours of its own.
  const auto* fractal = std::get_if<Fractal>(&value().kind);
  const bool is_other = fractal && (fractal->is_julia || fractal->magnet != 0 || fractal->exponent != 2);
  std::vector<PatternMap<Pigment>::Entry> entries;
  for (const Colour& colour : is_other ? kGrey : entry_of(*this).colours)
    entries.push_back({colour.position, Pigment{colour.rgb}});
  return entries;
}

void put_on_surface(PatternDefinition& pattern) {
  if (pattern.exists()) pattern.own().uv_mapping = true;
}

bool depends_on_surface(const PatternDefinition& pattern) {
  return pattern.exists() && (pattern.value().uv_mapping || pattern.inner_depends_on_surface ||
                              std::holds_alternative<Slope>(pattern.value().kind));
}

bool has_own_slopes(const PatternDefinition& pattern) {
  static constexpr std::string_view kWords[] = {"bumps",   "dents", "facets",  "quilted",
                                                "ripples", "waves", "wrinkles"};
  return pattern.exists() &&
         std::find(std::begin(kWords), std::end(kWords), entry_of(pattern).word) != std::end(kWords);
}

bool is_on_surface(const PatternDefinition& pattern) {
  return pattern.exists() && pattern.value().uv_mapping;
}

void choose(PatternDefinition& pattern, int number) {
  pattern.number = number;
  if (pattern.value().uv_mapping) pattern.own() = Pattern();
  const PatternEntry& entry = entry_of(pattern);
  pattern.own().kind = entry.make();
  pattern.inner_depth = 0;
  pattern.inner_depends_on_surface = false;
  if (entry.wave != Wave::ramp) pattern.own().wave = entry.wave;
  if (entry.frequency != 1) pattern.own().frequency = entry.frequency;
}

void set_argument(Session& session, PatternDefinition& pattern, const Quantity& argument,
                  const Location& where) {
  entry_of(pattern).set_argument(pattern.own().kind, Argument(session, argument, where));
}

void set_option(Session& session, PatternDefinition& pattern, int option, const Quantity& value,
                const Location& where) {
  if (!pattern.exists() && pattern.unsupported) return;
  const char* word = pattern_options()[static_cast<std::size_t>(option)].word;
  const Option* found = pattern.exists() ? find_option(entry_of(pattern), word) : nullptr;
  if (!found) session.fail(where, '\'' + std::string(word) + "' means nothing to this pattern");
  found->set(pattern.own().kind, Argument(session, value, where));
}

void append(std::vector<SpaceStep>& space, const Transform& next) {
  if (!space.empty() && std::holds_alternative<Transform>(space.back()))
    space.back() = std::get<Transform>(space.back()).then(next);
  else
    space.push_back(next);
}

bool is_singular(const Transform& transform) {
  const double determinant = transform.determinant();
  return determinant == 0 || !std::isfinite(determinant) || !std::isfinite(1 / determinant);
}

Transform spread_point(Session& session, const Location& where) {
  constexpr double kSize = 1e12, kPlace = 1e-4; // size of space, and place in it
  session.diagnostics.warn_once(where, "this pattern is at no finite place: all of it is like one point");
  return Transform::translate(Vec3(-kPlace)).then(Transform::scale(Vec3(kSize)));
}

void move(Session& session, PatternDefinition& pattern, const Transform& next, const Location& where) {
  if (is_on_surface(pattern)) return;
  if (!is_finite(next)) return move(session, pattern, spread_point(session, where), where);
  std::vector<SpaceStep>& space = pattern.own().space;
  if (space.empty() || !std::holds_alternative<Transform>(space.back())) check_steps(session, pattern, where);
  append(space, next);
  if (is_singular(std::get<Transform>(space.back())))
    session.fail(where, "this transformation is singular: it has no inverse");
}

void bend(Session& session, PatternDefinition& pattern, const SpaceStep& warp, const Location& where) {
  check_steps(session, pattern, where);
  pattern.own().space.push_back(warp);
}

int number_of(const Kind& kind) {
  const auto* entry = std::find_if(std::begin(kPatterns), std::end(kPatterns), [&](const PatternEntry& one) {
    return one.make().index() == kind.index();
  });
  return static_cast<int>(entry - std::begin(kPatterns));
}

int average_number() {
  static const auto* const kEntry =
      std::find_if(std::begin(kPatterns), std::end(kPatterns),
                   [](const PatternEntry& one) { return std::string(one.word) == "average"; });
  return static_cast<int>(kEntry - std::begin(kPatterns));
}

void choose(PatternDefinition& pattern, const Kind& kind) {
  choose(pattern, number_of(kind));
  pattern.own().kind = kind;
}

std::optional<warp::Mapping::Shape> mapping_shape(int number) {
  const Kind kind = kPatterns[static_cast<std::size_t>(number)].make();
  if (std::holds_alternative<Planar>(kind)) return warp::Mapping::Shape::planar;
  if (std::holds_alternative<Cylindrical>(kind)) return warp::Mapping::Shape::cylindrical;
  if (std::holds_alternative<Spherical>(kind)) return warp::Mapping::Shape::spherical;
  return std::nullopt;
}

} // namespace celltrace::pov
