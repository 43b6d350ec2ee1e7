// The grammar of the POV-Ray scene language. Values are computed while they are read; TokenStream has
// already executed the directives. The grammar can be entered for a whole scene or for one value (see Start):
// entered for a value, it finishes as soon as the value is complete, whatever follows, because every state
// that could end a value reduces by default. Actions that read from the token stream themselves
// (take_literals, take_arguments, take_name, skip_group, skip_arguments) belong to rules that are reduced without
// looking ahead. What a word in a block says with the values behind it is an item, a row of a table (items.hpp).
//
// This file has the symbols, the scene, expressions, colours, items and transformations. The rules go on in
// grammar_textures.y and grammar_objects.y: bison reads all three as one (join_grammar.cmake).

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
// A name that a CSG, a texture or a spline begins with is all that it consists of. Layers go on as long as
// textures follow, a slope as long as numbers do, and a brace behind an array's dimensions has its elements.
%expect 13

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
%token ARGUMENTS // a shape's arguments that have been read already

// The forms of items; MISPLACED: what has no meaning where it stands.
%token <int> WORD_ITEM VALUE_ITEM OPTION_ITEM PAIR_ITEM SHARE_ITEM COLOUR_ITEM COLOUR_OR_BLACK_ITEM LIST_ITEM
%token MISPLACED

%token <int> SPLINE_KIND FUNCTION TEXT_FUNCTION COMPONENT COLOUR_MODEL SRGB_MODEL CHANNEL SHAPE CSG CAMERA_KIND
%token <int> CURVE_WORD PATTERN PICTURE ARGUED_PATTERN LIST_PATTERN
%token <NameId> UNSUPPORTED UNSUPPORTED_ARGUMENT UNSUPPORTED_OBJECT UNSUPPORTED_BLOCK
%token BAD_CHARACTER DEFINED CONSTANT READ_APART
%token LESS_EQUAL GREATER_EQUAL NOT_EQUAL
%token OLD_PLUS OLD_MINUS // signs of a new value: before version 1.5 they do not join two values

%token ALBEDO ALL ALTITUDE ANGLE AREA_LIGHT ARRAY ASSUMED_GAMMA BACKGROUND BICUBIC_PATCH BLOB BLOB_COMPONENT BLUR_SAMPLES BOUNDED_BY CAMERA CHARSET CLIPPED_BY
%token COLOUR COLOUR_MAP DIFFUSE DIMENSIONS DIMENSION_SIZE FINISH FOG GAMMA GLOBAL_SETTINGS HEIGHT_FIELD INSIDE INSIDE_VECTOR INTERIOR
%token INTERIOR_TEXTURE INVERSE IRID JULIA LIGHT_GROUP LIGHT_SOURCE LOOKS_LIKE MAGNET MATERIAL MATRIX MAX_EXTENT MESH MESH2
%token MIN_EXTENT NORMAL NORMAL_MAP OBJECT OPEN PHOTONS PIGMENT PIGMENT_MAP PIGMENT_PATTERN POLY PROJECTED_THROUGH QUARTIC RADIOSITY
%token OLD_TEXTURE // before version 3.0
%token RAINBOW REFLECTION ROTATE SCALE SKY_SPHERE SLOPE SLOPE_MAP SMOOTH_TRIANGLE SPLINE SRGB TEXTURE TEXTURE_LIST
%token TEXT_OBJECT TEXTURE_MAP THRESHOLD TILE2 TILES TRACE TTF TRANSFORM TRANSLATE TRIANGLE USER_FUNCTION UV_MAPPING UV_VECTORS WARP

// Commas are optional, and so are some values. After a value both an operator and a sign, a colour's channel or
// another value can follow: the longer value is meant. What may be a value that is optional is that one: a number
// at the front of a map's entry is its position, and one behind an object's modifier no colour's name.
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
%nterm <std::string> text text_font
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
%nterm <FunctionPtr> function_body pattern_function
%nterm <WrittenPicture> picture height_field_start height_field_picture
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
%nterm <WrittenShape> shape_start swept_shape shape_head shape_end
%nterm <double> polynomial_start polynomial_head
%nterm <std::vector<double>> coefficients
%nterm <WrittenBlob> blob_head
%nterm <std::shared_ptr<ObjectDefinition>> blob_component
%nterm <Compound> csg_head light_group_head
%nterm <std::vector<Limit>> limits
%nterm <std::shared_ptr<MeshBuilder>> mesh_head
%nterm <std::shared_ptr<Mesh2Definition>> mesh2_head
%nterm <std::shared_ptr<PatchDefinition>> patch_head patch_values
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
  | settings modifier { modify_settings(session, $2, @2); }
  | settings ASSUMED_GAMMA number { set_assumed_gamma(session, $3, @3); }
  | settings ASSUMED_GAMMA SRGB   { set_assumed_gamma(session, std::nullopt, @2); }
  | settings CHARSET UNSUPPORTED_ARGUMENT { session.reads_utf8 = session.names.text($3) == "utf8"; }
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

// Comparisons and logical operators exist inside parentheses only: elsewhere < and > enclose vectors.
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

colour // with a keyword, unlike a number
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

repeated_colour // a fog's colour: POV-Ray accepts the keyword more than once
  : COLOUR named_colour            { $$ = $2; }
  | COLOUR repeated_colour         %prec SHORTER { $$ = $2; }
  | repeated_colour CHANNEL number { $$ = with_channel($1, Channel($2), $3); }
  ;

srgb_model
  : SRGB       { $$ = ColourModel::rgb; }
  | SRGB_MODEL { $$ = ColourModel($1); }
  ;

// Behind a colour's keyword POV-Ray accepts a whole expression, which needs parentheses elsewhere.
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
  | PAIR_ITEM quantity optional_comma quantity %prec SHORTER { $$ = item($1, @1, {$2, @2}, {$4, @4}); }
  | SHARE_ITEM albedo quantity           %prec SHORTER { $$ = item($1, @1, $3, @3); $$.is_albedo = $2; }
  | COLOUR_ITEM colour_value             { $$ = item($1, @1, $2, @2); }
  | COLOUR_OR_BLACK_ITEM colour_or_black { $$ = item($1, @1, $2, @2); }
  ;

modifier
  : item           { $$ = $1; }
  | warp           { $$ = $1; }
  | transformation { $$ = $1; }
  | unsupported    { $$ = $1; }
  ;

albedo // makes the number the share of light that is scattered in all directions together
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
