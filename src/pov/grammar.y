// The grammar of the POV-Ray scene language. Values are computed while they are read; TokenStream has
// already obeyed the directives. It can be entered for a whole scene or for one value (see Start):
// entered for a value it finishes as soon as the value is complete, whatever follows, because every state
// that could end a value reduces by default. Actions that move on in the token stream themselves
// (take_literals, take_arguments, take_name, skip_group, skip_arguments) belong to rules that are reduced without
// looking ahead. What a word in a block says with the values behind it is an item, a row of a table (items.hpp).

%require "3.8"
%language "c++"
%skeleton "lalr1.cc"
%define api.namespace {celltrace::pov}
%define api.parser.class {Parser}
%define api.value.type variant
%define api.value.automove
%define api.token.prefix {T_}
%define api.location.type {celltrace::pov::Location}
%define parse.error custom
%locations
%param { celltrace::pov::Session& session }

%code requires {
#include "pov/modifiers.hpp"
#include "pov/bounds_check.hpp"
#include "pov/functions.hpp"
#include "pov/light.hpp"
#include "pov/object_queries.hpp"
#include "pov/shapes.hpp"
}

%code {
#define YYLLOC_DEFAULT(Current, Rhs, N) ((Current) = (N) ? YYRHSLOC(Rhs, 1) : YYRHSLOC(Rhs, 0))

// Ends an entry for a value.
#define FINISH(...) \
  do { \
    session.tokens.finish(__VA_ARGS__, !yyla.empty()); \
    YYACCEPT; \
  } while (false)

namespace celltrace::pov {
int yylex(Parser::semantic_type* value, Location* where, Session& session);

/// bison's own makes an empty symbol, moves it onto the stack, destroys it and moves the value after it. Each of
/// these is a jump on the symbol's kind that no CPU can foresee: without the first three a scene of many small
/// objects takes a tenth less time.
template <>
inline void Parser::stack<Parser::stack_symbol_type>::push(Parser::stack_symbol_type&& symbol) {
  seq_.emplace_back(std::move(symbol));
}
}
}

// One for each Start.
%token START_SCENE START_CONDITION START_LIST START_EXPRESSION START_TEXT START_VALUE START_DEFAULTS

%token <Quantity> QUANTITY
%token <std::string> TEXT
%token <PigmentMapPtr> PIGMENT_MAP_ID
%token <NormalMapPtr> NORMAL_MAP_ID
%token <TextureMapPtr> TEXTURE_MAP_ID
%token <SlopeMapPtr> SLOPE_MAP_ID
%token <TexturePtr> TEXTURE_ID
%token <Value> NAMED // a pigment, finish, fog or the like
%token <ObjectPtr> OBJECT_ID
%token <Transform> TRANSFORM_ID
%token <std::shared_ptr<Array>> ARRAY_ID
%token <UnsupportedPtr> UNSUPPORTED_ID
%token <FunctionPtr> FUNCTION_ID
%token <SplinePtr> SPLINE_ID
%token UNDECLARED_ID
%token ARGUMENTS // of a shape, which have been taken

// The forms of items; MISPLACED: what has no meaning where it stands.
%token <int> WORD_ITEM VALUE_ITEM OPTION_ITEM PAIR_ITEM SHARE_ITEM COLOUR_ITEM COLOUR_OR_BLACK_ITEM LIST_ITEM
%token MISPLACED

%token <int> SPLINE_KIND FUNCTION TEXT_FUNCTION COMPONENT COLOUR_MODEL SRGB_MODEL CHANNEL SHAPE CSG CAMERA_KIND
%token <int> PATTERN ARGUED_PATTERN LIST_PATTERN
%token <NameId> UNSUPPORTED UNSUPPORTED_ARGUMENT UNSUPPORTED_OBJECT UNSUPPORTED_BLOCK
%token BAD_CHARACTER DEFINED CONSTANT READ_APART
%token LESS_EQUAL GREATER_EQUAL NOT_EQUAL
%token OLD_PLUS OLD_MINUS // of a value of its own: before version 1.5 they join no two

%token ALBEDO ALTITUDE ANGLE AREA_LIGHT ARRAY ASSUMED_GAMMA BACKGROUND BLUR_SAMPLES BOUNDED_BY CAMERA CHARSET CLIPPED_BY
%token COLOUR COLOUR_MAP DIFFUSE DIMENSIONS DIMENSION_SIZE FINISH FOG GLOBAL_SETTINGS INSIDE INSIDE_VECTOR INTERIOR
%token INTERIOR_TEXTURE INVERSE IRID JULIA LIGHT_GROUP LIGHT_SOURCE LOOKS_LIKE MAGNET MATERIAL MATRIX MAX_EXTENT MESH MESH2
%token MIN_EXTENT NORMAL NORMAL_MAP OBJECT OPEN PHOTONS PIGMENT PIGMENT_MAP PIGMENT_PATTERN PROJECTED_THROUGH RADIOSITY
%token OLD_TEXTURE // before version 3.0
%token RAINBOW REFLECTION ROTATE SCALE SKY_SPHERE SLOPE SLOPE_MAP SMOOTH_TRIANGLE SPLINE SRGB TEXTURE TEXTURE_LIST
%token TEXTURE_MAP TILE2 TILES TRACE TRANSFORM TRANSLATE TRIANGLE USER_FUNCTION UV_MAPPING UV_VECTORS WARP

// Commas are optional, and so are some values: what can belong to a value does, and what can be one is.
%precedence SHORTER
%precedence QUANTITY FUNCTION FUNCTION_ID SPLINE_ID TRACE INSIDE MIN_EXTENT MAX_EXTENT DIMENSIONS DIMENSION_SIZE
%precedence '<' '(' '!' OLD_PLUS OLD_MINUS COLOUR COLOUR_MODEL SRGB SRGB_MODEL CHANNEL
%left '+' '-'
%left '*' '/'

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
%nterm <Item> item
%nterm <Modifier> modifier
%nterm <Transform> transformation
%nterm <WrittenTransform> transform_items
%nterm <std::shared_ptr<PigmentDefinition>> own_pigment pigment_base pigment_parts pigment_body
%nterm <std::shared_ptr<NormalDefinition>> own_normal normal_start normal_base declared_normal normal_parts normal_body
%nterm <PatternChange> pattern warp
%nterm <pattern::Inside> pattern_inside
%nterm <Limit> pattern_object
%nterm <pattern::Slope> slope facing
%nterm <SpaceStep> bend warp_items
%nterm <std::vector<SlopePoint>> slope_map slope_entries
%nterm <PigmentMap> colours pigments colour_entry colour_entries pigment_entries colour_map pigment_map
%nterm <NormalMap> normals normal_entries normal_map
%nterm <TextureMap> textures texture_entries texture_map
%nterm <std::shared_ptr<FinishDefinition>> own_finish finish_parts finish_body
%nterm <ReflectionDefinition> reflection_body
%nterm <TexturePtr> texture texture_parts texture_body old_texture_parts layers
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
%nterm <WrittenShape> shape_start shape_head shape_end
%nterm <Compound> csg_head light_group_head
%nterm <std::vector<Limit>> limits
%nterm <std::shared_ptr<MeshBuilder>> mesh_head
%nterm <std::shared_ptr<Mesh2Definition>> mesh2_head
%nterm <std::vector<TexturePtr>> texture_list
%nterm <std::shared_ptr<TriangleDefinition>> triangle plain_triangle triangle_vertices mapped_triangle
%nterm <PhotonsDefinition> photons photon_items
%nterm <bool> albedo
%nterm <NameId> variable
%nterm <double> number number_or_0 component second_number entry_start
%nterm <std::shared_ptr<Spline>> spline_head spline
%nterm <UnsupportedPtr> unsupported

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
  | numbers ',' value_in_brackets { $$ = $1; append(session, $$, $3, @3); }
  ;

// ---- The scene ----

scene
  : %empty
  | scene object            { session.builder.place($2, @2); }
  | scene camera            { session.builder.set_camera($2); }
  | scene BACKGROUND '{' colour_or_black '}' { session.builder.set_background(session.light($4, @4)); }
  | scene sky_sphere        { session.builder.set_sky_sphere(*$2, @2); }
  | scene fog               { session.builder.add_fog(*$2, @2); }
  | scene rainbow           { session.builder.add_rainbow(*$2, @2); }
  | scene GLOBAL_SETTINGS '{' settings '}'
  | scene item              { apply_setting(session, $2); }
  | scene UNSUPPORTED_BLOCK { refuse_block(session, $2, @2); }
  ;

settings
  : %empty
  | settings modifier { modify_settings(session, $2); }
  | settings ASSUMED_GAMMA number { set_assumed_gamma(session, $3, @3); }
  | settings ASSUMED_GAMMA SRGB   { set_assumed_gamma(session, std::nullopt, @2); }
  | settings CHARSET UNSUPPORTED_ARGUMENT
  | settings CHARSET UNDECLARED_ID
  | settings PHOTONS              { set_photons(session, @2); }
  | settings RADIOSITY            { refuse_radiosity(session, @2); }
  ;

defaults
  : %empty
  | defaults texture           { session.builder.default_texture = $2; }
  | defaults own_pigment       { set_default(session, PigmentPtr($2), @2); }
  | defaults own_normal        { set_default(session, NormalPtr($2), @2); }
  | defaults own_finish        { set_default(session, FinishPtr($2), @2); }
  | defaults camera            { session.builder.default_camera = *$2; }
  | defaults RADIOSITY         { session.tokens.skip_group(); }
  | defaults UNSUPPORTED_BLOCK { set_unsupported_default(session, $2, @2); }
  ;

// ---- Numbers ----

// One symbol for sums and products, told apart by precedence: a lone number goes through no long chain of rules.
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
  | TRACE '(' object optional_comma quantity optional_comma quantity ')' { $$ = trace(session, *$3, $5, $7, {}, @1); }
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

variable // to write to, whatever it is by now
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
  : '<' vector_items optional_comma '>' { $$ = vector(session, $2, @1); }
  ;

vector_items
  : component                      { $$ = $1; }
  | vector_items ',' component     { $$ = $1; append_component(session, $$, $3, @3); }
  | vector_items component         { $$ = $1; append_component(session, $$, $2, @2); }
  ;

component // which may be infinite: what uses the vector knows whether it takes that
  : quantity %prec SHORTER         { $$ = session.any_number($1, @1); }
  ;

// Comparisons and the like exist inside parentheses only: elsewhere < and > enclose vectors.
value_in_brackets
  : logic
  | logic '?' value_in_brackets ':' value_in_brackets { $$ = is_true(session.any_number($1, @1)) ? $3 : $5; }
  | colour %prec SHORTER
  ;

logic
  : comparison                %prec SHORTER
  | logic junction comparison %prec SHORTER { $$ = join($2, $1, $3); }
  ;

comparison
  : quantity                     %prec SHORTER
  | comparison relation quantity %prec SHORTER { $$ = compare($2, $1, $3); }
  | text '=' text                     { $$ = double($1 == $3); }
  | text NOT_EQUAL text               { $$ = double($1 != $3); }
  ;

arguments
  : %empty                 { }
  | given_arguments
  ;

given_arguments
  : argument                                { $$.push_back($1); }
  | given_arguments optional_comma argument { $$ = $1; append(session, $$, $3, @3); }
  ;

argument
  : value_in_brackets      { $$ = $1; }
  | text                   { $$ = $1; }
  ;

number
  : quantity %prec SHORTER { $$ = session.number($1, @1); }
  ;

number_or_0 // if it is not finite
  : quantity %prec SHORTER { $$ = session.number_or_0($1, @1); }
  ;

optional_comma
  : %empty %prec SHORTER
  | ','
  ;

// ---- Texts ----

text
  : TEXT
  | TEXT_FUNCTION '(' arguments ')' { $$ = call_text(session, $1, $3, @1); }
  ;

// ---- Colours ----

colour // with a keyword: distinct from a mere number
  : named_colour
  | COLOUR_MODEL choice          { $$ = make_colour(ColourModel($1), $2); }
  | srgb_model choice            { $$ = decoded(session, make_colour($1, $2), @1); }
  | CHANNEL number               { $$ = with_channel(Quantity::colour({0, 0, 0}), Channel($1), $2); }
  | colour CHANNEL number        { $$ = with_channel($1, Channel($2), $3); }
  ;

named_colour
  : COLOUR %prec SHORTER         { $$ = Quantity::colour({0, 0, 0}); } // POV-Ray starts from black
  | COLOUR choice                { $$ = $2.promoted(5); $$.is_colour = true; }
  | COLOUR COLOUR_MODEL choice   { $$ = make_colour(ColourModel($2), $3); }
  | COLOUR srgb_model choice     { $$ = decoded(session, make_colour($2, $3), @2); }
  | COLOUR CHANNEL number        { $$ = with_channel(Quantity::colour({0, 0, 0}), Channel($2), $3); }
  ;

repeated_colour // as POV-Ray takes one in a fog: with the keyword more than once
  : COLOUR named_colour            { $$ = $2; }
  | COLOUR repeated_colour         %prec SHORTER { $$ = $2; }
  | repeated_colour CHANNEL number { $$ = with_channel($1, Channel($2), $3); }
  ;

srgb_model
  : SRGB       { $$ = ColourModel::rgb; }
  | SRGB_MODEL { $$ = ColourModel($1); }
  ;

// Behind a colour's keyword POV-Ray takes a whole expression, which has brackets around it elsewhere.
choice
  : bare_choice
  | truth %prec SHORTER
  | truth '?' choice ':' choice    { $$ = is_true(session.number($1, @1)) ? $3 : $5; }
  ;

bare_choice // no comparison: two vectors can stand side by side
  : joined %prec SHORTER
  | joined '?' choice ':' choice { $$ = is_true(session.any_number($1, @1)) ? $3 : $5; }
  ;

joined
  : quantity                       %prec SHORTER
  | joined junction quantity       %prec SHORTER { $$ = join($2, $1, $3); }
  ;

truth
  : relations                      %prec SHORTER
  | joined junction relations      %prec SHORTER { $$ = join($2, $1, $3); }
  | truth junction quantity        %prec SHORTER { $$ = join($2, $1, $3); }
  | truth junction relations       %prec SHORTER { $$ = join($2, $1, $3); }
  ;

relations
  : quantity relation quantity     %prec SHORTER { $$ = compare($2, $1, $3); }
  | relations relation quantity    %prec SHORTER { $$ = compare($2, $1, $3); }
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
  : colour_base %prec SHORTER
  | colour      %prec SHORTER
  ;

colour_or_black // a keyword alone is one with black, as in POV-Ray
  : %empty %prec SHORTER { $$ = Quantity::colour({0, 0, 0}); }
  | colour_value
  ;

// ---- Items ----

item
  : WORD_ITEM                            { $$ = item($1, @1); }
  | VALUE_ITEM quantity                  %prec SHORTER { $$ = item($1, @1, $2, @2); }
  | OPTION_ITEM                          %prec SHORTER { $$ = item($1, @1); }
  | OPTION_ITEM quantity                 %prec SHORTER { $$ = item($1, @1, $2, @2); }
  | PAIR_ITEM quantity optional_comma quantity %prec SHORTER { $$ = item($1, @1, $2, @2); $$.add($4, @4); }
  | SHARE_ITEM albedo quantity           %prec SHORTER { $$ = item($1, @1, $3, @3); $$.is_albedo = $2; }
  | COLOUR_ITEM colour_value             { $$ = item($1, @1, $2, @2); }
  | COLOUR_OR_BLACK_ITEM colour_or_black { $$ = item($1, @1, $2, @2); }
  ;

modifier
  : item           { $$ = {$1, @1}; }
  | warp           { $$ = {$1, @1}; }
  | transformation { $$ = {$1, @1}; }
  | unsupported    { $$ = {$1, @1}; }
  ;

albedo // the number is the share of light that is sent on in all
  : %empty { $$ = false; }
  | ALBEDO { $$ = true; }
  ;

// ---- Transformations ----

transformation // may have numbers that are not finite: what is moved by it knows what that makes of it
  : TRANSLATE quantity        %prec SHORTER { $$ = Transform::translate($2.vec3()); }
  | ROTATE quantity           %prec SHORTER { $$ = Transform::rotate($2.vec3()); }
  | SCALE quantity            %prec SHORTER { $$ = scale(session, $2, @2); }
  | MATRIX '<' entries '>'    { $$ = matrix(session, $3, @1); }
  | TRANSFORM TRANSFORM_ID    { $$ = $2; }
  | TRANSFORM '{' transform_items '}' { $$ = complete(session, $3, @1); }
  ;

transform_items // `inverse` is for all of them, wherever it stands
  : %empty                         { }
  | transform_items transformation { $$ = $1; $$.items = $$.items.then($2); }
  | transform_items TRANSFORM_ID   { $$ = $1; $$.items = $$.items.then($2); }
  | transform_items INVERSE        { $$ = $1; $$.is_inverse = true; }
  ;

// ---- Pigments and normals ----

from_default // where a pigment, normal or finish of its own starts; any other starts from what it changes
  : %empty { session.base_texture = session.builder.default_texture; }
  ;

own_pigment
  : PIGMENT '{' from_default pigment_body '}' { $$ = $4; }
  ;

own_normal
  : NORMAL '{' from_default normal_body '}' { $$ = $4; }
  ;

own_finish
  : FINISH '{' from_default finish_body '}' { $$ = $4; }
  ;

pigment_base
  : %empty                  { $$ = copy_of(session.base_texture->pigment); }
  | pigment_base NAMED { $$ = copy_of_named<PigmentDefinition>($2); $$->uv_mapping = $1->uv_mapping; }
  | pigment_base UV_MAPPING { $$ = $1; $$->uv_mapping = true; }
  ;

pigment_parts // what it is, and then what changes that
  : pigment_base
  | pigment_base colour_value             { $$ = $1; set_colour(*$$, session.surface($2)); }
  | pigment_base pattern                  { $$ = $1; $2(session, $$->pattern); }
  | pigment_base LIST_PATTERN colours     { $$ = $1; set_colours(session, *$$, $2, $3, @2); }
  | pigment_base LIST_PATTERN pigments    { $$ = $1; set_list(session, *$$, $2, $3, @2); }
  | pigment_base pattern_object colours '}'  { $$ = $1; set_colours(session, *$$, $2, $3, @2); }
  | pigment_base pattern_object pigments '}' { $$ = $1; set_list(session, *$$, $2, $3, @2); }
  | pigment_parts COLOUR_MAP colour_map   { $$ = $1; set_map(session, *$$, $3, @2); }
  | pigment_parts PIGMENT_MAP pigment_map { $$ = $1; set_map(session, *$$, $3, @2); }
  | pigment_parts modifier { $$ = $1; modify(session, *$$, $2); }
  ;

pigment_body
  : pigment_parts { $$ = $1; check(session, *$$, @1); finish_uv_mapping(*$$); }
  ;

normal_start
  : %empty                  { $$ = copy_of_normal(session.base_texture->normal); }
  | normal_start UV_MAPPING { $$ = $1; $$->uv_mapping = true; }
  ;

normal_base
  : normal_start
  | declared_normal
  ;

declared_normal
  : normal_start NAMED { $$ = copy_of_named<NormalDefinition>($2); $$->uv_mapping = $1->uv_mapping; }
  ;

normal_parts
  : normal_base
  | declared_normal optional_comma number      { $$ = $1; $$->amount = $3; }
  | normal_base pattern                        { $$ = $1; $2(session, $$->pattern); }
  | normal_base pattern optional_comma number  { $$ = $1; $2(session, $$->pattern); $$->amount = $4; }
  | normal_base LIST_PATTERN                   { $$ = $1; choose($$->pattern, $2); }
  | normal_base LIST_PATTERN optional_comma number { $$ = $1; choose($$->pattern, $2); $$->amount = $4; }
  | normal_base LIST_PATTERN normals           { $$ = $1; set_list(session, *$$, $2, $3, @2); }
  | normal_base pattern_inside                 { $$ = $1; choose($$->pattern, $2); }
  | normal_base pattern_inside optional_comma number { $$ = $1; choose($$->pattern, $2); $$->amount = $4; }
  | normal_base pattern_object normals '}'     { $$ = $1; set_list(session, *$$, $2, $3, @2); }
  | normal_parts NORMAL_MAP normal_map         { $$ = $1; set_map(session, *$$, $3, @2); }
  | normal_parts SLOPE_MAP slope_map           { $$ = $1; $$->slopes = ascending($3); }
  | normal_parts modifier { $$ = $1; modify(session, *$$, $2); }
  ;

normal_body
  : normal_parts { $$ = $1; check(session, *$$, @1); finish_uv_mapping(*$$); }
  ;

// ---- Patterns, and the maps and lists that belong to them ----

pattern
  : PATTERN                 { $$ = chosen($1); }
  | ARGUED_PATTERN quantity %prec SHORTER { $$ = chosen($1, $2, @2); }
  | JULIA quantity optional_comma number { $$ = julia(session, 0, $2, $4, @1); }
  | MAGNET number ARGUED_PATTERN quantity %prec SHORTER { $$ = magnet(session, $2, $3, $4, @3); }
  | MAGNET number JULIA quantity optional_comma number { $$ = julia(session, $2, $4, $6, @1); }
  | SLOPE quantity          %prec SHORTER { $$ = slope(session, {session.vector($2, @2)}, @1); }
  | SLOPE '{' slope '}'     { $$ = slope(session, $3, @1); }
  | PIGMENT_PATTERN '{' from_default pigment_body '}' { $$ = grey(*$4); }
  ;

pattern_object // of a list, which follows
  : OBJECT '{' object             { $$.object = $3; }
  | pattern_object transformation { $$ = $1; $$.transform = $$.transform.then($2); }
  ;

pattern_inside // without one
  : pattern_object '}' { $$ = inside_of(session, $1, @1); }
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

second_number // 0 if not there
  : %empty                  { $$ = 0; }
  | number
  ;

warp
  : WARP '{' bend '}' { $$ = warp(session, $3, @3, @1); }
  ;

bend // complete
  : warp_items
  ;

warp_items
  : item                { $$ = warp_of(session, $1); }
  | PATTERN             { $$ = mapping(session, $1, @1); }
  | PATTERN quantity optional_comma number { $$ = mapping(session, $1, session.vector($2, @2), $4, @1); }
  | warp_items item     { $$ = $1; apply(session, $$, $2); }
  ;

colours // there may be a comma behind each entry of a list
  : %empty                              { }
  | colours colour_value optional_comma { $$ = $1; add(session, $$, 0, session.surface($2), @2); }
  ;

pigments
  : own_pigment optional_comma          { add(session, $$, 0, *$1, @1); }
  | pigments own_pigment optional_comma { $$ = $1; add(session, $$, 0, *$2, @2); }
  ;

normals
  : own_normal optional_comma         { add(session, $$, 0, *$1, @1); }
  | normals own_normal optional_comma { $$ = $1; add(session, $$, 0, *$2, @2); }
  ;

textures
  : texture optional_comma          { add(session, $$, 0, $1, @1); }
  | textures texture optional_comma { $$ = $1; add(session, $$, 0, $2, @2); }
  ;

colour_map
  : '{' PIGMENT_MAP_ID '}' { $$ = *$2; }
  | '{' colour_entries '}' { $$ = $2; }
  ;

colour_entries
  : colour_entry
  | colour_entries colour_entry { $$ = $1; add(session, $$, $2, @2); }
  ;

colour_entry // the old form has both ends of a blend
  : '[' number optional_comma colour_or_black ']' { add_colour(session, $$, $2, $4, @4); }
  | '[' number optional_comma colour_base optional_comma colour optional_comma colour ']' {
      add_colour(session, $$, $2, $6, @6);
      add_colour(session, $$, session.number($4, @4), $8, @8);
    }
  ;

pigment_map
  : '{' PIGMENT_MAP_ID '}'  { $$ = *$2; }
  | '{' pigment_entries '}' { $$ = $2; }
  ;

pigment_entries
  : entry_start from_default pigment_body ']'                 { add(session, $$, $1, *$3, @3); }
  | pigment_entries entry_start from_default pigment_body ']' { $$ = $1; add(session, $$, $2, *$4, @4); }
  ;

normal_map
  : '{' NORMAL_MAP_ID '}'  { $$ = *$2; }
  | '{' normal_entries '}' { $$ = $2; }
  ;

normal_entries
  : entry_start from_default normal_body ']'                { add(session, $$, $1, *$3, @3); }
  | normal_entries entry_start from_default normal_body ']' { $$ = $1; add(session, $$, $2, *$4, @4); }
  ;

slope_map
  : '{' SLOPE_MAP_ID '}'  { $$ = *$2; }
  | '{' slope_entries '}' { $$ = $2; }
  ;

slope_entries
  : '[' number optional_comma quantity ']' { add(session, $$, $2, session.vector($4, @4), @2); }
  | slope_entries '[' number optional_comma quantity ']' { $$ = $1; add(session, $$, $3, session.vector($5, @5), @3); }
  ;

texture_map
  : '{' TEXTURE_MAP_ID '}'  { $$ = *$2; }
  | '{' texture_entries '}' { $$ = $2; }
  ;

texture_entries
  : entry_start texture_body ']'                 { add(session, $$, $1, $2, @2); }
  | texture_entries entry_start texture_body ']' { $$ = $1; add(session, $$, $2, $3, @3); }
  ;

entry_start // an average's entries need no weight; a number is one, not a colour
  : '[' %prec SHORTER         { $$ = 1; }
  | '[' number optional_comma { $$ = $2; }
  ;

// ---- Finishes and textures ----

finish_body
  : finish_parts { $$ = $1; settle_albedos(*$$); }
  ;

finish_parts
  : %empty                                  { $$ = std::make_shared<FinishDefinition>(session.base_texture->finish); }
  | finish_parts NAMED { $$ = copy_of_named<FinishDefinition>($2); }
  | finish_parts modifier { $$ = $1; modify(session, *$$, $2); }
  | finish_parts DIFFUSE albedo number_or_0 optional_comma { $$ = $1; set_diffuse(*$$, $3, $4, 0); }
  | finish_parts DIFFUSE albedo number_or_0 optional_comma number { $$ = $1; set_diffuse(*$$, $3, $4, $6); }
  | finish_parts REFLECTION colour_or_black { $$ = $1; set_reflection($$->value, session.colour($3, @3).rgb); }
  | finish_parts REFLECTION '{' reflection_body '}' { $$ = $1; $4.apply($$->value); }
  | finish_parts IRID '{' number { start_irid(session, $1, $4); } irid_items '}' { $$ = kept<std::shared_ptr<FinishDefinition>>(session); }
  ;

irid_items // of the finish that is being read
  : %empty
  | irid_items item { apply(session, irid(session), $2); }
  ;

reflection_body
  : %empty                      { $$.set(Vec3(0)); }
  | colour_value optional_comma { $$.set(session.colour($1, @1).rgb); }
  | colour_value optional_comma colour_value { $$.set(session.colour($1, @1).rgb, session.colour($3, @3).rgb); }
  | reflection_body item        { $$ = $1; apply(session, $$, $2); }
  ;

texture
  : TEXTURE '{' texture_body '}' { $$ = $3; }
  | TEXTURE '{' TEXTURE_ID '}'   { $$ = $3; } // without the rules for parts: what most objects have
  | OLD_TEXTURE '{' old_texture_parts '}' { $$ = $3; check(session, $$, @1); }
  ;

// What pigment, normal and finish consist of may stand in a texture without their braces before version 3.0.
old_texture_parts
  : %empty                           { $$ = session.builder.default_texture; }
  | old_texture_parts TEXTURE_ID     { $$ = $2; }
  | old_texture_parts PIGMENT '{' { start_part(session, $1); } pigment_body '}' { $$ = with_pigment(kept<TexturePtr>(session), *$5); }
  | old_texture_parts NORMAL '{' { start_part(session, $1); } normal_body '}' { $$ = with_normal(kept<TexturePtr>(session), $5); }
  | old_texture_parts FINISH '{' { start_part(session, $1); } finish_body '}' { $$ = with_finish(kept<TexturePtr>(session), *$5); }
  | old_texture_parts NAMED          { $$ = with_named($1, $2); }
  | old_texture_parts colour_value   { $$ = with_old_colour(session, $1, $2); }
  | old_texture_parts PATTERN        %prec SHORTER { $$ = with_old_pattern(session, $1, $2, std::nullopt); }
  | old_texture_parts PATTERN number { $$ = with_old_pattern(session, $1, $2, $3); }
  | old_texture_parts ARGUED_PATTERN quantity %prec SHORTER { $$ = with_old_pattern(session, $1, chosen($2, $3, @3)); }
  | old_texture_parts LIST_PATTERN colours %prec SHORTER { $$ = with_old_colours(session, $1, $2, $3, @2); }
  | old_texture_parts LIST_PATTERN textures { $$ = with_list(session, $1, $2, $3, @2); }
  | old_texture_parts TILES '{' layers TILE2 layers '}' { $$ = with_tiles(session, $1, $4, $6, @2); }
  | old_texture_parts COLOUR_MAP colour_map { $$ = with_old_map(session, $1, $3, @2); }
  | old_texture_parts modifier { $$ = modified_old(session, $1, $2); }
  ;

texture_parts
  : %empty                       { $$ = session.builder.default_texture; }
  | TEXTURE_ID
  | texture_parts TEXTURE_ID     { $$ = with_texture($1, $2); }
  | texture_parts PIGMENT '{' { start_part(session, $1); } pigment_body '}' { $$ = with(session, kept<TexturePtr>(session), $5, @2); }
  | texture_parts NORMAL '{' { start_part(session, $1); } normal_body '}' { $$ = with(session, kept<TexturePtr>(session), $5, @2); }
  | texture_parts FINISH '{' { start_part(session, $1); } finish_body '}' { $$ = with(session, kept<TexturePtr>(session), $5, @2); }
  | texture_parts NAMED          { $$ = with_named(session, $1, $2, @2); }
  | texture_parts pattern        { $$ = with_pattern(session, $1, $2); }
  | texture_parts LIST_PATTERN textures { $$ = with_list(session, $1, $2, $3, @2); }
  | texture_parts pattern_object textures '}' { $$ = with_object(session, $1, $2, $3, @2); }
  | texture_parts pattern_object '}' { $$ = with_object(session, $1, $2, {}, @2); }
  | texture_parts TEXTURE_MAP texture_map { $$ = with_map(session, $1, $3, @2); }
  | texture_parts LIST_PATTERN   { $$ = with_list(session, $1, $2, {}, @2); }
  | texture_parts TILES '{' layers TILE2 layers '}' { $$ = with_tiles(session, $1, $4, $6, @2); }
  | texture_parts modifier { $$ = modified(session, $1, $2); }
  | texture_parts UV_MAPPING     { $$ = with_uv_mapping($1); }
  ;

texture_body
  : texture_parts { $$ = finished_texture(session, $1, @1); }
  ;

layers
  : texture        { $$ = layer(session, nullptr, $1, @1); }
  | layers texture { $$ = layer(session, $1, $2, @2); }
  ;

sky_sphere
  : SKY_SPHERE '{' sky_sphere_body '}' { $$ = $3; check(session, *$$, @1); }
  ;

sky_sphere_body
  : %empty                         { $$ = std::make_shared<SkySphereDefinition>(); }
  | sky_sphere_body NAMED { $$ = copy_of_named<SkySphereDefinition>($2); }
  | sky_sphere_body own_pigment    { $$ = $1; add_layer(session, *$$, *$2, @2); }
  | sky_sphere_body modifier { $$ = $1; modify(session, *$$, $2); }
  ;

fog
  : FOG '{' fog_body '}' { $$ = $3; settle(session, $$->value, @1); }
  ;

fog_body
  : %empty                   { $$ = std::make_shared<FogDefinition>(); }
  | fog_body NAMED { $$ = copy_of_named<FogDefinition>($2); }
  | fog_body colour_value    { $$ = $1; set_colour_or_distance(session, $$->value, $2, @2); }
  | fog_body repeated_colour %prec SHORTER { $$ = $1; set_colour_or_distance(session, $$->value, $2, @2); }
  | fog_body modifier { $$ = $1; modify(session, *$$, $2); }
  ;

rainbow
  : RAINBOW '{' rainbow_body '}' { $$ = $3; check(session, $$->value, @1); }
  ;

rainbow_body
  : %empty                  { $$ = new_rainbow(); }
  | rainbow_body NAMED { $$ = copy_of_named<RainbowDefinition>($2); } // where POV-Ray 3.7 turns angles twice and forgets the colours
  | rainbow_body COLOUR_MAP colour_map { $$ = $1; set_colours($$->value, $3); }
  | rainbow_body modifier { $$ = $1; modify(session, *$$, $2); }
  ;

interior
  : INTERIOR '{' { session.base_interior = nullptr; } interior_body '}' { $$ = copy_of($4); }
  ;

interior_body // changes what is there
  : %empty                    { if (session.base_interior) $$ = *session.base_interior; }
  | interior_body NAMED { $$ = *copy_of_named<InteriorDefinition>($2); }
  | interior_body modifier { $$ = $1; modify(session, $$, $2); }
  ;

material
  : MATERIAL '{' material_body '}' { $$ = copy_of($3); }
  ;

material_body
  : %empty                       { }
  | material_body NAMED { $$ = *copy_of_named<MaterialDefinition>($2); }
  | material_body texture        { $$ = $1; $$.texture = layer(session, $$.texture, $2, @2); }
  | material_body INTERIOR_TEXTURE '{' texture_body '}' { $$ = $1; $$.inside = layer(session, $$.inside, $4, @2); }
  | material_body INTERIOR '{' { start_part(session, $1); } interior_body '}' {
      $$ = kept<MaterialDefinition>(session);
      $$.interior = copy_of($5);
    }
  | material_body modifier { $$ = $1; modify(session, $$, $2); }
  ;

// ---- Camera ----

camera
  : CAMERA '{' camera_body '}' { $$ = $3; check(session, *$$, @1); $$->where = @1; }
  ;

camera_body
  : %empty                      { $$ = start_camera(session, session.builder.default_camera, @$); }
  | camera_body NAMED           { $$ = start_camera(session, *copy_of_named<CameraDefinition>($2), @2); }
  | camera_body CAMERA_KIND     { $$ = $1; set_kind(*$$, $2); }
  | camera_body PATTERN         { $$ = $1; set_kind_by_pattern(session, *$$, $2, @2); }
  | camera_body SHAPE number    { $$ = $1; set_kind(session, *$$, $2, $3, @2); }
  | camera_body modifier { $$ = $1; modify(session, *$$, $2); }
  | camera_body ANGLE           { $$ = $1; set_no_angle(session, *$$, @2); }
  | camera_body ANGLE quantity  { $$ = $1; set_angle(session, *$$, session.any_number($3, @3), @2); }
  | camera_body ANGLE quantity optional_comma number {
      $$ = $1;
      set_angles(session, *$$, session.number($3, @3), $5, @5);
    }
  | camera_body BLUR_SAMPLES number { $$ = $1; $$->blur_samples = $3; }
  | camera_body BLUR_SAMPLES number optional_comma number { $$ = $1; $$->blur_samples = $5; }
  ;

// ---- Objects ----

object
  : object_body '}'    { $$ = complete(session, $1, @1); }
  | light_body '}'     { $$ = located($1, @1); session.lights.pop_back(); }
  | light_group '}'    { $$ = located($1, @1); }
  | OBJECT_ID
  | UNSUPPORTED_OBJECT { $$ = unsupported_object(quoted(session, $1), @1); session.tokens.skip_group(); }
  | LIST_PATTERN       { $$ = unsupported_object(quoted_pattern($1), @1); session.tokens.skip_group(); } // cubic
  ;

shape_start
  : SHAPE '{'                { $$.number = $1; $$.where = @1; session.tokens.take_arguments($$.arguments); }
  ;

shape_head
  : shape_start ARGUMENTS    { $$ = $1; }
  | shape_start quantity     %prec SHORTER { $$ = $1; $$.arguments.push_back({$2, @2}); }
  | shape_head quantity      %prec SHORTER { $$ = $1; append_argument(session, $$, {$2, @2}); }
  | shape_head ',' quantity  %prec SHORTER { $$ = $1; append(session, $$.arguments, {$3, @3}, @3); }
  ;

shape_end // the comma belongs to what may be left out behind it
  : shape_head ',' %prec SHORTER {
      $$ = $1;
      $$.comma = @2;
      if (!has_option($$.number)) report_syntax_error(context(*this, yyla));
    }
  ;

csg_head
  : CSG '{' %prec SHORTER    { $$.operation = Csg::Operation($1); }
  | csg_head object          { $$ = $1; append(session, $$.parts, $2, @2); }
  ;

light_group_head
  : LIGHT_GROUP '{'          { $$.is_light_group = true; }
  | light_group_head object  { $$ = $1; append(session, $$.parts, $2, @2); }
  ;

light_group // which is no more than its parts: it has no texture and the like of its own
  : light_group_head           { $$ = csg(session, $1, @1); }
  | light_group transformation { $$ = $1; $$->apply($2); }
  | light_group item           { $$ = $1; apply(session, *$$, $2); }
  ;

// A name instead of what an object consists of stands for whatever object it is.
object_body
  : OBJECT '{' object            { $$ = copy_of(*$3); }
  | shape_start OBJECT_ID        { $$ = copy_of(*$2); }
  | CSG '{' OBJECT_ID            { $$ = copy_of(*$3); }
  | MESH '{' OBJECT_ID           { $$ = copy_of(*$3); }
  | MESH2 '{' OBJECT_ID          { $$ = copy_of(*$3); }
  | shape_head                   %prec SHORTER { $$ = shape(session, $1); }
  | shape_head OPEN              { $$ = open_shape(session, $1); }
  | shape_end                    { $$ = shape(session, $1); }
  | LOOKS_LIKE '{' object        { $$ = look(session, *$3, @1); } // modifiers may follow, as everywhere
  | PROJECTED_THROUGH '{' object { $$ = projector(session, *$3, @1); }
  | csg_head                     { $$ = csg(session, $1, @1); }
  | triangle_vertices            { $$ = lone_triangle(session, $1, @1); }
  | mesh_head                    { $$ = mesh(session, *$1, @1); }
  | mesh2_head                   { $$ = mesh2(session, *$1, @1); }
  | object_body modifier { $$ = $1; modify(session, *$$, $2); }
  | object_body texture          { $$ = $1; add_layer(session, *$$, $2, @2); }
  | object_body PIGMENT '{' { start_part(session, $1, @2); } pigment_body '}' { $$ = dressed(session, *$5); }
  | object_body NORMAL '{' { start_part(session, $1, @2); } normal_body '}' { $$ = dressed(session, $5); }
  | object_body FINISH '{' { start_part(session, $1, @2); } finish_body '}' { $$ = dressed(session, *$5); }
  | object_body INTERIOR '{' { start_interior(session, $1); } interior_body '}' { $$ = with_interior(session, $5); }
  | object_body material         { $$ = $1; apply(session, $2, *$$, @2); }
  | object_body INTERIOR_TEXTURE '{' texture_body '}' { $$ = $1; set_inside(session, *$$, $4, @2); }
  | object_body CLIPPED_BY '{' limits '}'     { $$ = $1; limit(session, *$$, $$->clipped_by, $4, @2); }
  | object_body CLIPPED_BY '{' BOUNDED_BY '}' { $$ = $1; limit(session, *$$, $$->clipped_by, $$->bounded_by, @2); }
  | object_body BOUNDED_BY '{' limits '}'     { $$ = $1; limit(session, *$$, $$->bounded_by, $4, @2); }
  | object_body BOUNDED_BY '{' CLIPPED_BY '}' { $$ = $1; limit(session, *$$, $$->bounded_by, $$->clipped_by, @2); }
  | object_body colour           %prec SHORTER { $$ = $1; ignore_colour(session, @2); }
  | object_body QUANTITY         { $$ = $1; ignore_colour_name(session, $2, @2); }
  | object_body photons          { $$ = $1; $$->is_photon_target = $2.is_target; }
  | object_body RADIOSITY        { $$ = $1; session.tokens.skip_group(); } // of radiosity
  ;

photons
  : PHOTONS '{' photon_items '}' { $$ = $3; }
  ;

photon_items
  : %empty            { }
  | photon_items ','  { $$ = $1; }
  | photon_items item { $$ = $1; apply(session, $$, $2); }
  ;

limits // of where an object is; they can be moved together
  : object                { $$.push_back({limiting(session, $1, @1), {}}); }
  | limits object         { $$ = $1; append(session, $$, {limiting(session, $2, @2), {}}, @2); }
  | limits transformation { $$ = $1; transform_limits($$, $2); }
  ;

light_body // what comes later applies to what is there by then
  : LIGHT_SOURCE '{' OBJECT_ID    { $$ = light(session, *$3, @3); }
  | LIGHT_SOURCE '{' quantity     { $$ = light(session, $3.vec3(), Vec3(0)); }
  | LIGHT_SOURCE '{' quantity optional_comma colour_value {
      $$ = light(session, $3.vec3(), session.light($5, @5).rgb);
    }
  | light_body SHAPE              { $$ = $1; set_kind(session, *$$, $2, @2); }
  | light_body modifier { $$ = $1; modify_light(session, *$$, $2); }
  | light_body object_body '}'    { $$ = $1; add_object(session, *$$, $2, @2); }
  | light_body AREA_LIGHT quantity optional_comma quantity optional_comma number optional_comma number {
      $$ = $1;
      set_area(session, *$$, session.vector($3, @3), session.vector($5, @5), {$7, $9}, @2);
    }
  | light_body photons            { $$ = $1; }
  ;

// ---- Meshes ----

triangle
  : plain_triangle '}'
  | plain_triangle texture '}'                           { $$ = $1; $$->textures.fill($2); }
  | plain_triangle TEXTURE_LIST '{' texture_list '}' '}' { $$ = $1; set_textures(session, *$$, $4, @2); }
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
  : TRIANGLE '{' quantity optional_comma quantity optional_comma quantity { $$ = flat_triangle($3, $5, $7); }
  | SMOOTH_TRIANGLE '{' quantity optional_comma quantity optional_comma quantity optional_comma
                        quantity optional_comma quantity optional_comma quantity {
      $$ = smooth_triangle({$3, $7, $11}, {$5, $9, $13});
    }
  ;

mesh_head
  : MESH '{'                         { $$ = std::make_shared<MeshBuilder>(); }
  | mesh_head triangle               { $$ = $1; add_triangle(session, *$$, *$2, @2); }
  | mesh_head INSIDE_VECTOR quantity { $$ = $1; $$->set_inside_vector(inside_vector(session, $3, @3)); }
  ;

mesh2_head
  : MESH2 '{'                         { $$ = std::make_shared<Mesh2Definition>(); }
  | mesh2_head LIST_ITEM counted_list { $$ = $1; apply(session, *$$, $2, $3, @3); }
  | mesh2_head TEXTURE_LIST '{' number texture_list '}' { $$ = $1; set_textures(session, *$$, $4, $5, @2); }
  | mesh2_head INSIDE_VECTOR quantity { $$ = $1; $$->inside_vector = inside_vector(session, $3, @3); }
  ;

texture_list
  : %empty                   { }
  | texture_list ','         { $$ = $1; }
  | texture_list texture     { $$ = $1; append(session, $$, $2, @2); }
  | texture_list TEXTURE_ID  { $$ = $1; append(session, $$, $2, @2); }
  ;

counted_list // the count comes first
  : '{' entries '}'      { $$ = $2; }
  | '{' entries ',' '}'  { $$ = $2; }
  ;

entries
  : literals quantity    %prec SHORTER { $$ = $1; append(session, $$, ListEntry($2), @2); }
  | entries quantity     %prec SHORTER { $$ = $1; append(session, $$, ListEntry($2), @2); }
  | entries ',' quantity %prec SHORTER { $$ = $1; append(session, $$, ListEntry($3), @3); }
  ;

literals // those in front that need no grammar
  : %empty               { session.tokens.take_literals($$); }
  ;

// ---- What names can stand for ----

declarable
  : quantity          %prec SHORTER { $$ = $1; }
  | colour            %prec SHORTER { $$ = $1; }
  | text              { $$ = $1; }
  | own_pigment       { $$ = PigmentPtr($1); }
  | own_normal        { $$ = NormalPtr($1); }
  | own_finish        { $$ = FinishPtr($1); }
  | COLOUR_MAP colour_map   { $$ = std::make_shared<const PigmentMap>($2); }
  | PIGMENT_MAP pigment_map { $$ = std::make_shared<const PigmentMap>($2); }
  | NORMAL_MAP normal_map   { $$ = std::make_shared<const NormalMap>($2); }
  | SLOPE_MAP slope_map     { $$ = std::make_shared<const std::vector<SlopePoint>>($2); }
  | TEXTURE_MAP texture_map { $$ = std::make_shared<const TextureMap>($2); }
  | sky_sphere        { $$ = SkySpherePtr($1); }
  | fog               { $$ = FogPtr($1); }
  | rainbow           { $$ = RainbowPtr($1); }
  | layers            %prec SHORTER { $$ = $1; }
  | TEXTURE_ID        { $$ = $1; }
  | PIGMENT_MAP_ID    { $$ = $1; }
  | NORMAL_MAP_ID     { $$ = $1; }
  | TEXTURE_MAP_ID    { $$ = $1; }
  | SLOPE_MAP_ID      { $$ = $1; }
  | NAMED
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
  | spline_head SPLINE_ID    { $$ = copy_of(*$2); }
  | spline_head SPLINE_KIND  { $$ = $1; $$->kind = Spline::Kind($2); }
  ;

dimensions
  : '[' number ']'            { $$.push_back(array_size(session, $2, @2)); }
  | dimensions '[' number ']' { $$ = $1; $$.push_back(array_size(session, $3, @3)); }
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

// ---- What is not supported: what belongs to it is passed over ----

unsupported
  : UNSUPPORTED          { $$ = unsupported_feature(session, quoted(session, $1), @1); }
  | UNSUPPORTED_ARGUMENT { $$ = unsupported_feature(session, quoted(session, $1), @1); }
  | UNSUPPORTED_BLOCK    { $$ = unsupported_block(session, $1, @1); session.tokens.skip_arguments(); }
  ;
