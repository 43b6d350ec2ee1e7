// The grammar goes on: the camera, objects, light sources and meshes, and what names can stand for.

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
  | camera_body modifier { $$ = $1; modify(session, *$$, $2, @2); }
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
  ;

shape_start
  : SHAPE '{'                { $$.number = $1; $$.where = @1; session.tokens.take_arguments($$.arguments); }
  ;

swept_shape // `linear_spline` and the like stand in front of all arguments
  : shape_start SPLINE_KIND   { $$ = $1; set_curve(session, $$, Spline::Kind($2), @2); }
  | shape_start CURVE_WORD    { $$ = $1; set_curve(session, $$, CurveWord($2), @2); }
  | swept_shape SPLINE_KIND   { $$ = $1; set_curve(session, $$, Spline::Kind($2), @2); }
  | swept_shape CURVE_WORD    { $$ = $1; set_curve(session, $$, CurveWord($2), @2); }
  ;

shape_head
  : swept_shape quantity     %prec SHORTER { $$ = $1; $$.arguments.push_back({$2, @2}); }
  | shape_start ARGUMENTS    { $$ = $1; }
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

polynomial_start
  : LIST_PATTERN '{'         { $$ = degree_of_pattern(session, $1, @1); } // cubic
  | QUARTIC '{'              { $$ = 4; }
  ;

polynomial_head
  : polynomial_start
  | POLY '{' number optional_comma { $$ = $3; }
  ;

coefficients
  : component                  { $$.push_back($1); }
  | coefficients ',' component { $$ = $1; append(session, $$, $3, @3); }
  | coefficients component     { $$ = $1; append(session, $$, $2, @2); }
  ;

blob_head
  : BLOB '{'                        { }
  | blob_head ','                   { $$ = $1; }
  | blob_head THRESHOLD number      { $$ = $1; $$.blob.threshold = $3; }
  | blob_head blob_component '}'    { $$ = $1; add_component(session, $$, *$2, @2); }
  | blob_head BLOB_COMPONENT number optional_comma number optional_comma quantity %prec SHORTER {
      $$ = $1;
      add_component(session, $$, $3, $5, session.vector($7, @7), @2);
    }
  ;

blob_component
  : shape_head              %prec SHORTER { $$ = blob_component(session, $1); }
  | shape_head ','          %prec SHORTER { $$ = blob_component(session, $1); } // in front of `strength`
  | blob_component modifier { $$ = $1; modify(session, *$$, $2, @2); }
  | blob_component texture  { $$ = $1; add_layer(session, *$$, $2, @2); }
  | blob_component PIGMENT '{' { start_part(session, $1, @2); } pigment_body '}' { $$ = dressed(session, *$5); }
  | blob_component NORMAL '{' { start_part(session, $1, @2); } normal_body '}' { $$ = dressed(session, $5); }
  | blob_component FINISH '{' { start_part(session, $1, @2); } finish_body '}' { $$ = dressed(session, *$5); }
  ;

height_field_start
  : HEIGHT_FIELD '{'                  { }
  | height_field_start item           { $$ = $1; } // the kind of file
  ;

height_field_picture
  : height_field_start text           { $$.file = $2; $$.where = @2; }
  | height_field_picture GAMMA number { $$ = $1; }
  | height_field_picture GAMMA SRGB   { $$ = $1; }
  ;

function_body // behind its brace
  : %empty { $$ = read_function_body(session, @$); }
  ;

text_font
  : TEXT_OBJECT '{' TTF text             { $$ = $4; }
  | TEXT_OBJECT '{' UNDECLARED_ID number { $$ = internal_font($4); } // internal
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
  | BICUBIC_PATCH '{' OBJECT_ID  { $$ = copy_of(*$3); }
  | polynomial_start OBJECT_ID   { $$ = copy_of(*$2); }
  | POLY '{' OBJECT_ID           { $$ = copy_of(*$3); }
  | BLOB '{' OBJECT_ID           { $$ = copy_of(*$3); }
  | height_field_start OBJECT_ID { $$ = copy_of(*$2); }
  | height_field_picture         %prec SHORTER { $$ = height_field(session, height_field_of(session, $1), @1); }
  | HEIGHT_FIELD '{' USER_FUNCTION number optional_comma number '{' function_body {
      $$ = height_field(session, height_field_of(session, *$8, $4, $6, @3), @3);
    }
  | TEXT_OBJECT '{' OBJECT_ID    { $$ = copy_of(*$3); }
  | text_font optional_comma text optional_comma number optional_comma quantity %prec SHORTER {
      $$ = text_object(session, {$1, $3, $5, session.vector($7, @7)}, @1);
    }
  | polynomial_head '<' coefficients optional_comma '>' { $$ = polynomial(session, $1, $3, @1); }
  | blob_head                    %prec SHORTER { $$ = blob(session, $1, @1); }
  | shape_head                   %prec SHORTER { $$ = shape(session, $1); }
  | shape_head OPEN              { $$ = open_shape(session, $1); }
  | shape_end                    { $$ = shape(session, $1); }
  | LOOKS_LIKE '{' object        { $$ = look(session, *$3, @1); } // modifiers may follow, as everywhere
  | PROJECTED_THROUGH '{' object { $$ = projector(session, *$3, @1); }
  | csg_head                     { $$ = csg(session, $1, @1); }
  | triangle_vertices            { $$ = lone_triangle(session, $1, @1); }
  | mesh_head                    { $$ = mesh(session, *$1, @1); }
  | mesh2_head                   { $$ = mesh2(session, *$1, @1); }
  | patch_values                 %prec SHORTER { $$ = patch(session, *$1, @1); }
  | object_body modifier { $$ = $1; modify(session, *$$, $2, @2); }
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
  | light_body modifier { $$ = $1; modify_light(session, *$$, $2, @2); }
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

patch_head
  : BICUBIC_PATCH '{' { $$ = std::make_shared<PatchDefinition>(); }
  | patch_head item   { $$ = $1; apply(session, *$$, $2); }
  | patch_head ','    { $$ = $1; }
  | patch_head UV_VECTORS quantity optional_comma quantity optional_comma quantity optional_comma quantity %prec SHORTER {
      $$ = $1;
      set_coordinates(session, *$$, {$3.vec3(), $5.vec3(), $7.vec3(), $9.vec3()}, @2);
    }
  ;

patch_values // options of the old form, and control points
  : patch_head quantity       %prec SHORTER { $$ = $1; add_value(session, *$$, $2, @2); }
  | patch_values quantity     %prec SHORTER { $$ = $1; add_value(session, *$$, $2, @2); }
  | patch_values ',' quantity %prec SHORTER { $$ = $1; add_value(session, *$$, $3, @3); }
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
  | unsupported MISPLACED number { $$ = $1; } // an option that means something elsewhere: `interpolate`
  ;
