// The grammar of the POV-Ray scene language. Values are computed while they are read; TokenStream has
// already executed the directives. The grammar can be entered for a whole scene or for one value (see Start):
// entered for a value, it finishes as soon as the value is complete, whatever follows, because every state
// that could end a value reduces by default. Actions that read from the token stream themselves
// (take_literals, take_arguments, take_name, skip_group, skip_arguments) belong to rules that are reduced without
// lookahead.

%require "3.8"
%language "c++"
%skeleton "lalr1.cc"
%define api.namespace {celltrace::pov}
%define api.parser.class {Parser}
%define api.value.type variant
%define api.token.prefix {T_}
%define api.location.type {celltrace::pov::Location}
%define parse.error custom
%locations
%param { celltrace::pov::Session& session }
// Reasons for the expected conflicts: after a value, a sign or a colour's channel continues the value, although it
// could also begin the next one, since commas are optional. A number at the front of an entry of a pigment_map is the
// entry's weight. A name at the beginning of CSG stands for the whole CSG, not for its first part. A texture that is a
// name alone, or begins with one, needs no rule for the parts before it. A colour's name among an object's modifiers
// is a modifier only where no number can stand.
%expect 356

%code requires {
#include "pov/actions.hpp"
#include "pov/bounds_check.hpp"
#include "pov/functions.hpp"
#include "pov/light.hpp"
#include "pov/object_queries.hpp"
#include "pov/session.hpp"
#include "pov/shapes.hpp"
}

%code {
#define YYLLOC_DEFAULT(Current, Rhs, N) ((Current) = (N) ? YYRHSLOC(Rhs, 1) : YYRHSLOC(Rhs, 0))

// Ends an entry into the grammar for a value.
#define FINISH(...) \
  do { \
    session.tokens.finish(__VA_ARGS__, !yyla.empty()); \
    YYACCEPT; \
  } while (false)

namespace celltrace::pov {
int yylex(Parser::semantic_type* value, Location* where, Session& session);

/// Replaces bison's own push, which makes an empty symbol, moves it onto the stack, destroys it and moves the value
/// after it. Each of these steps is a jump on the symbol's kind that CPUs mispredict: without the first three, a scene
/// of many small objects takes a tenth less time.
template <>
inline void Parser::stack<Parser::stack_symbol_type>::push(Parser::stack_symbol_type&& symbol) {
  seq_.emplace_back(std::move(symbol));
}
}
}

// Tokens that select the construct to read, one for each Start.
%token START_SCENE START_CONDITION START_LIST START_EXPRESSION START_TEXT START_VALUE START_DEFAULTS

%token <Quantity> QUANTITY
%token <std::string> TEXT
%token <PigmentPtr> PIGMENT_ID
%token <NormalPtr> NORMAL_ID
%token <PigmentMapPtr> PIGMENT_MAP_ID
%token <NormalMapPtr> NORMAL_MAP_ID
%token <TextureMapPtr> TEXTURE_MAP_ID
%token <SlopeMapPtr> SLOPE_MAP_ID
%token <SkySpherePtr> SKY_SPHERE_ID
%token <FogPtr> FOG_ID
%token <RainbowPtr> RAINBOW_ID
%token <FinishPtr> FINISH_ID
%token <TexturePtr> TEXTURE_ID
%token <InteriorPtr> INTERIOR_ID
%token <std::shared_ptr<const MaterialDefinition>> MATERIAL_ID
%token <std::shared_ptr<const CameraDefinition>> CAMERA_ID
%token <ObjectPtr> OBJECT_ID
%token <Transform> TRANSFORM_ID
%token <std::shared_ptr<Array>> ARRAY_ID
%token <UnsupportedPtr> UNSUPPORTED_ID
%token <FunctionPtr> FUNCTION_ID
%token <SplinePtr> SPLINE_ID
%token UNDECLARED_ID
%token ARGUMENTS // a shape's arguments that have been read already

%token <int> SPLINE_KIND FUNCTION TEXT_FUNCTION COMPONENT COLOUR_MODEL SRGB_MODEL CHANNEL SHAPE OPTION_SHAPE CSG CAMERA_KIND
%token <int> PATTERN ARGUED_PATTERN LIST_PATTERN PATTERN_OPTION PATTERN_FLAG WAVE
%token <NameId> UNSUPPORTED UNSUPPORTED_ARGUMENT UNSUPPORTED_OBJECT UNSUPPORTED_BLOCK
%token BAD_CHARACTER DEFINED CONSTANT READ_APART
%token LESS_EQUAL GREATER_EQUAL NOT_EQUAL
%token OLD_PLUS OLD_MINUS // signs of a new value: before version 1.5 they do not join two values

%left '+' '-'
%left '*' '/'

%token ACCURACY ADC_BAILOUT AMBIENT AMBIENT_LIGHT ANGLE APERTURE ARRAY ASSUMED_GAMMA BACKGROUND BLUR_SAMPLES
%token BOUNDED_BY BRILLIANCE BUMP_SIZE CAMERA CAUSTICS CHARSET CLIPPED_BY COLOUR COLOUR_MAP CONSERVE_ENERGY CRAND
%token CUTAWAY_TEXTURES
%token DIFFUSE DIMENSIONS DIMENSION_SIZE DIRECTION DISPERSION EMISSION EXPONENT FACE_INDICES
%token FADE_DISTANCE FADE_POWER FALLOFF FINISH FREQUENCY FRESNEL GLOBAL_SETTINGS HOLLOW IGNORED_FLAG IGNORED_NUMBER
%token INSIDE_VECTOR INTERIOR INVERSE IOR IRID LAMBDA LIGHT_SOURCE LOCATION LOOKS_LIKE LOOK_AT
%token MATERIAL MATRIX MAX_INTERSECTIONS MAX_TRACE_LEVEL MESH MESH2 METALLIC NOISE_GENERATOR NORMAL NORMAL_INDICES NORMAL_MAP
%token NORMAL_VECTORS NO_SHADOW NUMBER_OF_WAVES OBJECT OCTAVES OMEGA OPEN
%token PARALLEL PHASE PHONG PHONG_SIZE PHOTONS PIGMENT PIGMENT_MAP PIGMENT_PATTERN POINT_AT POLY_WAVE QUICK_COLOUR RADIUS
%token OLD_TEXTURE // before version 3.0
%token ALBEDO ARC_ANGLE DOUBLE_ILLUMINATE FALLOFF_ANGLE GLOBAL_LIGHTS LIGHT_GROUP
%token MEDIA_ATTENUATION MEDIA_INTERACTION PROJECTED_THROUGH RADIOSITY RAINBOW WIDTH
%token ALTITUDE SLOPE
%token ADAPTIVE AREA_ILLUMINATION AREA_LIGHT CIRCULAR JITTER ORIENT
%token USER_FUNCTION SPLINE TRACE INSIDE MIN_EXTENT MAX_EXTENT
%token REFLECTION COLLECT PASS_THROUGH TARGET
%token REFLECTION_EXPONENT REFRACTION RIGHT ROTATE ROUGHNESS SCALE SHADOWLESS SKY SKY_SPHERE SMOOTH_TRIANGLE
%token SPECULAR SPOTLIGHT SRGB TEXTURE TEXTURE_LIST TEXTURE_MAP TIGHTNESS TILE2 TILES TRANSFORM TRANSLATE TRIANGLE TURBULENCE UP
%token DISTANCE FADE_COLOUR INTERIOR_TEXTURE IRID_WAVELENGTH NO_IMAGE NO_REFLECTION THICKNESS FOG FOG_ALT FOG_OFFSET FOG_TYPE TURB_DEPTH
%token UV_INDICES UV_MAPPING UV_VECTORS VERTEX_VECTORS WARP
%token BLACK_HOLE DIST_EXP EXTERIOR FLIP JULIA MAGNET MAJOR_RADIUS ORIENTATION REPEAT SLOPE_MAP STRENGTH TOROIDAL

%nterm <Quantity> quantity choice bare_choice joined truth relations operand vector vector_items comparison logic value_in_brackets
%nterm <Quantity> colour named_colour repeated_colour colour_value colour_base colour_or_black
%nterm <ColourModel> srgb_model
%nterm <Relation> relation
%nterm <Junction> junction
%nterm <Signs> signs
%nterm <std::string> text
%nterm <std::vector<Value>> arguments given_arguments
%nterm <Value> argument declarable element
%nterm <std::vector<Quantity>> numbers
%nterm <std::vector<ListEntry>> counted_list entries literals
%nterm <std::vector<std::size_t>> dimensions
%nterm <std::shared_ptr<Array>> elements
%nterm <Transform> transformation
%nterm <WrittenTransform> transform_items
%nterm <std::shared_ptr<PigmentDefinition>> pigment_base pigment_parts pigment_body
%nterm <std::shared_ptr<NormalDefinition>> normal_start normal_base declared_normal normal_parts normal_body
%nterm <PatternChange> pattern pattern_change wave_change other_change
%nterm <Limit> pattern_object
%nterm <pattern::Slope> slope facing
%nterm <Turbulence> turbulent_warp
%nterm <SpaceStep> bend
%nterm <warp::Repeat> repeat_warp
%nterm <warp::BlackHole> hole_warp
%nterm <warp::Mapping> mapping_warp
%nterm <std::vector<SlopePoint>> slope_map slope_entries
%nterm <PigmentMap> colours pigments colour_entry colour_entries pigment_entries colour_map pigment_map
%nterm <NormalMap> normals normal_entries normal_map
%nterm <TextureMap> textures texture_entries texture_map
%nterm <std::shared_ptr<FinishDefinition>> finish_parts finish_body
%nterm <ReflectionDefinition> reflection_body
%nterm <TexturePtr> texture texture_parts texture_body old_texture_parts layers
%nterm <double Finish::*> finish_number
%nterm <std::shared_ptr<SkySphereDefinition>> sky_sphere sky_sphere_body
%nterm <std::shared_ptr<FogDefinition>> fog fog_body
%nterm <std::shared_ptr<RainbowDefinition>> rainbow rainbow_body
%nterm <InteriorDefinition> interior_body
%nterm <InteriorPtr> interior
%nterm <MaterialDefinition> material_body
%nterm <std::shared_ptr<const MaterialDefinition>> material
%nterm <std::shared_ptr<CameraDefinition>> camera camera_body
%nterm <ObjectPtr> object
%nterm <std::shared_ptr<ObjectDefinition>> object_body light_body light_group
%nterm <WrittenShape> shape_start shape_head option_shape_start option_shape_head
%nterm <Compound> csg_head light_group_head
%nterm <std::vector<Limit>> limits
%nterm <std::shared_ptr<MeshBuilder>> mesh_head
%nterm <std::shared_ptr<Mesh2Definition>> mesh2_head
%nterm <std::vector<TexturePtr>> texture_list
%nterm <std::shared_ptr<TriangleDefinition>> triangle plain_triangle triangle_vertices mapped_triangle
%nterm <bool> albedo photons photon_items
%nterm <NameId> variable
%nterm <double> number number_or_0 component optional_number second_number flag entry_start
%nterm <std::shared_ptr<Spline>> spline_head spline
%nterm <double Light::*> beam_number
%nterm <UnsupportedPtr> unsupported unsupported_pattern unsupported_modifier

%start start

%%

start
  : START_SCENE scene
  | START_CONDITION '(' value_in_brackets ')' { FINISH($3); }
  | START_LIST numbers ')'                    { FINISH(std::make_shared<Array>(to_array($2))); }
  | START_EXPRESSION quantity                 { FINISH($2); }
  | START_TEXT text                           { FINISH($2); }
  | START_VALUE declarable                    { FINISH($2); }
  | START_DEFAULTS '{' defaults '}'           { FINISH(Value()); }
  ;

numbers
  : value_in_brackets             { $$.push_back($1); }
  | numbers ',' value_in_brackets { $$ = std::move($1); append(session, $$, $3, @3); }
  ;

// ---- The scene ----

scene
  : %empty
  | scene object                    { session.builder.place($2, @2); }
  | scene camera                    { session.builder.set_camera($2); }
  | scene BACKGROUND '{' colour_or_black '}' { session.builder.set_background(session.light($4, @4)); }
  | scene sky_sphere                { session.builder.set_sky_sphere(*$2, @2); }
  | scene fog                       { session.builder.add_fog(*$2, @2); }
  | scene rainbow                   { session.builder.add_rainbow(*$2, @2); }
  | scene GLOBAL_SETTINGS '{' settings '}'
  | scene MAX_TRACE_LEVEL number    { set_max_trace_level(session, $3, @3); } // syntax before version 3
  | scene MAX_INTERSECTIONS number
  | scene UNSUPPORTED_BLOCK         {
      session.diagnostics.supports(unsupported_block(session, $2, @2), @2);
      session.tokens.skip_group();
    }
  ;

settings
  : %empty
  | settings ASSUMED_GAMMA number   { set_assumed_gamma(session, $3, @3); }
  | settings ASSUMED_GAMMA SRGB     { set_assumed_gamma(session, std::nullopt, @2); }
  | settings MAX_TRACE_LEVEL number { set_max_trace_level(session, $3, @3); }
  | settings ADC_BAILOUT number     { set_adc_bailout(session, $3, @3); }
  | settings AMBIENT_LIGHT colour_or_black { session.builder.set_ambient_light(session.light($3, @3).rgb); }
  | settings NOISE_GENERATOR number { set_noise_generator(session, $3, @3); }
  | settings IRID_WAVELENGTH colour_or_black { session.builder.set_irid_wavelength(session.colour($3, @3).rgb); }
  | settings NUMBER_OF_WAVES number { set_number_of_waves(session, $3, @3); }
  | settings MAX_INTERSECTIONS number
  | settings IGNORED_NUMBER colour_value
  | settings IGNORED_FLAG flag
  | settings CHARSET UNSUPPORTED_ARGUMENT
  | settings CHARSET UNDECLARED_ID
  | settings PHOTONS {
      if (renders_media(session)) session.builder.set_photons(make_unsupported("'photons'", @2));
      session.tokens.skip_group();
    }
  | settings RADIOSITY {
      if (renders_media(session)) session.diagnostics.supports(make_unsupported("'radiosity'", @2), @2);
      session.tokens.skip_group();
    }
  | settings unsupported            { session.diagnostics.supports($2, @2); }
  ;

defaults
  : %empty
  | defaults texture  { session.builder.default_texture = $2; }
  | defaults PIGMENT '{' from_default pigment_body '}' {
      require_plain(session, session.builder.default_texture, @2);
      session.builder.default_texture = with_pigment(session.builder.default_texture, *$5);
    }
  | defaults NORMAL '{' from_default normal_body '}' {
      require_plain(session, session.builder.default_texture, @2);
      session.builder.default_texture = with_normal(session.builder.default_texture, $5);
    }
  | defaults FINISH '{' from_default finish_body '}' {
      require_plain(session, session.builder.default_texture, @2);
      session.builder.default_texture = with_finish(session.builder.default_texture, *$5);
    }
  | defaults camera   { session.builder.default_camera = *$2; }
  | defaults RADIOSITY { session.tokens.skip_group(); }
  | defaults UNSUPPORTED_BLOCK {
      session.builder.default_texture =
          with_unsupported(session.builder.default_texture, unsupported_block(session, $2, @2));
      session.tokens.skip_group();
    }
  ;

// ---- Numbers ----

// One symbol for sums and products, distinguished by precedence, so that a lone number needs no long chain of rules.
quantity
  : operand
  | signs operand         { $$ = $1.apply($2); }
  | quantity '*' quantity { $$ = $1 * $3; }
  | quantity '/' quantity { $$ = divided(session, $1, $3, @2); }
  | quantity '+' quantity { $$ = $1 + $3; }
  | quantity '-' quantity { $$ = $1 - $3; }
  ;

operand
  : QUANTITY
  | vector
  | '(' value_in_brackets ')'      { $$ = $2; }
  | operand COMPONENT              { $$ = component(session, $1, $2, @2); }
  | FUNCTION '(' arguments ')'     { $$ = call_numeric(session, $1, $3, @1); }
  | FUNCTION_ID '(' arguments ')'  { $$ = call(session, *$1, $3, @1); }
  | SPLINE_ID '(' number ')'       { $$ = $1->value($3); }
  | SPLINE_ID '(' number optional_comma SPLINE_KIND ')' { $$ = $1->value($3, Spline::Kind($5)); }
  | TRACE '(' object optional_comma quantity optional_comma quantity ')' { $$ = trace(session, *$3, $5, $7, std::nullopt, @1); }
  | TRACE '(' object optional_comma quantity optional_comma quantity ',' variable ')' {
      $$ = trace(session, *$3, $5, $7, $9, @1);
    }
  | INSIDE '(' object optional_comma quantity ')' {
      $$ = double(contains(session, *$3, session.vector($5, @5), @1));
    }
  | MIN_EXTENT '(' object ')'      { $$ = Quantity::vector(extent_of(session, *$3, @1).min); }
  | MAX_EXTENT '(' object ')'      { $$ = Quantity::vector(extent_of(session, *$3, @1).max); }
  | DIMENSIONS '(' ARRAY_ID ')'    { $$ = double(dimensions(*$3)); }
  | DIMENSION_SIZE '(' ARRAY_ID optional_comma number ')' { $$ = dimension_size(*$3, $5); }
  ;

variable // a name to write to, whatever its current value
  : %empty { $$ = session.tokens.take_name(); }
  ;

signs
  : '-'                  { $$.add('-'); }
  | '+'                  { $$.add('+'); }
  | OLD_MINUS            { $$.add('-'); }
  | OLD_PLUS             { $$.add('+'); }
  | '!'                  { $$.add('!'); }
  | signs '-'            { $$ = $1; $$.add('-'); }
  | signs '+'            { $$ = $1; }
  | signs '!'            { $$ = $1; $$.add('!'); }
  ;

vector
  : '<' vector_items optional_comma '>' {
      if ($2.is_float()) session.fail(@1, "a vector has at least two components");
      $$ = $2;
    }
  ;

vector_items
  : component                      { $$ = $1; }
  | vector_items ',' component     { $$ = $1; append_component(session, $$, $3, @3); }
  | vector_items component         { $$ = $1; append_component(session, $$, $2, @2); }
  ;

component // may be infinite: the user of the vector checks whether that is allowed
  : quantity                       { $$ = session.any_number($1, @1); }
  ;

// Comparisons and logical operators exist inside parentheses only: elsewhere < and > enclose vectors.
value_in_brackets
  : logic
  | logic '?' value_in_brackets ':' value_in_brackets { $$ = is_true(session.any_number($1, @1)) ? $3 : $5; }
  | colour
  ;

logic
  : comparison
  | logic junction comparison { $$ = join($2, $1, $3); }
  ;

comparison
  : quantity
  | comparison '<' quantity           { $$ = compare(Relation::less, $1, $3); }
  | comparison LESS_EQUAL quantity    { $$ = compare(Relation::less_equal, $1, $3); }
  | comparison '=' quantity           { $$ = compare(Relation::equal, $1, $3); }
  | comparison NOT_EQUAL quantity     { $$ = compare(Relation::not_equal, $1, $3); }
  | comparison GREATER_EQUAL quantity { $$ = compare(Relation::greater_equal, $1, $3); }
  | comparison '>' quantity           { $$ = compare(Relation::greater, $1, $3); }
  | text '=' text                     { $$ = double($1 == $3); }
  | text NOT_EQUAL text               { $$ = double($1 != $3); }
  ;

arguments
  : %empty                 { }
  | given_arguments        { $$ = std::move($1); }
  ;

given_arguments
  : argument                                { $$.push_back($1); }
  | given_arguments optional_comma argument { $$ = std::move($1); append(session, $$, $3, @3); }
  ;

argument
  : value_in_brackets      { $$ = $1; }
  | text                   { $$ = $1; }
  ;

number
  : quantity               { $$ = session.number($1, @1); }
  ;

number_or_0 // 0 if it is not finite
  : quantity               { $$ = session.number_or_0($1, @1); }
  ;

optional_number // 1 if missing
  : %empty                 { $$ = 1; }
  | number
  ;

flag // on if missing
  : optional_number        { $$ = is_true($1) ? 1 : 0; }
  ;

optional_comma
  : %empty
  | ','
  ;

// ---- Texts ----

text
  : TEXT
  | TEXT_FUNCTION '(' arguments ')' { $$ = call_text(session, $1, $3, @1); }
  ;

// ---- Colours ----

colour // with a keyword, unlike a number
  : named_colour
  | COLOUR_MODEL choice          { $$ = make_colour(ColourModel($1), $2); }
  | srgb_model choice            { $$ = decoded(session, make_colour($1, $2), @1); }
  | CHANNEL number               { $$ = with_channel(Quantity::colour({0, 0, 0}), Channel($1), $2); }
  | colour CHANNEL number        { $$ = with_channel($1, Channel($2), $3); }
  ;

named_colour
  : COLOUR                       { $$ = Quantity::colour({0, 0, 0}); } // POV-Ray starts from black
  | COLOUR choice                { $$ = $2.promoted(5); $$.is_colour = true; }
  | COLOUR COLOUR_MODEL choice   { $$ = make_colour(ColourModel($2), $3); }
  | COLOUR srgb_model choice     { $$ = decoded(session, make_colour($2, $3), @2); }
  | COLOUR CHANNEL number        { $$ = with_channel(Quantity::colour({0, 0, 0}), Channel($2), $3); }
  ;

repeated_colour // a fog's colour: POV-Ray accepts the keyword more than once
  : COLOUR named_colour            { $$ = $2; }
  | COLOUR repeated_colour         { $$ = $2; }
  | repeated_colour CHANNEL number { $$ = with_channel($1, Channel($2), $3); }
  ;

srgb_model
  : SRGB       { $$ = ColourModel::rgb; }
  | SRGB_MODEL { $$ = ColourModel($1); }
  ;

// Behind a colour's keyword POV-Ray accepts a whole expression, which needs parentheses elsewhere.
choice
  : bare_choice
  | truth
  | truth '?' choice ':' choice    { $$ = is_true(session.number($1, @1)) ? $3 : $5; }
  ;

bare_choice // without comparisons: two vectors can stand side by side
  : joined
  | joined '?' choice ':' choice { $$ = is_true(session.any_number($1, @1)) ? $3 : $5; }
  ;

joined
  : quantity
  | joined junction quantity       { $$ = join($2, $1, $3); }
  ;

truth
  : relations
  | joined junction relations      { $$ = join($2, $1, $3); }
  | truth junction quantity        { $$ = join($2, $1, $3); }
  | truth junction relations       { $$ = join($2, $1, $3); }
  ;

relations
  : quantity relation quantity     { $$ = compare($2, $1, $3); }
  | relations relation quantity    { $$ = compare($2, $1, $3); }
  ;

junction
  : '&'           { $$ = Junction::both; }
  | '|'           { $$ = Junction::either; }
  ;

relation
  : '<'           { $$ = Relation::less; }
  | LESS_EQUAL    { $$ = Relation::less_equal; }
  | '='           { $$ = Relation::equal; }
  | NOT_EQUAL     { $$ = Relation::not_equal; }
  | GREATER_EQUAL { $$ = Relation::greater_equal; }
  | '>'           { $$ = Relation::greater; }
  ;

colour_base
  : bare_choice
  | colour_base CHANNEL number   { $$ = with_channel($1, Channel($2), $3); }
  ;

colour_value
  : colour_base
  | colour
  ;

colour_or_black // black for a keyword alone, as in POV-Ray
  : %empty       { $$ = Quantity::colour({0, 0, 0}); }
  | colour_value
  ;

// ---- Transformations ----

transformation // may have numbers that are not finite: the object that it moves handles them
  : TRANSLATE quantity        { $$ = Transform::translate($2.vec3()); }
  | ROTATE quantity           { $$ = Transform::rotate($2.vec3()); }
  | SCALE quantity            { $$ = scale(session, $2, @2); }
  | MATRIX '<' entries '>'    { $$ = matrix(session, $3, @1); }
  | TRANSFORM TRANSFORM_ID    { $$ = $2; }
  | TRANSFORM '{' transform_items '}' { $$ = complete(session, $3, @1); }
  ;

transform_items // `inverse` applies to all of them, wherever it stands
  : %empty                         { }
  | transform_items transformation { $$ = $1; $$.items = $1.items.then($2); }
  | transform_items TRANSFORM_ID   { $$ = $1; $$.items = $1.items.then($2); }
  | transform_items INVERSE        { $$ = $1; $$.is_inverse = true; }
  ;

// ---- Textures ----

from_default // start of a new pigment, normal or finish; any other starts from the one that it changes
  : %empty { session.base_texture = session.builder.default_texture; }
  ;

pigment_base
  : %empty                   { $$ = std::make_shared<PigmentDefinition>(session.base_texture->pigment); }
  | pigment_base PIGMENT_ID  {
      $$ = std::make_shared<PigmentDefinition>(*$2);
      $$->uv_mapping = $1->uv_mapping;
    }
  | pigment_base UV_MAPPING  { $$ = $1; $$->uv_mapping = true; }
  ;

pigment_parts // its kind, followed by modifiers
  : pigment_base
  | pigment_base colour_value              { $$ = $1; set_colour(*$$, session.surface($2)); }
  | pigment_base pattern                   { $$ = $1; $2(session, $$->pattern); }
  | pigment_base LIST_PATTERN colours      { $$ = $1; set_colours(session, *$$, $2, $3, @2); }
  | pigment_base LIST_PATTERN pigments     { $$ = $1; set_list(session, *$$, $2, $3, @2); }
  | pigment_base pattern_object colours '}' {
      const pattern::Inside inside = inside_of(session, $2, @2);
      $$ = $1;
      set_colours(session, *$$, number_of(inside), $3, @2);
      choose($$->pattern, inside);
    }
  | pigment_base pattern_object pigments '}' {
      const pattern::Inside inside = inside_of(session, $2, @2);
      $$ = $1;
      set_list(session, *$$, number_of(inside), $3, @2);
      choose($$->pattern, inside);
    }
  | pigment_parts COLOUR_MAP colour_map    { $$ = $1; set_map(session, *$$, $3, @2); }
  | pigment_parts PIGMENT_MAP pigment_map  { $$ = $1; set_map(session, *$$, $3, @2); }
  | pigment_parts pattern_change           { $$ = $1; change(session, $$->pattern, $2); }
  | pigment_parts transformation           { $$ = $1; move(session, $$->pattern, $2, @2); }
  | pigment_parts QUICK_COLOUR colour_or_black { $$ = $1; set_quick_colour(session, *$$, session.surface($3)); }
  | pigment_parts unsupported_pattern      { $$ = $1; mark($$->pattern.unsupported, $2); }
  ;

pigment_body
  : pigment_parts { $$ = $1; check(session, *$$, @1); finish_uv_mapping(*$$); }
  ;

normal_start
  : %empty {
      const NormalPtr& base = session.base_texture->normal;
      $$ = base ? std::make_shared<NormalDefinition>(*base) : std::make_shared<NormalDefinition>();
    }
  | normal_start UV_MAPPING { $$ = $1; $$->uv_mapping = true; }
  ;

normal_base
  : normal_start
  | declared_normal
  ;

declared_normal
  : normal_start NORMAL_ID {
      $$ = std::make_shared<NormalDefinition>(*$2);
      $$->uv_mapping = $1->uv_mapping;
    }
  ;

normal_parts
  : normal_base
  | declared_normal optional_comma number      { $$ = $1; $$->amount = $3; }
  | normal_base pattern                        { $$ = $1; $2(session, $$->pattern); }
  | normal_base pattern optional_comma number  { $$ = $1; $2(session, $$->pattern); $$->amount = $4; }
  | normal_base LIST_PATTERN                   { $$ = $1; choose($$->pattern, $2); }
  | normal_base LIST_PATTERN optional_comma number { $$ = $1; choose($$->pattern, $2); $$->amount = $4; }
  | normal_base LIST_PATTERN normals           { $$ = $1; set_list(session, *$$, $2, $3, @2); }
  | normal_base pattern_object '}'             { $$ = $1; choose($$->pattern, inside_of(session, $2, @2)); }
  | normal_base pattern_object '}' optional_comma number {
      $$ = $1;
      choose($$->pattern, inside_of(session, $2, @2));
      $$->amount = $5;
    }
  | normal_base pattern_object normals '}'     {
      const pattern::Inside inside = inside_of(session, $2, @2);
      $$ = $1;
      set_list(session, *$$, number_of(inside), $3, @2);
      choose($$->pattern, inside);
    }
  | normal_parts BUMP_SIZE number              { $$ = $1; $$->amount = $3; }
  | normal_parts ACCURACY number               { $$ = $1; $$->accuracy = std::fabs($3); }
  | normal_parts NORMAL_MAP normal_map         { $$ = $1; set_map(session, *$$, $3, @2); }
  | normal_parts SLOPE_MAP slope_map           { $$ = $1; $$->slopes = ascending(std::move($3)); }
  | normal_parts pattern_change                { $$ = $1; change(session, $$->pattern, $2); }
  | normal_parts transformation                { $$ = $1; move(session, $$->pattern, $2, @2); }
  | normal_parts unsupported_pattern           { $$ = $1; mark($$->pattern.unsupported, $2); }
  ;

normal_body
  : normal_parts { $$ = $1; check(session, *$$, @1); finish_uv_mapping(*$$); }
  ;

// ---- Patterns, and the maps and lists that belong to them ----

pattern
  : PATTERN                 { $$ = chosen($1); }
  | ARGUED_PATTERN quantity { $$ = chosen($1, $2, @2); }
  | JULIA quantity optional_comma number { $$ = fractal(session, 0, &$2, $4, @1); }
  | MAGNET number ARGUED_PATTERN quantity { $$ = magnet(session, $2, $3, $4, @3); }
  | MAGNET number JULIA quantity optional_comma number { $$ = fractal(session, $2, &$4, $6, @1); }
  | SLOPE quantity          { $$ = slope(session, {session.vector($2, @2)}, @1); }
  | SLOPE '{' slope '}'     { $$ = slope(session, $3, @1); }
  | PIGMENT_PATTERN '{' from_default pigment_body '}' { $$ = grey(*$4); }
  ;

pattern_object // pattern with a list, which follows
  : OBJECT '{' object             { $$.object = $3; }
  | pattern_object transformation { $$ = $1; $$.transform = $$.transform.then($2); }
  ;

slope
  : facing
  | facing optional_comma ALTITUDE quantity optional_comma { $$ = $1; $$.altitude = session.vector($4, @4); }
  | facing optional_comma ALTITUDE quantity optional_comma number optional_comma second_number {
      $$ = $1;
      $$.altitude = session.vector($4, @4);
      set_range($$.lowest, $$.highest, $6, $8);
    }
  ;

facing
  : quantity                { $$.direction = session.vector($1, @1); }
  | quantity optional_comma number optional_comma second_number {
      $$.direction = session.vector($1, @1);
      set_range($$.least, $$.most, $3, $5);
    }
  ;

second_number // 0 if missing
  : %empty                  { $$ = 0; }
  | number
  ;

pattern_change
  : wave_change
  | other_change
  ;

wave_change
  : FREQUENCY number        { $$ = set(&Pattern::frequency, $2); }
  | PHASE number            { $$ = set(&Pattern::phase, $2); }
  ;

other_change
  : TURBULENCE quantity     { $$ = set(&Turbulence::amount, session.vector($2, @2)); }
  | OCTAVES number          { $$ = set(&Turbulence::octaves, octaves($2)); }
  | OMEGA number            { $$ = set(&Turbulence::omega, $2); }
  | LAMBDA number           { $$ = set(&Turbulence::lambda, $2); }
  | WAVE                    { $$ = set(&Pattern::wave, Pattern::Wave($1)); }
  | POLY_WAVE optional_number { $$ = poly_wave($2); }
  | NOISE_GENERATOR number  { $$ = set(&Pattern::noise_generator, noise_generator(session, $2, @2)); }
  | PATTERN_OPTION quantity { $$ = option($1, $2, @1); }
  | PATTERN_FLAG            { $$ = option($1, 0, @1); }
  | EXPONENT number         { $$ = fractal_exponent($2, @1); }
  | EXTERIOR number optional_comma number { $$ = exterior($2, $4, @1); }
  | INTERIOR number optional_comma number { $$ = interior($2, $4, @1); }
  | WARP '{' bend '}'       { $$ = warp($3, @1); }
  ;

bend
  : turbulent_warp { $$ = $1; }
  | repeat_warp    { $$ = $1; }
  | hole_warp      { keep_apart(session, $1, @1); $$ = $1; }
  | mapping_warp   { $$ = $1; }
  ;

repeat_warp
  : REPEAT quantity                     { $$ = repeat(session, session.vector($2, @2), @2); }
  | repeat_warp FLIP quantity           { $$ = $1; $$.flip = session.vector($3, @3); }
  | repeat_warp PATTERN_OPTION quantity { $$ = $1; $$.offset = offset(session, $2, $3, @2); }
  ;

hole_warp
  : BLACK_HOLE quantity optional_comma number { $$.centre = session.vector($2, @2); $$.radius = $4; }
  | hole_warp FALLOFF number       { $$ = $1; $$.falloff = $3; }
  | hole_warp STRENGTH number      { $$ = $1; $$.strength = $3; }
  | hole_warp INVERSE              { $$ = $1; $$.is_inverse = true; }
  | hole_warp REPEAT quantity      { $$ = $1; $$.repeat = session.vector($3, @3); }
  | hole_warp TURBULENCE quantity  { $$ = $1; $$.turbulence = session.vector($3, @3); }
  ;

mapping_warp
  : PATTERN                           { $$ = mapping(session, $1, @1); }
  | PATTERN quantity optional_comma number { $$ = mapping(session, $1, @1); $$.orientation = session.vector($2, @2); $$.distance = $4; }
  | TOROIDAL                          { $$.shape = warp::Mapping::Shape::toroidal; }
  | mapping_warp ORIENTATION quantity { $$ = $1; $$.orientation = session.vector($3, @3); }
  | mapping_warp DIST_EXP number      { $$ = $1; $$.distance_exponent = $3; }
  | mapping_warp MAJOR_RADIUS number  { $$ = $1; $$.major_radius = $3; }
  ;

turbulent_warp
  : TURBULENCE quantity    { $$.amount = session.vector($2, @2); }
  | turbulent_warp OCTAVES number { $$ = $1; $$.octaves = octaves($3); }
  | turbulent_warp OMEGA number   { $$ = $1; $$.omega = $3; }
  | turbulent_warp LAMBDA number  { $$ = $1; $$.lambda = $3; }
  ;

colours // a comma may follow each entry of a list
  : %empty { }
  | colours colour_value optional_comma {
      $$ = std::move($1);
      add(session, $$, 0, session.surface($2), @2);
    }
  ;

pigments
  : PIGMENT '{' from_default pigment_body '}' optional_comma { add(session, $$, 0, *$4, @1); }
  | pigments PIGMENT '{' from_default pigment_body '}' optional_comma {
      $$ = std::move($1);
      add(session, $$, 0, *$5, @2);
    }
  ;

normals
  : NORMAL '{' from_default normal_body '}' optional_comma { add(session, $$, 0, *$4, @1); }
  | normals NORMAL '{' from_default normal_body '}' optional_comma {
      $$ = std::move($1);
      add(session, $$, 0, *$5, @2);
    }
  ;

textures
  : texture optional_comma          { add(session, $$, 0, $1, @1); }
  | textures texture optional_comma { $$ = std::move($1); add(session, $$, 0, $2, @2); }
  ;

colour_map
  : '{' PIGMENT_MAP_ID '}' { $$ = *$2; }
  | '{' colour_entries '}' { $$ = std::move($2); }
  ;

colour_entries
  : colour_entry                { $$ = std::move($1); }
  | colour_entries colour_entry { $$ = std::move($1); add(session, $$, $2, @2); }
  ;

colour_entry // the old form has both ends of an interval
  : '[' number optional_comma colour_or_black ']' { add_colour(session, $$, $2, $4, @4); }
  | '[' number optional_comma colour_base optional_comma colour optional_comma colour ']' {
      add_colour(session, $$, $2, $6, @6);
      add_colour(session, $$, session.number($4, @4), $8, @8);
    }
  ;

pigment_map
  : '{' PIGMENT_MAP_ID '}'  { $$ = *$2; }
  | '{' pigment_entries '}' { $$ = std::move($2); }
  ;

pigment_entries
  : entry_start from_default pigment_body ']' { add(session, $$, $1, *$3, @3); }
  | pigment_entries entry_start from_default pigment_body ']' {
      $$ = std::move($1);
      add(session, $$, $2, *$4, @4);
    }
  ;

normal_map
  : '{' NORMAL_MAP_ID '}'  { $$ = *$2; }
  | '{' normal_entries '}' { $$ = std::move($2); }
  ;

normal_entries
  : entry_start from_default normal_body ']' { add(session, $$, $1, *$3, @3); }
  | normal_entries entry_start from_default normal_body ']' {
      $$ = std::move($1);
      add(session, $$, $2, *$4, @4);
    }
  ;

slope_map
  : '{' SLOPE_MAP_ID '}'  { $$ = *$2; }
  | '{' slope_entries '}' { $$ = std::move($2); }
  ;

slope_entries
  : '[' number optional_comma quantity ']' { add(session, $$, $2, session.vector($4, @4), @2); }
  | slope_entries '[' number optional_comma quantity ']' {
      $$ = std::move($1);
      add(session, $$, $3, session.vector($5, @5), @3);
    }
  ;

texture_map
  : '{' TEXTURE_MAP_ID '}'  { $$ = *$2; }
  | '{' texture_entries '}' { $$ = std::move($2); }
  ;

texture_entries
  : entry_start texture_body ']'                 { add(session, $$, $1, $2, @2); }
  | texture_entries entry_start texture_body ']' { $$ = std::move($1); add(session, $$, $2, $3, @3); }
  ;

entry_start // an average's entries need no weight; a number is a weight, not a colour
  : '['                       { $$ = 1; }
  | '[' number optional_comma { $$ = $2; }
  ;

// ---- Finishes and textures ----

finish_body
  : finish_parts { $$ = $1; settle_albedos(*$$); }
  ;

finish_parts
  : %empty {
      $$ = std::make_shared<FinishDefinition>(session.base_texture->finish);
    }
  | finish_parts FINISH_ID                  { $$ = std::make_shared<FinishDefinition>(*$2); }
  | finish_parts AMBIENT colour_or_black     { $$ = $1; $$->value.ambient = session.light($3, @3).rgb; }
  | finish_parts EMISSION colour_or_black    { $$ = $1; $$->value.emission = session.light($3, @3).rgb; }
  | finish_parts DIFFUSE albedo number_or_0 { $$ = $1; set_diffuse(*$$, $3, $4, 0); }
  | finish_parts DIFFUSE albedo number_or_0 ',' { $$ = $1; set_diffuse(*$$, $3, $4, 0); }
  | finish_parts DIFFUSE albedo number_or_0 optional_comma number { $$ = $1; set_diffuse(*$$, $3, $4, $6); }
  | finish_parts BRILLIANCE number          { $$ = $1; $$->value.brilliance = $3; }
  | finish_parts PHONG albedo number_or_0   { $$ = $1; $$->value.phong = $4; $$->phong_is_albedo |= $3; }
  | finish_parts PHONG_SIZE number          { $$ = $1; $$->value.phong_size = $3; }
  | finish_parts SPECULAR albedo number_or_0 { $$ = $1; $$->value.specular = $4; $$->specular_is_albedo |= $3; }
  | finish_parts ROUGHNESS number           { $$ = $1; $$->value.roughness = roughness(session, $3, @3); }
  | finish_parts METALLIC optional_number   { $$ = $1; $$->value.metallic = $3; }
  | finish_parts CONSERVE_ENERGY flag       { $$ = $1; $$->value.conserve_energy = $3 != 0; }
  | finish_parts REFLECTION colour_or_black  { $$ = $1; set_reflection($$->value, session.colour($3, @3).rgb); }
  | finish_parts REFLECTION '{' reflection_body '}' { $$ = $1; $4.apply($$->value); }
  | finish_parts REFLECTION_EXPONENT number {
      $$ = $1;
      $$->value.reflection_exponent = exponent(session, $3, @3);
    }
  | finish_parts IOR number                 { $$ = $1; $$->ior = ior_of_finish(session, $3, @3); }
  | finish_parts REFRACTION number          { $$ = $1; $$->refraction = $3; }
  | finish_parts CRAND number               { $$ = $1; $$->value.crand = std::max($3, 0.0); }
  | finish_parts CAUSTICS number            { $$ = $1; $$->caustics = $3; }
  | finish_parts FADE_DISTANCE number       { $$ = $1; $$->fade_distance = $3; }
  | finish_parts FADE_POWER number          { $$ = $1; $$->fade_power = $3; }
  | finish_parts IRID '{' number            { $1->value.irid = $4; session.irid = &$1->value; }
                          irid_items '}'   { $$ = $1; }
  | finish_parts unsupported                { $$ = $1; mark($$->unsupported, $2); }
  ;

albedo // makes the number the share of light that is scattered in all directions together
  : %empty { $$ = false; }
  | ALBEDO { $$ = true; }
  ;

irid_items // set the irid of the finish that is being read
  : %empty
  | irid_items THICKNESS number  { session.irid->irid_thickness = $3; }
  | irid_items TURBULENCE number { session.irid->irid_turbulence = $3; }
  ;

reflection_body
  : %empty                                   { $$.set(Vec3(0)); }
  | colour_value optional_comma              { $$.set(session.colour($1, @1).rgb); }
  | colour_value optional_comma colour_value {
      $$.set(session.colour($1, @1).rgb, session.colour($3, @3).rgb);
    }
  | reflection_body FALLOFF number           { $$ = $1; $$.falloff = $3; }
  | reflection_body EXPONENT number          { $$ = $1; $$.exponent = exponent(session, $3, @3); }
  | reflection_body FRESNEL flag             { $$ = $1; $$.is_fresnel = $3 != 0; }
  | reflection_body METALLIC optional_number { $$ = $1; $$.metallic = $3; }
  ;

texture
  : TEXTURE '{' texture_body '}' { $$ = std::move($3); }
  | TEXTURE '{' TEXTURE_ID '}'   { $$ = std::move($3); } // needs no rules for parts: the most frequent form
  | OLD_TEXTURE '{' old_texture_parts '}' { check(session, $3, @1); $$ = std::move($3); }
  ;

// Before version 3.0, the parts of pigment, normal and finish may stand in a texture without their braces.
old_texture_parts
  : %empty                           { $$ = session.builder.default_texture; }
  | old_texture_parts TEXTURE_ID     { $$ = $2; }
  | old_texture_parts PIGMENT '{' { session.base_texture = $1; } pigment_body '}' { $$ = with_pigment($1, *$5); }
  | old_texture_parts NORMAL '{' { session.base_texture = $1; } normal_body '}' { $$ = with_normal($1, $5); }
  | old_texture_parts FINISH '{' { session.base_texture = $1; } finish_body '}' { $$ = with_finish($1, *$5); }
  | old_texture_parts PIGMENT_ID     { $$ = with_pigment($1, *$2); }
  | old_texture_parts NORMAL_ID      { $$ = with_normal($1, $2); }
  | old_texture_parts FINISH_ID      { $$ = with_finish($1, *$2); }
  | old_texture_parts colour_value   { $$ = with_old_colour(session, $1, $2); }
  | old_texture_parts PATTERN        { $$ = with_old_pattern(session, $1, $2, std::nullopt); }
  | old_texture_parts PATTERN number { $$ = with_old_pattern(session, $1, $2, $3); }
  | old_texture_parts ARGUED_PATTERN quantity {
      $$ = with_old_pattern(session, $1, chosen($2, $3, @3));
    }
  | old_texture_parts LIST_PATTERN colours {
      PigmentDefinition pigment = $1->pigment;
      set_colours(session, pigment, $2, $3, @2);
      $$ = with_pigment($1, pigment);
    }
  | old_texture_parts LIST_PATTERN textures { $$ = with_list(session, $1, $2, $3, @2); }
  | old_texture_parts TILES '{' layers TILE2 layers '}' { $$ = with_tiles(session, $1, $4, $6, @2); }
  | old_texture_parts COLOUR_MAP colour_map {
      PigmentDefinition pigment = $1->pigment;
      set_old_map(session, pigment, $3, @2);
      $$ = with_pigment($1, pigment);
    }
  | old_texture_parts QUICK_COLOUR colour_or_black {
      PigmentDefinition pigment = $1->pigment;
      set_quick_colour(session, pigment, session.surface($3));
      $$ = with_pigment($1, pigment);
    }
  | old_texture_parts wave_change    { $$ = with_old_waves(session, $1, $2); }
  | old_texture_parts other_change   { $$ = with_old_pattern(session, $1, $2); }
  | old_texture_parts transformation { $$ = transformed(session, $1, $2, @2); }
  | old_texture_parts AMBIENT colour_or_black {
      const Vec3 light = session.light($3, @3).rgb;
      $$ = with_old_finish($1, [&](FinishDefinition& finish) { finish.value.ambient = light; });
    }
  | old_texture_parts REFLECTION colour_or_black {
      const Vec3 light = session.colour($3, @3).rgb;
      $$ = with_old_finish($1, [&](FinishDefinition& finish) { set_reflection(finish.value, light); });
    }
  | old_texture_parts finish_number number {
      $$ = with_old_finish($1, [&](FinishDefinition& finish) { finish.value.*$2 = $3; });
    }
  | old_texture_parts ROUGHNESS number {
      const double value = roughness(session, $3, @3);
      $$ = with_old_finish($1, [&](FinishDefinition& finish) { finish.value.roughness = value; });
    }
  | old_texture_parts METALLIC optional_number {
      $$ = with_old_finish($1, [&](FinishDefinition& finish) { finish.value.metallic = $3; });
    }
  | old_texture_parts IOR number {
      const auto value = ior_of_finish(session, $3, @3);
      $$ = with_old_finish($1, [&](FinishDefinition& finish) { finish.ior = value; });
    }
  | old_texture_parts REFRACTION number {
      $$ = with_old_finish($1, [&](FinishDefinition& finish) { finish.refraction = $3; });
    }
  | old_texture_parts unsupported_pattern { $$ = with_pattern(session, $1, unsupported_change($2)); }
  ;

finish_number
  : DIFFUSE    { $$ = &Finish::diffuse; }
  | BRILLIANCE { $$ = &Finish::brilliance; }
  | PHONG      { $$ = &Finish::phong; }
  | PHONG_SIZE { $$ = &Finish::phong_size; }
  | SPECULAR   { $$ = &Finish::specular; }
  | CRAND      { $$ = &Finish::crand; }
  ;

texture_parts
  : %empty                       { $$ = session.builder.default_texture; }
  | TEXTURE_ID                   { $$ = std::move($1); }
  | texture_parts TEXTURE_ID     { $$ = $1->uv_mapping ? with_uv_mapping($2) : $2; }
  | texture_parts PIGMENT '{' { session.base_texture = $1; } pigment_body '}' {
      require_plain(session, $1, @2);
      $$ = with_pigment($1, *$5);
    }
  | texture_parts NORMAL '{' { session.base_texture = $1; } normal_body '}' {
      require_plain(session, $1, @2);
      $$ = with_normal($1, $5);
    }
  | texture_parts FINISH '{' { session.base_texture = $1; } finish_body '}' {
      require_plain(session, $1, @2);
      $$ = with_finish($1, *$5);
    }
  | texture_parts PIGMENT_ID     { require_plain(session, $1, @2); $$ = with_pigment($1, *$2); }
  | texture_parts NORMAL_ID      { require_plain(session, $1, @2); $$ = with_normal($1, $2); }
  | texture_parts FINISH_ID      { require_plain(session, $1, @2); $$ = with_finish($1, *$2); }
  | texture_parts pattern        { $$ = with_pattern(session, $1, $2); }
  | texture_parts LIST_PATTERN textures { $$ = with_list(session, $1, $2, $3, @2); }
  | texture_parts pattern_object textures '}' { $$ = with_object(session, $1, $2, $3, @2); }
  | texture_parts pattern_object '}' { $$ = with_object(session, $1, $2, {}, @2); }
  | texture_parts TEXTURE_MAP texture_map { $$ = with_map(session, $1, $3, @2); }
  | texture_parts LIST_PATTERN   { $$ = with_list(session, $1, $2, {}, @2); }
  | texture_parts TILES '{' layers TILE2 layers '}' { $$ = with_tiles(session, $1, $4, $6, @2); }
  | texture_parts pattern_change { $$ = changed(session, $1, $2, @2); }
  | texture_parts transformation { $$ = transformed(session, $1, $2, @2); }
  | texture_parts UV_MAPPING     { $$ = with_uv_mapping($1); }
  | texture_parts unsupported_pattern { $$ = with_pattern(session, $1, unsupported_change($2)); }
  ;

texture_body
  : texture_parts { check(session, $1, @1); $$ = with_finished_uv_mapping($1); }
  ;

layers
  : texture        { $$ = layer(session, nullptr, $1, @1); }
  | layers texture { $$ = layer(session, $1, $2, @2); }
  ;

sky_sphere
  : SKY_SPHERE '{' sky_sphere_body '}' {
      $$ = $3;
      if ($$->pigments.empty() && !$$->unsupported) session.fail(@1, "a sky_sphere needs a pigment");
    }
  ;

sky_sphere_body
  : %empty                          { $$ = std::make_shared<SkySphereDefinition>(); }
  | sky_sphere_body SKY_SPHERE_ID   { $$ = std::make_shared<SkySphereDefinition>(*$2); }
  | sky_sphere_body PIGMENT '{' from_default pigment_body '}' { $$ = $1; add_layer(session, *$$, *$5, @2); }
  | sky_sphere_body transformation  { $$ = $1; transform(session, *$$, $2, @2); }
  | sky_sphere_body EMISSION colour_value {
      $$ = $1;
      $$->emission = session.colour($3, @3).rgb;
      $$->emission_where = @2;
    }
  | sky_sphere_body unsupported     { $$ = $1; mark($$->unsupported, $2); }
  ;

fog
  : FOG '{' fog_body '}' { $$ = $3; settle(session, $$->value, @1); }
  ;

fog_body
  : %empty                      { $$ = std::make_shared<FogDefinition>(); }
  | fog_body FOG_ID             { $$ = std::make_shared<FogDefinition>(*$2); }
  | fog_body FOG_TYPE number    { $$ = $1; $$->value.is_ground = is_ground_fog(session, $3, @3); }
  | fog_body DISTANCE number_or_0 { $$ = $1; $$->value.distance = $3; }
  | fog_body colour_value       { $$ = $1; set_colour_or_distance(session, $$->value, $2, @2); }
  | fog_body repeated_colour    { $$ = $1; set_colour_or_distance(session, $$->value, $2, @2); }
  | fog_body FOG_OFFSET number  { $$ = $1; $$->value.offset = $3; }
  | fog_body FOG_ALT number     { $$ = $1; $$->value.altitude = $3; }
  | fog_body UP quantity        { $$ = $1; set_up($$->value, session.vector($3, @3)); }
  | fog_body TURBULENCE quantity { $$ = $1; $$->value.turbulence.amount = session.vector($3, @3); }
  | fog_body TURB_DEPTH number  { $$ = $1; $$->value.turbulence_depth = $3; }
  | fog_body OCTAVES number     { $$ = $1; $$->value.turbulence.octaves = octaves($3); }
  | fog_body OMEGA number       { $$ = $1; $$->value.turbulence.omega = $3; }
  | fog_body LAMBDA number      { $$ = $1; $$->value.turbulence.lambda = $3; }
  | fog_body transformation     { $$ = $1; transform($$->value, $2); }
  | fog_body unsupported        { $$ = $1; mark($$->unsupported, $2); }
  ;

rainbow
  : RAINBOW '{' rainbow_body '}' { $$ = $3; check(session, $$->value, @1); }
  ;

rainbow_body
  : %empty                          { $$ = new_rainbow(); }
  | rainbow_body RAINBOW_ID         { // a plain copy; POV-Ray 3.7 converts angles twice and loses the colours
      $$ = std::make_shared<RainbowDefinition>(*$2); }
  | rainbow_body DIRECTION quantity { $$ = $1; $$->value.direction = session.vector($3, @3); }
  | rainbow_body ANGLE number       { $$ = $1; $$->value.angle = $3; }
  | rainbow_body WIDTH number       { $$ = $1; $$->value.width = $3; }
  | rainbow_body DISTANCE number    { $$ = $1; $$->value.distance = $3; }
  | rainbow_body JITTER number      { $$ = $1; $$->value.jitter = $3; }
  | rainbow_body UP quantity        { $$ = $1; $$->value.up = session.vector($3, @3); }
  | rainbow_body ARC_ANGLE number   { $$ = $1; $$->value.arc_angle = $3; }
  | rainbow_body FALLOFF_ANGLE number { $$ = $1; $$->value.falloff_angle = $3; }
  | rainbow_body COLOUR_MAP colour_map { $$ = $1; set_colours($$->value, $3); }
  | rainbow_body unsupported        { $$ = $1; mark($$->unsupported, $2); }
  ;

interior
  : INTERIOR '{' { session.base_interior = nullptr; } interior_body '}' {
      $$ = std::make_shared<InteriorDefinition>($4);
    }
  ;

interior_body // starts from a copy of session.base_interior
  : %empty                           { if (session.base_interior) $$ = *session.base_interior; }
  | interior_body INTERIOR_ID        { $$ = *$2; }
  | interior_body IOR number         { $$ = $1; $$.ior = ior(session, $3, @3); }
  | interior_body CAUSTICS number    { $$ = $1; $$.caustics = $3; }
  | interior_body FADE_DISTANCE number { $$ = $1; $$.fade_distance = $3; }
  | interior_body FADE_POWER number  { $$ = $1; $$.fade_power = $3; }
  | interior_body FADE_COLOUR colour_or_black { $$ = $1; $$.fade_colour = session.colour($3, @3).rgb; }
  | interior_body DISPERSION number {
      $$ = $1;
      mark($$.unsupported, unless_zero("'dispersion'", $3 - 1, @2));
    }
  | interior_body REFRACTION number  { $$ = $1; } // only switched refraction on before version 3.1
  | interior_body IGNORED_NUMBER colour_value { $$ = $1; }
  | interior_body unsupported        { $$ = $1; mark($$.unsupported, $2); }
  ;

material
  : MATERIAL '{' material_body '}' { $$ = std::make_shared<MaterialDefinition>($3); }
  ;

material_body
  : %empty                       { }
  | material_body MATERIAL_ID    { $$ = *$2; }
  | material_body texture        { $$ = $1; $$.texture = layer(session, $$.texture, $2, @2); }
  | material_body INTERIOR_TEXTURE '{' texture_body '}' {
      $$ = $1;
      $$.inside = layer(session, $$.inside, $4, @2);
    }
  | material_body INTERIOR '{' { session.base_interior = $1.interior; } interior_body '}' {
      $$ = $1;
      $$.interior = std::make_shared<InteriorDefinition>($5);
    }
  | material_body transformation {
      $$ = $1;
      if ($$.texture) $$.texture = transformed(session, $$.texture, $2, @2);
      if ($$.inside) $$.inside = transformed(session, $$.inside, $2, @2);
    }
  | material_body unsupported    { $$ = $1; mark($$.unsupported, $2); }
  ;

// ---- Camera ----

camera
  : CAMERA '{' camera_body '}' { check(session, *$3, @1); $$ = $3; $$->where = @1; }
  ;

camera_body
  : %empty { $$ = start_camera(session, session.builder.default_camera, @$); }
  | camera_body CAMERA_ID          { $$ = start_camera(session, *$2, @2); }
  | camera_body CAMERA_KIND        { $$ = $1; set_kind(*$$, $2); }
  | camera_body PATTERN            { $$ = $1; set_kind_by_pattern(session, *$$, $2, @2); }
  | camera_body SHAPE number       { $$ = $1; set_kind(session, *$$, $2, $3, @2); }
  | camera_body LOCATION quantity  { $$ = $1; $$->location = $3.vec3(); }
  | camera_body DIRECTION quantity { $$ = $1; $$->direction = $3.vec3(); }
  | camera_body RIGHT quantity     { $$ = $1; $$->right = $3.vec3(); }
  | camera_body UP quantity        { $$ = $1; $$->up = $3.vec3(); }
  | camera_body SKY quantity       { $$ = $1; $$->sky = session.vector($3, @3); }
  | camera_body LOOK_AT quantity   { $$ = $1; set_look_at(session, *$$, $3.vec3(), @2); }
  | camera_body ANGLE              { $$ = $1; set_no_angle(session, *$$, @2); }
  | camera_body ANGLE quantity     { $$ = $1; set_angle(session, *$$, session.any_number($3, @3), @2); }
  | camera_body ANGLE quantity optional_comma number {
      $$ = $1;
      set_angles(session, *$$, session.number($3, @3), $5, @5);
    }
  | camera_body APERTURE number    { $$ = $1; $$->aperture = $3; $$->aperture_where = @2; }
  | camera_body BLUR_SAMPLES number { $$ = $1; $$->blur_samples = $3; }
  | camera_body BLUR_SAMPLES number optional_comma number { $$ = $1; $$->blur_samples = $5; }
  | camera_body IGNORED_NUMBER quantity { $$ = $1; }
  | camera_body transformation     { $$ = $1; transform(*$$, $2); }
  | camera_body NORMAL { $$ = $1; mark($$->unsupported, unsupported_feature(session, "'normal'", @2)); }
  | camera_body unsupported_modifier { $$ = $1; mark($$->unsupported, $2); }
  ;

// ---- Objects ----

object
  : object_body '}' {
      $1->where = @1;
      check(session, *$1, @1);
      $1->reaches_out_of_bounds = reaches_out_of_bounds(session, *$1, @1);
      $$ = own_object(session, std::move($1), @1);
    }
  | light_body '}'           { $1->where = @1; $$ = $1; session.lights.pop_back(); }
  | light_group '}'          { $1->where = @1; $$ = $1; }
  | OBJECT_ID
  | UNSUPPORTED_OBJECT {
      $$ = unsupported_object(quoted(session, $1), @1);
      session.tokens.skip_group();
    }
  | LIST_PATTERN { // `cubic` is also an object
      $$ = unsupported_object(quoted_pattern($1), @1);
      session.tokens.skip_group();
    }
  ;

shape_start
  : SHAPE '{'                { $$.number = $1; $$.where = @1; session.tokens.take_arguments($$.arguments); }
  ;

shape_head
  : shape_start ARGUMENTS    { $$ = std::move($1); }
  | shape_start quantity     { $$ = std::move($1); $$.arguments.push_back({$2, @2}); }
  | shape_head quantity      { $$ = std::move($1); append_argument(session, $$, {$2, @2}); }
  | shape_head ',' quantity  { $$ = std::move($1); append(session, $$.arguments, {$3, @3}, @3); }
  ;

// A comma may follow the last argument if optional arguments are missing.
option_shape_start
  : OPTION_SHAPE '{'         { $$.number = $1; $$.where = @1; session.tokens.take_arguments($$.arguments); }
  ;

option_shape_head
  : option_shape_start ARGUMENTS   { $$ = std::move($1); }
  | option_shape_start quantity    { $$ = std::move($1); $$.arguments.push_back({$2, @2}); }
  | option_shape_head quantity     { $$ = std::move($1); append_argument(session, $$, {$2, @2}); }
  | option_shape_head ',' quantity { $$ = std::move($1); append(session, $$.arguments, {$3, @3}, @3); }
  ;

csg_head
  : CSG '{'                  { $$.operation = Csg::Operation($1); }
  | csg_head object          { $$ = std::move($1); append(session, $$.parts, $2, @2); }
  ;

light_group_head
  : LIGHT_GROUP '{'          { $$.is_light_group = true; }
  | light_group_head object  { $$ = std::move($1); append(session, $$.parts, $2, @2); }
  ;

light_group // has parts, but no texture or other properties of its own
  : light_group_head                { $$ = csg(session, std::move($1), @1); }
  | light_group transformation      { $$ = $1; $$->apply($2); }
  | light_group GLOBAL_LIGHTS flag  { $$ = $1; set_global_lights(*$$, $3 != 0); }
  ;

// A name in place of an object's contents stands for an object of any kind.
object_body
  : OBJECT '{' object        { $$ = std::make_shared<ObjectDefinition>(*$3); }
  | shape_start OBJECT_ID    { $$ = std::make_shared<ObjectDefinition>(*$2); }
  | CSG '{' OBJECT_ID        { $$ = std::make_shared<ObjectDefinition>(*$3); }
  | MESH '{' OBJECT_ID       { $$ = std::make_shared<ObjectDefinition>(*$3); }
  | MESH2 '{' OBJECT_ID      { $$ = std::make_shared<ObjectDefinition>(*$3); }
  | shape_head               { $$ = shape(session, $1); }
  | shape_head OPEN          { $1.is_open = true; $$ = shape(session, $1); }
  | option_shape_start OBJECT_ID { $$ = std::make_shared<ObjectDefinition>(*$2); }
  | option_shape_head        { $$ = shape(session, $1); }
  | option_shape_head ','    { $1.comma = @2; $$ = shape(session, $1); }
  | LOOKS_LIKE '{' object    { $$ = look(session, *$3, @1); } // modifiers may follow, as behind any object
  | PROJECTED_THROUGH '{' object { $$ = projector(session, *$3, @1); }
  | csg_head                 { $$ = csg(session, std::move($1), @1); }
  | triangle_vertices        { $$ = lone_triangle(session, $1, @1); }
  | mesh_head                { $$ = mesh(session, *$1, @1); }
  | mesh2_head               { $$ = mesh2(session, *$1, @1); }
  | object_body transformation         { $$ = std::move($1); $$->apply($2); }
  | object_body texture                { $$ = std::move($1); add_layer(session, *$$, $2, @2); }
  | object_body PIGMENT '{' { session.base_texture = plain_texture_of(session, *$1, @2); } pigment_body '}' {
      $$ = std::move($1);
      set_texture(*$$, with_pigment(texture_of(session, *$$), *$5));
    }
  | object_body NORMAL '{' { session.base_texture = plain_texture_of(session, *$1, @2); } normal_body '}' {
      $$ = std::move($1);
      set_texture(*$$, with_normal(texture_of(session, *$$), $5));
    }
  | object_body FINISH '{' { session.base_texture = plain_texture_of(session, *$1, @2); } finish_body '}' {
      $$ = std::move($1);
      set_texture(*$$, with_finish(texture_of(session, *$$), *$5));
    }
  | object_body INTERIOR '{' { session.base_interior = $1->interior; } interior_body '}' {
      $$ = std::move($1);
      $$->interior = std::make_shared<InteriorDefinition>($5);
    }
  | object_body material               { $$ = std::move($1); apply(session, $2, *$$, @2); }
  | object_body INTERIOR_TEXTURE '{' texture_body '}' {
      $$ = std::move($1);
      set_inside(session, *$$, $4, @2);
    }
  | object_body NO_IMAGE               { $$ = std::move($1); $$->no_image = true; }
  | object_body NO_REFLECTION          { $$ = std::move($1); $$->no_reflection = true; }
  | object_body NO_SHADOW              { $$ = std::move($1); $$->no_shadow = true; }
  | object_body HOLLOW flag            { $$ = std::move($1); $$->hollow = $3 != 0; }
  | object_body DOUBLE_ILLUMINATE flag { $$ = std::move($1); $$->is_lit_through = $3 != 0; }
  | object_body INVERSE                { $$ = std::move($1); $$->inverse = !$$->inverse; }
  | object_body IGNORED_FLAG flag      { $$ = std::move($1); }
  | object_body UV_MAPPING             { $$ = std::move($1); set_uv_mapping(session, *$$, @2); }
  | object_body CUTAWAY_TEXTURES flag {
      $$ = std::move($1);
      if ($3 != 0) set_cutaway_textures(session, *$$, @2);
    }
  | object_body CLIPPED_BY '{' limits '}' { $$ = std::move($1); limit(session, *$$, $$->clipped_by, $4, @2); }
  | object_body CLIPPED_BY '{' BOUNDED_BY '}' {
      $$ = std::move($1);
      limit(session, *$$, $$->clipped_by, $$->bounded_by, @2);
    }
  | object_body BOUNDED_BY '{' limits '}' { $$ = std::move($1); limit(session, *$$, $$->bounded_by, $4, @2); }
  | object_body BOUNDED_BY '{' CLIPPED_BY '}' {
      $$ = std::move($1);
      limit(session, *$$, $$->bounded_by, $$->clipped_by, @2);
    }
  | object_body colour                 { $$ = std::move($1); ignore_colour(session, @2); }
  | object_body QUANTITY { // a colour's name
      if (!$2.is_colour) session.fail(@2, "unexpected " + session.tokens.describe_last());
      $$ = std::move($1);
      ignore_colour(session, @2);
    }
  | object_body photons                { $$ = std::move($1); $$->is_photon_target = $2; }
  | object_body RADIOSITY              { $$ = std::move($1); session.tokens.skip_group(); } // for radiosity only
  | object_body unsupported_modifier   { $$ = std::move($1); mark($$->unsupported, $2); }
  ;

photons // true if photons are to be aimed at the object
  : PHOTONS '{' photon_items '}' { $$ = $3; }
  ;

photon_items
  : %empty                              { $$ = false; }
  | photon_items ','                    { $$ = $1; }
  | photon_items TARGET optional_number { $$ = $3 != 0; }
  | photon_items photon_flag flag       { $$ = $1; }
  ;

photon_flag
  : REFRACTION
  | REFLECTION
  | COLLECT
  | PASS_THROUGH
  | AREA_LIGHT
  ;

limits // objects that clip or bound another one; they can be moved together
  : object                { $$.push_back({limiting(session, $1, @1), {}}); }
  | limits object         { $$ = std::move($1); append(session, $$, {limiting(session, $2, @2), {}}, @2); }
  | limits transformation { $$ = std::move($1); transform_limits($$, $2); }
  ;

light_body // a modifier applies to everything before it
  : LIGHT_SOURCE '{' OBJECT_ID                            { $$ = light(session, *$3, @3); }
  | LIGHT_SOURCE '{' quantity                             { $$ = light(session, $3.vec3(), Vec3(0)); }
  | LIGHT_SOURCE '{' quantity optional_comma colour_value {
      $$ = light(session, $3.vec3(), session.light($5, @5).rgb);
    }
  | light_body SPOTLIGHT                                  { $$ = $1; set_kind(*$$, Light::Kind::spotlight); }
  | light_body SHAPE                                      { $$ = $1; set_kind(session, *$$, $2, @2); }
  | light_body PARALLEL                                   { $$ = $1; light_of(*$$).parallel = true; }
  | light_body SHADOWLESS                                 { $$ = $1; set_shadowless(*$$); }
  | light_body POINT_AT quantity                          { $$ = $1; set_point_at(session, *$$, $3, @2); }
  | light_body beam_number number                         { $$ = $1; set_beam(session, *$$, $2, $3, @2); }
  | light_body FADE_DISTANCE number_or_0                    { $$ = $1; light_of(*$$).fade_distance = $3; }
  | light_body FADE_POWER number_or_0                       { $$ = $1; light_of(*$$).fade_power = $3; }
  | light_body object_body '}'                            { $$ = $1; add_object(session, *$$, $2, @2); }
  | light_body AREA_LIGHT quantity optional_comma quantity optional_comma number optional_comma number {
      $$ = $1;
      set_area(session, *$$, session.vector($3, @3), session.vector($5, @5), {$7, $9}, @2);
    }
  | light_body ADAPTIVE number                            { $$ = $1; set_adaptive(*$$, $3); }
  | light_body AREA_ILLUMINATION flag {
      $$ = $1;
      definition_of(*$$).shines_from_places = $3 != 0;
    }
  | light_body JITTER                                     { $$ = $1; area_of(*$$).jitter = true; }
  | light_body CIRCULAR                                   { $$ = $1; area_of(*$$).circular = true; }
  | light_body ORIENT                                     { $$ = $1; area_of(*$$).orient = true; }
  | light_body transformation                             { $$ = $1; transform(*$$, $2); }
  | light_body MEDIA_ATTENUATION flag { $$ = $1; definition_of(*$$).media_attenuation = $3 != 0; }
  | light_body MEDIA_INTERACTION flag { $$ = $1; definition_of(*$$).media_interaction = $3 != 0; }
  | light_body unsupported                                { $$ = $1; mark($$->unsupported, $2); }
  | light_body photons                                    { $$ = $1; }
  ;

beam_number
  : RADIUS    { $$ = &Light::radius; }
  | FALLOFF   { $$ = &Light::falloff; }
  | TIGHTNESS { $$ = &Light::tightness; }
  ;

// ---- Meshes ----

triangle
  : plain_triangle '}'                                    { $$ = $1; }
  | plain_triangle texture '}'                            { $$ = $1; $$->textures = {$2, $2, $2}; }
  | plain_triangle TEXTURE_LIST '{' texture_list '}' '}'  { $$ = $1; set_textures(session, *$$, $4, @2); }
  | plain_triangle texture TEXTURE_LIST '{' texture_list '}' '}' { $$ = $1; set_textures(session, *$$, $5, @3); }
  ;

plain_triangle
  : triangle_vertices
  | mapped_triangle
  ;

mapped_triangle
  : triangle_vertices UV_VECTORS quantity optional_comma quantity optional_comma quantity {
      $$ = $1;
      set_coordinates(session, *$$, {$3.vec3(), $5.vec3(), $7.vec3()}, @2);
    }
  ;

triangle_vertices
  : TRIANGLE '{' quantity optional_comma quantity optional_comma quantity {
      $$ = std::make_shared<TriangleDefinition>();
      $$->vertices = {$3.vec3(), $5.vec3(), $7.vec3()};
    }
  | SMOOTH_TRIANGLE '{' quantity optional_comma quantity optional_comma quantity optional_comma
                        quantity optional_comma quantity optional_comma quantity {
      $$ = std::make_shared<TriangleDefinition>();
      $$->vertices = {$3.vec3(), $7.vec3(), $11.vec3()};
      $$->normals = {$5.vec3(), $9.vec3(), $13.vec3()};
      $$->is_smooth = true;
    }
  ;

mesh_head
  : MESH '{'           { $$ = std::make_shared<MeshBuilder>(); }
  | mesh_head triangle { $$ = $1; add_triangle(session, *$$, *$2, @2); }
  | mesh_head INSIDE_VECTOR quantity { $$ = $1; $$->set_inside_vector(inside_vector(session, $3, @3)); }
  ;

mesh2_head
  : MESH2 '{'                                { $$ = std::make_shared<Mesh2Definition>(); }
  | mesh2_head VERTEX_VECTORS counted_list   { $$ = $1; $$->vertex_vectors = vectors(session, $3, @3); }
  | mesh2_head NORMAL_VECTORS counted_list   { $$ = $1; $$->normal_vectors = vectors(session, $3, @3); }
  | mesh2_head UV_VECTORS counted_list       { $$ = $1; $$->uv_vectors = vectors(session, $3, @3); }
  | mesh2_head TEXTURE_LIST '{' number texture_list '}' {
      $$ = $1;
      check_count(session, $4, $5.size(), @2);
      $$->textures = $5;
    }
  | mesh2_head FACE_INDICES counted_list     { $$ = $1; $$->face_indices = faces(session, $3, @3); }
  | mesh2_head NORMAL_INDICES counted_list   { $$ = $1; $$->normal_indices = counted(session, $3, @3); }
  | mesh2_head UV_INDICES counted_list       { $$ = $1; $$->uv_indices = counted(session, $3, @3); }
  | mesh2_head INSIDE_VECTOR quantity        { $$ = $1; $$->inside_vector = inside_vector(session, $3, @3); }
  ;

texture_list
  : %empty                   { }
  | texture_list ','         { $$ = std::move($1); }
  | texture_list texture     { $$ = std::move($1); append(session, $$, $2, @2); }
  | texture_list TEXTURE_ID  { $$ = std::move($1); append(session, $$, $2, @2); }
  ;

counted_list // begins with its count
  : '{' entries '}'      { $$ = std::move($2); }
  | '{' entries ',' '}'  { $$ = std::move($2); }
  ;

entries
  : literals quantity    { $$ = std::move($1); append(session, $$, ListEntry($2), @2); }
  | entries quantity     { $$ = std::move($1); append(session, $$, ListEntry($2), @2); }
  | entries ',' quantity { $$ = std::move($1); append(session, $$, ListEntry($3), @3); }
  ;

literals // leading entries that need no grammar
  : %empty               { session.tokens.take_literals($$); }
  ;

// ---- Values of names ----

declarable
  : quantity          { $$ = $1; }
  | colour            { $$ = $1; }
  | text              { $$ = $1; }
  | PIGMENT '{' from_default pigment_body '}' { $$ = PigmentPtr($4); }
  | NORMAL '{' from_default normal_body '}'   { $$ = NormalPtr($4); }
  | COLOUR_MAP colour_map   { $$ = std::make_shared<const PigmentMap>($2); }
  | PIGMENT_MAP pigment_map { $$ = std::make_shared<const PigmentMap>($2); }
  | NORMAL_MAP normal_map   { $$ = std::make_shared<const NormalMap>($2); }
  | SLOPE_MAP slope_map     { $$ = std::make_shared<const std::vector<SlopePoint>>($2); }
  | TEXTURE_MAP texture_map { $$ = std::make_shared<const TextureMap>($2); }
  | FINISH '{' from_default finish_body '}'   { $$ = FinishPtr($4); }
  | sky_sphere        { $$ = SkySpherePtr($1); }
  | SKY_SPHERE_ID     { $$ = $1; }
  | fog               { $$ = FogPtr($1); }
  | FOG_ID            { $$ = $1; }
  | rainbow           { $$ = RainbowPtr($1); }
  | RAINBOW_ID        { $$ = $1; }
  | layers            { $$ = $1; }
  | TEXTURE_ID        { $$ = $1; }
  | PIGMENT_ID        { $$ = $1; }
  | NORMAL_ID         { $$ = $1; }
  | PIGMENT_MAP_ID    { $$ = $1; }
  | NORMAL_MAP_ID     { $$ = $1; }
  | TEXTURE_MAP_ID    { $$ = $1; }
  | SLOPE_MAP_ID      { $$ = $1; }
  | FINISH_ID         { $$ = $1; }
  | INTERIOR_ID       { $$ = $1; }
  | MATERIAL_ID       { $$ = $1; }
  | CAMERA_ID         { $$ = $1; }
  | TRANSFORM_ID      { $$ = $1; }
  | UNSUPPORTED_ID    { $$ = $1; }
  | USER_FUNCTION     { $$ = read_function(session, @1); }
  | FUNCTION_ID       { $$ = $1; }
  | SPLINE '{' spline '}' { $$ = finished(session, $3, @1); }
  | SPLINE_ID         { $$ = $1; }
  | ARRAY_ID          { $$ = copy(session, *$1, @1); }
  | interior          { $$ = $1; }
  | material          { $$ = $1; }
  | camera            { $$ = std::shared_ptr<const CameraDefinition>($1); }
  | object            { $$ = declared($1); }
  | TRANSFORM '{' transform_items '}' { $$ = complete(session, $3, @1); }
  | UNSUPPORTED_BLOCK { $$ = make_unsupported(quoted(session, $1), @1); session.tokens.skip_group(); }
  | ARRAY dimensions  { $$ = make_array(session, $2, 0, @1); }
  | ARRAY dimensions '{' elements optional_comma '}' { $$ = filled_array(session, $2, $4, @3); }
  ;

spline
  : spline_head
  | spline number optional_comma quantity optional_comma { $$ = $1; add(session, *$$, $2, $4, @2); }
  ;

spline_head
  : %empty                   { $$ = std::make_shared<Spline>(); }
  | spline_head SPLINE_ID    { $$ = std::make_shared<Spline>(*$2); }
  | spline_head SPLINE_KIND  { $$ = $1; $$->kind = Spline::Kind($2); }
  ;

dimensions
  : '[' number ']'            { $$.push_back(array_size(session, $2, @2)); }
  | dimensions '[' number ']' { $$ = std::move($1); $$.push_back(array_size(session, $3, @3)); }
  ;

elements
  : element                   { $$ = std::make_shared<Array>(); $$->elements.push_back($1); }
  | elements element          { $$ = $1; append(session, $$->elements, $2, @2); }
  | elements ',' element      { $$ = $1; append(session, $$->elements, $3, @3); }
  ;

element
  : declarable
  | '{' elements optional_comma '}' { $$ = $2; }
  ;

// ---- Unsupported features, whose arguments are skipped ----

unsupported
  : unsupported_pattern
  | NORMAL             { $$ = unsupported_feature(session, "'normal'", @1); }
  | PATTERN            { $$ = unsupported_feature(session, quoted_pattern($1), @1); }
  ;

unsupported_pattern // of a pigment, normal or texture
  : unsupported_modifier
  | UNSUPPORTED_OBJECT { $$ = unsupported_feature(session, quoted(session, $1), @1); }
  | USER_FUNCTION      { $$ = unsupported_feature(session, "'function'", @1); }
  ;

unsupported_modifier // of an object: in CSG, an unsupported object is a part instead
  : UNSUPPORTED        { $$ = unsupported_feature(session, quoted(session, $1), @1); }
  | UNSUPPORTED_ARGUMENT { $$ = unsupported_feature(session, quoted(session, $1), @1); }
  | UNSUPPORTED_BLOCK  { $$ = unsupported_block(session, $1, @1); session.tokens.skip_arguments(); }
  ;
