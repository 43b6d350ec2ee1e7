#include "pov/reserved_words.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <unordered_map>

#include "celltrace/pov.hpp"
#include "pov/blocks.hpp"
#include "pov/camera.hpp"
#include "pov/constants.hpp"
#include "pov/functions.hpp"
#include "pov/grammar.hpp"
#include "pov/items.hpp"
#include "pov/patterns.hpp"
#include "pov/pictures.hpp"
#include "pov/shapes.hpp"

namespace celltrace::pov {

namespace {

using tokens = Parser::token;

struct Word {
  const char* text;
  int token;
};

struct DetailedWord {
  const char* text;
  int token;
  int detail;
};

const Word kWords[] = {
    {"albedo", tokens::T_ALBEDO},
    {"all", tokens::T_ALL},
    {"altitude", tokens::T_ALTITUDE},
    {"angle", tokens::T_ANGLE},
    {"area_light", tokens::T_AREA_LIGHT},
    {"array", tokens::T_ARRAY},
    {"assumed_gamma", tokens::T_ASSUMED_GAMMA},
    {"background", tokens::T_BACKGROUND},
    {"bicubic_patch", tokens::T_BICUBIC_PATCH},
    {"blob", tokens::T_BLOB},
    {"blur_samples", tokens::T_BLUR_SAMPLES},
    {"bounded_by", tokens::T_BOUNDED_BY},
    {"camera", tokens::T_CAMERA},
    {"charset", tokens::T_CHARSET},
    {"clipped_by", tokens::T_CLIPPED_BY},
    {"color", tokens::T_COLOUR},
    {"color_map", tokens::T_COLOUR_MAP},
    {"colour", tokens::T_COLOUR},
    {"colour_map", tokens::T_COLOUR_MAP},
    {"component", tokens::T_BLOB_COMPONENT},
    {"defined", tokens::T_DEFINED},
    {"diffuse", tokens::T_DIFFUSE},
    {"dimension_size", tokens::T_DIMENSION_SIZE},
    {"dimensions", tokens::T_DIMENSIONS},
    {"finish", tokens::T_FINISH},
    {"fog", tokens::T_FOG},
    {"function", tokens::T_USER_FUNCTION},
    {"gamma", tokens::T_GAMMA},
    {"global_settings", tokens::T_GLOBAL_SETTINGS},
    {"height_field", tokens::T_HEIGHT_FIELD},
    {"inside", tokens::T_INSIDE},
    {"inside_vector", tokens::T_INSIDE_VECTOR},
    {"interior", tokens::T_INTERIOR},
    {"interior_texture", tokens::T_INTERIOR_TEXTURE},
    {"inverse", tokens::T_INVERSE},
    {"irid", tokens::T_IRID},
    {"julia", tokens::T_JULIA},
    {"light_group", tokens::T_LIGHT_GROUP},
    {"light_source", tokens::T_LIGHT_SOURCE},
    {"looks_like", tokens::T_LOOKS_LIKE},
    {"magnet", tokens::T_MAGNET},
    {"material", tokens::T_MATERIAL},
    {"matrix", tokens::T_MATRIX},
    {"max_extent", tokens::T_MAX_EXTENT},
    {"mesh", tokens::T_MESH},
    {"mesh2", tokens::T_MESH2},
    {"min_extent", tokens::T_MIN_EXTENT},
    {"normal", tokens::T_NORMAL},
    {"normal_map", tokens::T_NORMAL_MAP},
    {"object", tokens::T_OBJECT},
    {"open", tokens::T_OPEN},
    {"photons", tokens::T_PHOTONS},
    {"pigment", tokens::T_PIGMENT},
    {"pigment_map", tokens::T_PIGMENT_MAP},
    {"pigment_pattern", tokens::T_PIGMENT_PATTERN},
    {"poly", tokens::T_POLY},
    {"projected_through", tokens::T_PROJECTED_THROUGH},
    {"quartic", tokens::T_QUARTIC},
    {"radiosity", tokens::T_RADIOSITY},
    {"rainbow", tokens::T_RAINBOW},
    {"reflection", tokens::T_REFLECTION},
    {"rotate", tokens::T_ROTATE},
    {"scale", tokens::T_SCALE},
    {"sky_sphere", tokens::T_SKY_SPHERE},
    {"slope", tokens::T_SLOPE},
    {"slope_map", tokens::T_SLOPE_MAP},
    {"smooth_triangle", tokens::T_SMOOTH_TRIANGLE},
    {"spline", tokens::T_SPLINE},
    {"srgb", tokens::T_SRGB},
    {"text", tokens::T_TEXT_OBJECT},
    {"texture", tokens::T_TEXTURE},
    {"texture_list", tokens::T_TEXTURE_LIST},
    {"texture_map", tokens::T_TEXTURE_MAP},
    {"threshold", tokens::T_THRESHOLD},
    {"tile2", tokens::T_TILE2},
    {"tiles", tokens::T_TILES},
    {"trace", tokens::T_TRACE},
    {"transform", tokens::T_TRANSFORM},
    {"translate", tokens::T_TRANSLATE},
    {"triangle", tokens::T_TRIANGLE},
    {"ttf", tokens::T_TTF},
    {"uv_mapping", tokens::T_UV_MAPPING},
    {"uv_vectors", tokens::T_UV_VECTORS},
    {"warp", tokens::T_WARP},
};

constexpr int detail(Constant constant) {
  return static_cast<int>(constant);
}
constexpr int detail(ColourModel model) {
  return static_cast<int>(model);
}
constexpr int detail(Channel channel) {
  return static_cast<int>(channel);
}
constexpr int detail(Csg::Operation operation) {
  return static_cast<int>(operation);
}

const DetailedWord kDetailedWords[] = {
    {"x", tokens::T_CONSTANT, detail(Constant::x)},
    {"y", tokens::T_CONSTANT, detail(Constant::y)},
    {"z", tokens::T_CONSTANT, detail(Constant::z)},
    {"u", tokens::T_CONSTANT, detail(Constant::u)},
    {"v", tokens::T_CONSTANT, detail(Constant::v)},
    {"t", tokens::T_CONSTANT, detail(Constant::t)},
    {"pi", tokens::T_CONSTANT, detail(Constant::pi)},
    {"on", tokens::T_CONSTANT, detail(Constant::on)},
    {"yes", tokens::T_CONSTANT, detail(Constant::on)},
    {"true", tokens::T_CONSTANT, detail(Constant::on)},
    {"off", tokens::T_CONSTANT, detail(Constant::off)},
    {"no", tokens::T_CONSTANT, detail(Constant::off)},
    {"false", tokens::T_CONSTANT, detail(Constant::off)},
    {"clock", tokens::T_CONSTANT, detail(Constant::clock)},
    {"clock_delta", tokens::T_CONSTANT, detail(Constant::clock_delta)},
    {"now", tokens::T_CONSTANT, detail(Constant::now)},
    {"version", tokens::T_CONSTANT, detail(Constant::version)},
    {"rgb", tokens::T_COLOUR_MODEL, detail(ColourModel::rgb)},
    {"rgbf", tokens::T_COLOUR_MODEL, detail(ColourModel::rgbf)},
    {"rgbt", tokens::T_COLOUR_MODEL, detail(ColourModel::rgbt)},
    {"rgbft", tokens::T_COLOUR_MODEL, detail(ColourModel::rgbft)},
    {"srgbf", tokens::T_SRGB_MODEL, detail(ColourModel::rgbf)},
    {"srgbt", tokens::T_SRGB_MODEL, detail(ColourModel::rgbt)},
    {"srgbft", tokens::T_SRGB_MODEL, detail(ColourModel::rgbft)},
    {"red", tokens::T_CHANNEL, detail(Channel::red)},
    {"green", tokens::T_CHANNEL, detail(Channel::green)},
    {"blue", tokens::T_CHANNEL, detail(Channel::blue)},
    {"filter", tokens::T_CHANNEL, detail(Channel::filter)},
    {"alpha", tokens::T_CHANNEL, detail(Channel::filter)}, // name before version 3
    {"transmit", tokens::T_CHANNEL, detail(Channel::transmit)},
    {"linear_spline", tokens::T_SPLINE_KIND, static_cast<int>(Spline::Kind::linear)},
    {"quadratic_spline", tokens::T_SPLINE_KIND, static_cast<int>(Spline::Kind::quadratic)},
    {"cubic_spline", tokens::T_SPLINE_KIND, static_cast<int>(Spline::Kind::cubic)},
    {"natural_spline", tokens::T_SPLINE_KIND, static_cast<int>(Spline::Kind::natural)},
    {"b_spline", tokens::T_CURVE_WORD, static_cast<int>(CurveWord::b_spline)},
    {"bezier_spline", tokens::T_CURVE_WORD, static_cast<int>(CurveWord::bezier)},
    {"image_map", tokens::T_PICTURE, static_cast<int>(PictureUse::image_map)},
    {"image_pattern", tokens::T_PICTURE, static_cast<int>(PictureUse::image_pattern)},
    {"linear_sweep", tokens::T_CURVE_WORD, static_cast<int>(CurveWord::linear_sweep)},
    {"conic_sweep", tokens::T_CURVE_WORD, static_cast<int>(CurveWord::conic_sweep)},
    {"union", tokens::T_CSG, detail(Csg::Operation::union_)},
    {"composite", tokens::T_CSG, detail(Csg::Operation::union_)}, // before version 2
    {"merge", tokens::T_CSG, detail(Csg::Operation::merge)},
    {"intersection", tokens::T_CSG, detail(Csg::Operation::intersection)},
    {"difference", tokens::T_CSG, detail(Csg::Operation::difference)},
};

struct ComponentWord {
  const char* text;
  int component;
};

const ComponentWord kComponents[] = {
    {"x", 0},     {"y", 1},
    {"z", 2},     {"t", 3},
    {"u", 0},     {"v", 1},
    {"red", 0},   {"green", 1},
    {"blue", 2},  {"filter", 3},
    {"alpha", 3}, {"transmit", 4},
    {"gray", 5},  {"hf", kHeightComponent},
};

struct DirectiveWord {
  const char* text;
  Directive directive;
};

const DirectiveWord kDirectives[] = {
    {"break", Directive::break_},
    {"case", Directive::case_},
    {"debug", Directive::debug},
    {"declare", Directive::declare},
    {"default", Directive::default_},
    {"else", Directive::else_},
    {"elseif", Directive::elseif},
    {"end", Directive::end},
    {"error", Directive::error},
    {"for", Directive::for_},
    {"if", Directive::if_},
    {"ifdef", Directive::ifdef},
    {"ifndef", Directive::ifndef},
    {"include", Directive::include},
    {"local", Directive::local},
    {"macro", Directive::macro},
    {"range", Directive::range},
    {"render", Directive::render},
    {"statistics", Directive::statistics},
    {"switch", Directive::switch_},
    {"undef", Directive::undef},
    {"version", Directive::version},
    {"warning", Directive::warning},
    {"while", Directive::while_},
    {"fopen", Directive::fopen_},
    {"fclose", Directive::fclose_},
    {"read", Directive::read_},
    {"write", Directive::write_},
};

// Words that POV-Ray 3.7 reserves for unsupported features: objects, words with a block in braces of their
// own, and the rest.
const char* const kUnsupportedObjects[] = {
    "isosurface", "julia_fractal", "ovus", "parametric",
    "sphere_sweep", 
};

const char* const kUnsupportedBlocks[] = {
    "bump_map",      "contained_by", "density", "density_map", 
    "material_map", "media",   "mesh_camera", "subsurface",
};

const char* const kUnsupportedFeatures[] = {
    "absorption", "all_intersections", "autostop",   "cube",    "density_file",
    "importance", "load_file",         "max_trace",  "no_bump_scale", "pattern", "precision",
    "quaternion", "save_file",         "scattering", "spacing",       "tiling",  "translucency",
};

// Words in the arguments of other unsupported words.
const char* const kUnsupportedArguments[] = {
    "aa_level",
    "aa_threshold",
    "always_sample",
    "ascii",
    "brightness",
    "count",
    "df3",
    "eccentricity",
    "error_bound",
    "evaluate",
    "expand_thresholds",
    "extinction",
    "gather",
    "gray_threshold",
    "hypercomplex",
    "intervals",
    "low_error_factor",
    "max_gradient",
    "max_iteration",
    "max_sample",
    "minimum_reuse",
    "nearest_count",
    "precompute",
    "pretrace_end",
    "pretrace_start",
    "pwr",
    "ratio",
    "recursion_limit",
    "samples",
    "slice",
    "tolerance",
    "utf8",
};

// Words that directives and functions handle themselves.
const char* const kWordsReadApart[] = {"append", "prod", "sum"};

/// Words that are taken for what is not supported.
constexpr std::string_view kRefused[] = {
    "aperture", "blur_samples", "dispersion", "photons", "radiosity",
};

int token_of(ItemForm form) {
  switch (form) {
  case ItemForm::word:
    return tokens::T_WORD_ITEM;
  case ItemForm::value:
    return tokens::T_VALUE_ITEM;
  case ItemForm::option:
    return tokens::T_OPTION_ITEM;
  case ItemForm::pair:
    return tokens::T_PAIR_ITEM;
  case ItemForm::share:
    return tokens::T_SHARE_ITEM;
  case ItemForm::colour:
    return tokens::T_COLOUR_ITEM;
  case ItemForm::colour_or_black:
    return tokens::T_COLOUR_OR_BLACK_ITEM;
  case ItemForm::list:
    break;
  }
  return tokens::T_LIST_ITEM;
}

int token_of(PatternForm form) {
  switch (form) {
  case PatternForm::plain:
    return tokens::T_PATTERN;
  case PatternForm::argument:
    return tokens::T_ARGUED_PATTERN;
  case PatternForm::list:
    return tokens::T_LIST_PATTERN;
  case PatternForm::special:
    break;
  }
  return tokens::T_PATTERN;
}

std::vector<ReservedWord> make_reserved_words() {
  std::vector<ReservedWord> words;
  for (const Word& word : kWords)
    words.push_back({word.text, word.token, 0, false});
  for (const DetailedWord& word : kDetailedWords)
    words.push_back({word.text, word.token, word.detail, false});
  for (const char* text : kUnsupportedObjects)
    words.push_back({text, tokens::T_UNSUPPORTED_OBJECT, 0, true});
  for (const char* text : kUnsupportedBlocks)
    words.push_back({text, tokens::T_UNSUPPORTED_BLOCK, 0, true});
  for (const char* text : kUnsupportedFeatures)
    words.push_back({text, tokens::T_UNSUPPORTED, 0, true});
  for (const char* text : kUnsupportedArguments)
    words.push_back({text, tokens::T_UNSUPPORTED_ARGUMENT, 0, true});
  for (const char* text : kWordsReadApart)
    words.push_back({text, tokens::T_READ_APART, 0, false});
  int number = 0;
  for (const FunctionName& function : function_names())
    words.push_back({function.name, function.returns_text ? tokens::T_TEXT_FUNCTION : tokens::T_FUNCTION,
                     number++, false});
  number = 0;
  for (const char* shape : shape_names())
    words.push_back({shape, tokens::T_SHAPE, number++, false});
  number = 0;
  const std::vector<PatternWord> patterns = pattern_words();
  for (const PatternWord& pattern : patterns) {
    if (pattern.form != PatternForm::special)
      words.push_back({pattern.word, token_of(pattern.form), number, false});
    ++number;
  }
  number = 0;
  for (const char* kind : camera_kind_names()) {
    // A word that also stands for a pattern is the pattern's token.
    const auto is_kind = [&](const PatternWord& pattern) { return std::string_view(pattern.word) == kind; };
    if (std::none_of(patterns.begin(), patterns.end(), is_kind))
      words.push_back({kind, tokens::T_CAMERA_KIND, number, false});
    ++number;
  }
  for (const BlockWord& item : block_words()) {
    const auto is_item = [&](const ReservedWord& word) { return std::string_view(word.text) == item.text; };
    if (std::none_of(words.begin(), words.end(), is_item))
      words.push_back({item.text, tokens::T_MISPLACED, 0, false});
  }
  return words;
}

std::vector<BlockWord> make_block_words() {
  std::vector<BlockWord> words;
  for (int i = 0; i < kBlocks; ++i) {
    const auto block = static_cast<Block>(i);
    for (Block table = block; table != Block::none; table = base_of(table)) {
      int number = 0;
      for (const ItemWord& item : item_words(table))
        words.push_back(
            {item.word, block, token_of(item.form), Item::row_of(table, number++), item.is_ignored});
    }
  }
  return words;
}

using AllMeanings = std::unordered_map<std::string_view, Names::Meanings>;

AllMeanings make_meanings() {
  AllMeanings all;
  for (const BlockWord& word : block_words()) {
    Names::Meaning& meaning = all[word.text][static_cast<std::size_t>(word.block)];
    if (meaning.token == 0) meaning = {word.token, word.detail};
  }
  for (const ReservedWord& word : reserved_words()) {
    Names::Meanings& meanings = all[word.text];
    for (std::size_t block = 0; block < meanings.size(); ++block)
      if (meanings[block].token == 0)
        meanings[block] = {terminal_in(static_cast<Block>(block), word.token), word.detail};
  }
  return all;
}

} // namespace

const std::vector<ReservedWord>& reserved_words() {
  static const std::vector<ReservedWord> kAll = make_reserved_words();
  return kAll;
}

const std::vector<BlockWord>& block_words() {
  static const std::vector<BlockWord> kAll = make_block_words();
  return kAll;
}

const std::vector<const Names::Meanings*>& reserved_meanings() {
  static const AllMeanings kAll = make_meanings();
  static const std::vector<const Names::Meanings*> kInOrder = [] {
    std::vector<const Names::Meanings*> in_order;
    for (const ReservedWord& word : reserved_words())
      in_order.push_back(&kAll.at(word.text));
    return in_order;
  }();
  return kInOrder;
}

int component_of(std::string_view word) {
  for (const ComponentWord& component : kComponents)
    if (word == component.text) return component.component;
  return -1;
}

Directive directive_of(std::string_view word) {
  for (const DirectiveWord& directive : kDirectives)
    if (word == directive.text) return directive.directive;
  return Directive::none;
}

} // namespace celltrace::pov

namespace celltrace {

std::vector<Keyword> keywords() {
  using namespace pov;
  const std::vector<BlockWord>& items = block_words();
  std::vector<Keyword> result;
  for (const ReservedWord& word : reserved_words()) {
    const std::string_view text = word.text;
    const auto means_something = [&](const BlockWord& item) { return item.text == text && !item.is_ignored; };
    const bool is_ignored =
        word.token == tokens::T_MISPLACED && std::none_of(items.begin(), items.end(), means_something);
    const bool is_refused = std::find(std::begin(kRefused), std::end(kRefused), text) != std::end(kRefused);
    const auto support = is_ignored ? Keyword::Support::ignored : Keyword::Support::full;
    result.push_back({word.text, word.is_unsupported || is_refused ? Keyword::Support::none : support});
  }
  for (const DirectiveWord& word : kDirectives)
    result.push_back({std::string("#") + word.text, word.directive == Directive::unsupported
                                                        ? Keyword::Support::none
                                                        : Keyword::Support::full});
  std::sort(result.begin(), result.end(), [](const Keyword& a, const Keyword& b) { return a.word < b.word; });
  return result;
}

} // namespace celltrace
