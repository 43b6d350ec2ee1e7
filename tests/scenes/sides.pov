// Which side of a triangle an interior_texture is on: of meshes by the order of the corners, also of mirror images
// and of many copies; of triangles that stand alone by where they face or their normals point.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -12> look_at <0, 0.3, 0> angle 46 }
background { rgb <0.1, 0.15, 0.3> }
light_source { <-8, 14, -12> rgb 1 }

#declare Outside = texture { pigment { rgb <0.9, 0.5, 0.2> } }
#declare Inside = texture { pigment { checker rgb <0.2, 0.5, 0.9> rgb 0.9 scale 0.2 } finish { reflection 0.2 } }
#declare Strip = mesh {
  triangle { <-0.8, -0.8, 0>, <0.8, -0.8, 0.2>, <-0.8, 0.8, 0.3> }
  triangle { <0.8, -0.8, 0.2>, <0.9, 0.7, -0.2>, <-0.8, 0.8, 0.3> }
  smooth_triangle { <-0.8, 0.8, 0.3>, <0, 0.5, -1>, <0.1, 1.2, 0.6>, <0, 0.5, -1>, <0.9, 0.7, -0.2>, <0.2, 0.4, -1> }
}
#macro Sides() texture { Outside } interior_texture { Inside } #end

object { Strip Sides() translate <-4, 2, 0> }
object { Strip Sides() scale <-1, 1, 1> rotate 20*y translate <-2, 2, 0> }
#for (I, 0, 3)
  object { Strip Sides() rotate 90*I*y scale 0.6 translate <-0.2 + 1.4*I, 2.2, 0> }
#end
object { Strip Sides() scale <0.6, -0.6, 0.6> translate <-4, 0, 0> }
mesh2 {
  vertex_vectors { 4, <-1, -1, 0>, <1, -1, 0>, <-1, 1, 0>, <1, 1, 0.5> }
  face_indices { 2, <0, 1, 2>, <1, 2, 3> }
  Sides() scale 0.7 translate <-2.4, 0, 0>
}
// Faces with textures of their own look the same from inside, also those with three.
#declare Patchwork = mesh2 {
  vertex_vectors { 5, <-1, -1, 0>, <0, -1, -0.5>, <1, -1, 0>, <-0.6, 1, 0.2>, <0.6, 1, 0.2> }
  texture_list { 3, texture { pigment { rgb <0.9, 0.1, 0.1> } }, texture { pigment { rgb <0.1, 0.9, 0.1> } }, texture { pigment { rgb <0.9, 0.9, 0.1> } } }
  face_indices { 3, <0, 3, 1>, 0, 1, 2, <1, 2, 4>, 0, 1, 2, <1, 3, 4>, 1 }
}
object { Patchwork Sides() scale 0.45 translate <0, 3.2, 0> }
object { Patchwork Sides() scale 0.45 rotate 180*y translate <1.2, 3.2, 0> }
mesh { // closed, in CSG
  #local A = <0, 1, 0>; #local B = <-0.9, -0.6, -0.6>; #local C = <0.9, -0.6, -0.6>; #local D = <0, -0.6, 0.9>;
  triangle { A, B, C } triangle { A, C, D } triangle { A, D, B } triangle { B, C, D }
  inside_vector y
  Sides() clipped_by { plane { -z, 0.2 } } rotate 150*y translate <-0.4, 0, 0>
}
triangle { <0.6, -0.6, 0>, <1.4, -0.4, 0>, <1, 0.6, 0> Sides() }
triangle { <1.5, -0.6, 0>, <2.1, -0.4, 0>, <1.7, 0.6, 0> Sides() rotate 8*x }
triangle { <2.2, -0.6, 0>, <2.3, 0.4, 0>, <2.6, -0.6, 2.2> Sides() }
triangle { <3, -0.6, 0>, <3.1, 0.4, 0>, <3, -0.6, 2.2> Sides() }
triangle { <0.4, -1.4, 0>, <1.4, -1.5, 0>, <1, -1, 2> Sides() }
triangle { <1.5, -1.5, 0>, <2.4, -1.4, 0>, <1.9, -1, 2> Sides() }
smooth_triangle { <3.4, -0.6, 0>, <0.2, 0.2, -1>, <4.2, -0.4, 0>, <0.1, 0, -1>, <3.8, 0.6, 0>, <0, -0.2, -1> Sides() }
smooth_triangle { <4.3, -0.6, 0>, <0.2, 0.2, 1>, <5, -0.4, 0>, <0.1, 0, 1>, <4.6, 0.6, 0>, <0, -0.2, 1> Sides() }
polygon { 5, <0, 0>, <0.8, 0>, <1, 0.8>, <0.2, 0.6>, <0, 0> Sides() translate <2.8, -1.7, 0> }
disc { <4.6, -1.2, 0>, <0.2, 0.4, -1>, 0.5 Sides() }
// POV-Ray turns an inverse quadric round twice: its hollow shows the inside's texture, that of a sphere does not.
difference { sphere { 0, 0.8 } quadric { <1, 1, 1>, 0, 0, -0.3 translate <0.2, 0.5, -0.6> } Sides() translate <-3.2, -1.8, 0> }
difference { sphere { 0, 0.8 } sphere { <0.2, 0.5, -0.6>, 0.55 } Sides() translate <-1.4, -1.8, 0> }
quadric { <1, 1, 1>, 0, 0, -0.2 inverse clipped_by { box { -1, 1 } } Sides() translate <0, -2, 0> }
