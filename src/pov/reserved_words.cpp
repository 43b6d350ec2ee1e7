#include "pov/reserved_words.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "celltrace/pov.hpp"
#include "pov/camera.hpp"
#include "pov/constants.hpp"
#include "pov/functions.hpp"
#include "pov/grammar.hpp"
#include "pov/patterns.hpp"
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
    {"accuracy", tokens::T_ACCURACY},
    {"adaptive", tokens::T_ADAPTIVE},
    {"adc_bailout", tokens::T_ADC_BAILOUT},
    {"albedo", tokens::T_ALBEDO},
    {"altitude", tokens::T_ALTITUDE},
    {"ambient", tokens::T_AMBIENT},
    {"ambient_light", tokens::T_AMBIENT_LIGHT},
    {"angle", tokens::T_ANGLE},
    {"aperture", tokens::T_APERTURE},
    {"arc_angle", tokens::T_ARC_ANGLE},
    {"area_illumination", tokens::T_AREA_ILLUMINATION},
    {"area_light", tokens::T_AREA_LIGHT},
    {"array", tokens::T_ARRAY},
    {"assumed_gamma", tokens::T_ASSUMED_GAMMA},
    {"background", tokens::T_BACKGROUND},
    {"black_hole", tokens::T_BLACK_HOLE},
    {"blur_samples", tokens::T_BLUR_SAMPLES},
    {"bounded_by", tokens::T_BOUNDED_BY},
    {"brilliance", tokens::T_BRILLIANCE},
    {"bump_size", tokens::T_BUMP_SIZE},
    {"camera", tokens::T_CAMERA},
    {"caustics", tokens::T_CAUSTICS},
    {"charset", tokens::T_CHARSET},
    {"circular", tokens::T_CIRCULAR},
    {"clipped_by", tokens::T_CLIPPED_BY},
    {"collect", tokens::T_COLLECT},
    {"color", tokens::T_COLOUR},
    {"color_map", tokens::T_COLOUR_MAP},
    {"colour", tokens::T_COLOUR},
    {"colour_map", tokens::T_COLOUR_MAP},
    {"confidence", tokens::T_IGNORED_NUMBER},
    {"conserve_energy", tokens::T_CONSERVE_ENERGY},
    {"crand", tokens::T_CRAND},
    {"cutaway_textures", tokens::T_CUTAWAY_TEXTURES},
    {"defined", tokens::T_DEFINED},
    {"diffuse", tokens::T_DIFFUSE},
    {"dimension_size", tokens::T_DIMENSION_SIZE},
    {"dimensions", tokens::T_DIMENSIONS},
    {"direction", tokens::T_DIRECTION},
    {"dispersion", tokens::T_DISPERSION},
    {"dispersion_samples", tokens::T_IGNORED_NUMBER},
    {"distance", tokens::T_DISTANCE},
    {"dist_exp", tokens::T_DIST_EXP},
    {"double_illuminate", tokens::T_DOUBLE_ILLUMINATE},
    {"emission", tokens::T_EMISSION},
    {"exponent", tokens::T_EXPONENT},
    {"exterior", tokens::T_EXTERIOR},
    {"face_indices", tokens::T_FACE_INDICES},
    {"fade_color", tokens::T_FADE_COLOUR},
    {"fade_colour", tokens::T_FADE_COLOUR},
    {"fade_distance", tokens::T_FADE_DISTANCE},
    {"fade_power", tokens::T_FADE_POWER},
    {"falloff", tokens::T_FALLOFF},
    {"finish", tokens::T_FINISH},
    {"flip", tokens::T_FLIP},
    {"focal_point", tokens::T_IGNORED_NUMBER},
    {"falloff_angle", tokens::T_FALLOFF_ANGLE},
    {"fog", tokens::T_FOG},
    {"fog_alt", tokens::T_FOG_ALT},
    {"fog_offset", tokens::T_FOG_OFFSET},
    {"fog_type", tokens::T_FOG_TYPE},
    {"frequency", tokens::T_FREQUENCY},
    {"fresnel", tokens::T_FRESNEL},
    {"function", tokens::T_USER_FUNCTION},
    {"global_lights", tokens::T_GLOBAL_LIGHTS},
    {"global_settings", tokens::T_GLOBAL_SETTINGS},
    {"hf_gray_16", tokens::T_IGNORED_FLAG},
    {"hierarchy", tokens::T_IGNORED_FLAG},
    {"hollow", tokens::T_HOLLOW},
    {"inside", tokens::T_INSIDE},
    {"inside_vector", tokens::T_INSIDE_VECTOR},
    {"interior", tokens::T_INTERIOR},
    {"interior_texture", tokens::T_INTERIOR_TEXTURE},
    {"inverse", tokens::T_INVERSE},
    {"ior", tokens::T_IOR},
    {"irid", tokens::T_IRID},
    {"irid_wavelength", tokens::T_IRID_WAVELENGTH},
    {"jitter", tokens::T_JITTER},
    {"julia", tokens::T_JULIA},
    {"lambda", tokens::T_LAMBDA},
    {"light_group", tokens::T_LIGHT_GROUP},
    {"light_source", tokens::T_LIGHT_SOURCE},
    {"location", tokens::T_LOCATION},
    {"look_at", tokens::T_LOOK_AT},
    {"looks_like", tokens::T_LOOKS_LIKE},
    {"magnet", tokens::T_MAGNET},
    {"major_radius", tokens::T_MAJOR_RADIUS},
    {"material", tokens::T_MATERIAL},
    {"matrix", tokens::T_MATRIX},
    {"max_extent", tokens::T_MAX_EXTENT},
    {"max_intersections", tokens::T_MAX_INTERSECTIONS},
    {"max_trace_level", tokens::T_MAX_TRACE_LEVEL},
    {"media_attenuation", tokens::T_MEDIA_ATTENUATION},
    {"media_interaction", tokens::T_MEDIA_INTERACTION},
    {"mesh", tokens::T_MESH},
    {"mesh2", tokens::T_MESH2},
    {"metallic", tokens::T_METALLIC},
    {"min_extent", tokens::T_MIN_EXTENT},
    {"mm_per_unit", tokens::T_IGNORED_NUMBER},
    {"no_image", tokens::T_NO_IMAGE},
    {"no_radiosity", tokens::T_IGNORED_FLAG},
    {"no_reflection", tokens::T_NO_REFLECTION},
    {"no_shadow", tokens::T_NO_SHADOW},
    {"noise_generator", tokens::T_NOISE_GENERATOR},
    {"normal", tokens::T_NORMAL},
    {"normal_indices", tokens::T_NORMAL_INDICES},
    {"normal_map", tokens::T_NORMAL_MAP},
    {"normal_vectors", tokens::T_NORMAL_VECTORS},
    {"number_of_waves", tokens::T_NUMBER_OF_WAVES},
    {"object", tokens::T_OBJECT},
    {"octaves", tokens::T_OCTAVES},
    {"omega", tokens::T_OMEGA},
    {"open", tokens::T_OPEN},
    {"orient", tokens::T_ORIENT},
    {"orientation", tokens::T_ORIENTATION},
    {"parallel", tokens::T_PARALLEL},
    {"pass_through", tokens::T_PASS_THROUGH},
    {"phase", tokens::T_PHASE},
    {"phong", tokens::T_PHONG},
    {"phong_size", tokens::T_PHONG_SIZE},
    {"photons", tokens::T_PHOTONS},
    {"pigment", tokens::T_PIGMENT},
    {"pigment_map", tokens::T_PIGMENT_MAP},
    {"pigment_pattern", tokens::T_PIGMENT_PATTERN},
    {"point_at", tokens::T_POINT_AT},
    {"poly_wave", tokens::T_POLY_WAVE},
    {"quick_color", tokens::T_QUICK_COLOUR},
    {"quick_colour", tokens::T_QUICK_COLOUR},
    {"projected_through", tokens::T_PROJECTED_THROUGH},
    {"radiosity", tokens::T_RADIOSITY},
    {"radius", tokens::T_RADIUS},
    {"rainbow", tokens::T_RAINBOW},
    {"reflection", tokens::T_REFLECTION},
    {"reflection_exponent", tokens::T_REFLECTION_EXPONENT},
    {"refraction", tokens::T_REFRACTION},
    {"repeat", tokens::T_REPEAT},
    {"right", tokens::T_RIGHT},
    {"rotate", tokens::T_ROTATE},
    {"roughness", tokens::T_ROUGHNESS},
    {"scale", tokens::T_SCALE},
    {"shadowless", tokens::T_SHADOWLESS},
    {"sky", tokens::T_SKY},
    {"sky_sphere", tokens::T_SKY_SPHERE},
    {"slope", tokens::T_SLOPE},
    {"slope_map", tokens::T_SLOPE_MAP},
    {"smooth_triangle", tokens::T_SMOOTH_TRIANGLE},
    {"specular", tokens::T_SPECULAR},
    {"spline", tokens::T_SPLINE},
    {"split_union", tokens::T_IGNORED_FLAG},
    {"spotlight", tokens::T_SPOTLIGHT},
    {"srgb", tokens::T_SRGB},
    {"strength", tokens::T_STRENGTH},
    {"sturm", tokens::T_IGNORED_FLAG},
    {"target", tokens::T_TARGET},
    {"texture", tokens::T_TEXTURE},
    {"texture_list", tokens::T_TEXTURE_LIST},
    {"texture_map", tokens::T_TEXTURE_MAP},
    {"thickness", tokens::T_THICKNESS},
    {"tightness", tokens::T_TIGHTNESS},
    {"tile2", tokens::T_TILE2},
    {"tiles", tokens::T_TILES},
    {"trace", tokens::T_TRACE},
    {"toroidal", tokens::T_TOROIDAL},
    {"transform", tokens::T_TRANSFORM},
    {"translate", tokens::T_TRANSLATE},
    {"triangle", tokens::T_TRIANGLE},
    {"turb_depth", tokens::T_TURB_DEPTH},
    {"turbulence", tokens::T_TURBULENCE},
    {"up", tokens::T_UP},
    {"uv_indices", tokens::T_UV_INDICES},
    {"uv_mapping", tokens::T_UV_MAPPING},
    {"uv_vectors", tokens::T_UV_VECTORS},
    {"variance", tokens::T_IGNORED_NUMBER},
    {"vertex_vectors", tokens::T_VERTEX_VECTORS},
    {"warp", tokens::T_WARP},
    {"width", tokens::T_WIDTH},
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
constexpr int detail(Pattern::Wave wave) {
  return static_cast<int>(wave);
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
    {"ramp_wave", tokens::T_WAVE, detail(Pattern::Wave::ramp)},
    {"triangle_wave", tokens::T_WAVE, detail(Pattern::Wave::triangle)},
    {"sine_wave", tokens::T_WAVE, detail(Pattern::Wave::sine)},
    {"scallop_wave", tokens::T_WAVE, detail(Pattern::Wave::scallop)},
    {"cubic_wave", tokens::T_WAVE, detail(Pattern::Wave::cubic)},
    {"linear_spline", tokens::T_SPLINE_KIND, static_cast<int>(Spline::Kind::linear)},
    {"quadratic_spline", tokens::T_SPLINE_KIND, static_cast<int>(Spline::Kind::quadratic)},
    {"cubic_spline", tokens::T_SPLINE_KIND, static_cast<int>(Spline::Kind::cubic)},
    {"natural_spline", tokens::T_SPLINE_KIND, static_cast<int>(Spline::Kind::natural)},
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
    "bicubic_patch", "blob", "height_field", "isosurface", "julia_fractal", "lathe",        "ovus",
    "parametric",    "poly", "prism",        "quartic",    "sor",           "sphere_sweep", "text",
};

const char* const kUnsupportedBlocks[] = {
    "bump_map",      "contained_by", "density", "density_map", "image_map",
    "image_pattern", "material_map", "media",   "mesh_camera", "subsurface",
};

const char* const kUnsupportedFeatures[] = {
    "absorption", "all_intersections", "autostop",   "b_spline",      "cube",    "density_file",
    "importance", "load_file",         "max_trace",  "no_bump_scale", "pattern", "precision",
    "quaternion", "save_file",         "scattering", "spacing",       "tiling",  "translucency",
};

// Words in the arguments of other unsupported words.
const char* const kUnsupportedArguments[] = {
    "aa_level",
    "aa_threshold",
    "all",
    "always_sample",
    "ascii",
    "bezier_spline",
    "brightness",
    "component",
    "conic_sweep",
    "count",
    "df3",
    "eccentricity",
    "error_bound",
    "evaluate",
    "expand_thresholds",
    "extinction",
    "flatness",
    "gather",
    "gif",
    "gray_threshold",
    "hypercomplex",
    "iff",
    "interpolate",
    "intervals",
    "jpeg",
    "linear_sweep",
    "low_error_factor",
    "map_type",
    "max_gradient",
    "max_iteration",
    "max_sample",
    "minimum_reuse",
    "nearest_count",
    "once",
    "pgm",
    "png",
    "pot",
    "ppm",
    "precompute",
    "pretrace_end",
    "pretrace_start",
    "pwr",
    "ratio",
    "recursion_limit",
    "samples",
    "slice",
    "smooth",
    "sys",
    "tga",
    "threshold",
    "tiff",
    "tolerance",
    "ttf",
    "type",
    "u_steps",
    "use_alpha",
    "use_color",
    "use_colour",
    "use_index",
    "utf8",
    "v_steps",
    "water_level",
};

// Words that directives and functions handle themselves.
const char* const kWordsReadApart[] = {"append", "prod", "sum"};

/// Tokens of words with grammar rules of their own, which mark the feature as unsupported.
constexpr int kRefused[] = {
    tokens::T_APERTURE, tokens::T_BLUR_SAMPLES, tokens::T_DISPERSION, tokens::T_PHOTONS, tokens::T_RADIOSITY,
};

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

} // namespace

std::vector<ReservedWord> reserved_words() {
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
    words.push_back(
        {function.name, function.gives_text ? tokens::T_TEXT_FUNCTION : tokens::T_FUNCTION, number++, false});
  number = 0;
  for (const char* shape : shape_names()) {
    words.push_back({shape, has_option(number) ? tokens::T_OPTION_SHAPE : tokens::T_SHAPE, number, false});
    ++number;
  }
  number = 0;
  const std::vector<PatternWord> patterns = pattern_words();
  for (const PatternWord& pattern : patterns) {
    if (pattern.form != PatternForm::special)
      words.push_back({pattern.word, token_of(pattern.form), number, false});
    ++number;
  }
  number = 0;
  for (const PatternOption& option : pattern_options())
    words.push_back(
        {option.word, option.has_value ? tokens::T_PATTERN_OPTION : tokens::T_PATTERN_FLAG, number++, false});
  number = 0;
  for (const char* kind : camera_kind_names()) {
    // A word that also stands for a pattern is the pattern's token.
    const auto is_kind = [&](const PatternWord& pattern) { return std::string_view(pattern.word) == kind; };
    if (std::none_of(patterns.begin(), patterns.end(), is_kind))
      words.push_back({kind, tokens::T_CAMERA_KIND, number, false});
    ++number;
  }
  return words;
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
  std::vector<Keyword> result;
  for (const ReservedWord& word : reserved_words()) {
    const bool is_ignored = word.token == tokens::T_IGNORED_FLAG || word.token == tokens::T_IGNORED_NUMBER ||
                            word.token == tokens::T_MAX_INTERSECTIONS;
    const bool is_refused =
        std::find(std::begin(kRefused), std::end(kRefused), word.token) != std::end(kRefused);
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
