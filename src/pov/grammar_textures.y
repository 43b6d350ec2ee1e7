// The grammar goes on: pigments, normals, finishes and textures, maps, and what is around the objects.

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
  | pigment_parts modifier { $$ = $1; modify(session, *$$, $2, @2); }
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
  | normal_parts modifier { $$ = $1; modify(session, *$$, $2, @2); }
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
  | pattern_function        { $$ = function_pattern(session, $1, @1); }
  | picture '}'             { $$ = picture_pattern(session, $1, @1); }
  ;

pattern_function
  : USER_FUNCTION { $$ = read_function(session, @1); }
  ;

picture
  : PICTURE '{'                            { $$.use = PictureUse($1); $$.where = @1; }
  | picture ','                            { $$ = $1; }
  | picture text                           { $$ = $1; $$.file = $2; $$.where = @2; }
  | picture item                           { $$ = $1; apply(session, $$, $2); }
  | picture GAMMA number                   { $$ = $1; set_gamma(session, $$, $3, @3); }
  | picture GAMMA SRGB                     { $$ = $1; $$.has_gamma = true; }
  | picture CHANNEL ALL number             { $$ = $1; set_of_all($$, is_filter($2), $4); }
  | picture CHANNEL number optional_comma number {
      $$ = $1;
      set_of_index(session, $$, is_filter($2), $3, $5, @2);
    }
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
  : finish_parts { $$ = $1; resolve_albedos(*$$); }
  ;

finish_parts
  : %empty                                  { $$ = std::make_shared<FinishDefinition>(session.base_texture->finish); }
  | finish_parts NAMED { $$ = copy_of_named<FinishDefinition>($2); }
  | finish_parts modifier { $$ = $1; modify(session, *$$, $2, @2); }
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

// Before version 3.0 the parts of pigment, normal and finish may stand in a texture without their braces.
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
  | old_texture_parts modifier { $$ = modified_old(session, $1, $2, @2); }
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
  | texture_parts modifier { $$ = modified(session, $1, $2, @2); }
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
  | sky_sphere_body modifier { $$ = $1; modify(session, *$$, $2, @2); }
  ;

fog
  : FOG '{' fog_body '}' { $$ = $3; settle(session, $$->value, @1); }
  ;

fog_body
  : %empty                   { $$ = std::make_shared<FogDefinition>(); }
  | fog_body NAMED { $$ = copy_of_named<FogDefinition>($2); }
  | fog_body colour_value    { $$ = $1; set_colour_or_distance(session, $$->value, $2, @2); }
  | fog_body repeated_colour %prec SHORTER { $$ = $1; set_colour_or_distance(session, $$->value, $2, @2); }
  | fog_body modifier { $$ = $1; modify(session, *$$, $2, @2); }
  ;

rainbow
  : RAINBOW '{' rainbow_body '}' { $$ = $3; check(session, $$->value, @1); }
  ;

rainbow_body
  : %empty                  { $$ = new_rainbow(); }
  | rainbow_body NAMED { $$ = copy_of_named<RainbowDefinition>($2); } // where POV-Ray 3.7 turns angles twice and forgets the colours
  | rainbow_body COLOUR_MAP colour_map { $$ = $1; set_colours($$->value, $3); }
  | rainbow_body modifier { $$ = $1; modify(session, *$$, $2, @2); }
  ;

interior
  : INTERIOR '{' { session.base_interior = nullptr; } interior_body '}' { $$ = copy_of($4); }
  ;

interior_body // changes what is there
  : %empty                    { if (session.base_interior) $$ = *session.base_interior; }
  | interior_body NAMED { $$ = *copy_of_named<InteriorDefinition>($2); }
  | interior_body modifier { $$ = $1; modify(session, $$, $2, @2); }
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
  | material_body modifier { $$ = $1; modify(session, $$, $2, @2); }
  ;
