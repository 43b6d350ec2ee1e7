// Meshes: smooth, flat, textures per face and per corner, instances, ellipsoids, no #version.
background { color rgb <0.4, 0.5, 0.7> }
camera { location <2, 5, -9> look_at <0, 0.3, 0> angle 42 right 4/3*x }
light_source { <6, 9, -7> color rgb 1 }
#declare Red = texture { pigment { color rgb <0.9, 0.2, 0.2> } finish { phong 0.5 } }
#declare Green = texture { pigment { color rgb <0.2, 0.8, 0.3> } }
#declare Blue = texture { pigment { color rgb <0.2, 0.3, 0.9> } finish { specular 0.6 } }
#declare Tent = mesh2 {
  vertex_vectors { 5, <-1, 0, -1>, <1, 0, -1>, <1, 0, 1>, <-1, 0, 1>, <0, 1.4, 0> }
  normal_vectors { 5, <-1, 0.6, -1>, <1, 0.6, -1>, <1, 0.6, 1>, <-1, 0.6, 1>, <0, 1, 0> }
  texture_list { 3, texture { Red }, texture { Green }, texture { Blue } }
  face_indices { 4, <0, 1, 4>, 0, 1, 2, <1, 2, 4>, 1, <2, 3, 4>, 2, <3, 0, 4>, 0, 0, 2 }
}
object { Tent }
object { Tent rotate y*35 scale <0.8, 1.4, 0.8> translate <2.6, 0, 1> }
mesh {
  smooth_triangle { <-4, 0, 0>, <-1, 1, -0.3>, <-2, 0, 0>, <1, 1, -0.3>, <-3, 2, 0.4>, <0, 1, -0.6> texture { Blue } }
  triangle { <-2, 0, 0>, <-2.4, 0, 2>, <-3, 2, 0.4> }
  texture { pigment { color rgb <0.9, 0.8, 0.3> } }
}
union {
  sphere { 0, 1 scale <1.3, 0.5, 0.7> rotate <20, 30, 40> }
  sphere { <0, 1, 0>, 0.4 texture { Green } }
  texture { Red }
  translate <-1.6, 0.6, -2.4>
}
triangle { <-20, -0.1, -20>, <20, -0.1, -20>, <20, -0.1, 20> pigment { color rgb 0.8 } }
triangle { <-20, -0.1, -20>, <20, -0.1, 20>, <-20, -0.1, 20> pigment { color rgb 0.8 } }
