// Meshes without an inside in CSG: which crossings POV-Ray finds, in mirrors too.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -7> look_at <0, 0.2, 0> angle 48 }
light_source { <5, 7, -9> rgb 1 }
plane { y, -1.5 pigment { rgb 0.6 } }
plane { z, 6 pigment { rgb 0.3 } finish { reflection 0.6 } }

#declare Tetrahedron = mesh2 {
  vertex_vectors { 4, <-1, -1, -1>, <1, -1, -1>, <0, -1, 1>, <0, 1, 0> }
  face_indices { 4, <0, 1, 2>, <0, 1, 3>, <1, 2, 3>, <2, 0, 3> }
}
#macro Ring_point(I, J)
  #local A = 2 * pi * I / 16;
  #local B = 2 * pi * J / 10;
  <(1.2 + 0.5 * cos(B)) * cos(A), 0.5 * sin(B), (1.2 + 0.5 * cos(B)) * sin(A)>
#end
#declare Ring = mesh {
  #for (I, 0, 15)
    #for (J, 0, 9)
      triangle { Ring_point(I, J), Ring_point(I + 1, J), Ring_point(I + 1, J + 1) }
      triangle { Ring_point(I, J), Ring_point(I + 1, J + 1), Ring_point(I, J + 1) }
    #end
  #end
}

intersection {
  object { Tetrahedron }
  plane { y, 0.1 }
  pigment { rgb <1, 1, 0> }
  rotate 25*y
  translate <-2.3, 0, -1>
}
difference {
  object { Ring rotate -50*x }
  box { <-2, -2, -2>, <0, 2, -0.2> }
  pigment { rgb <1, 0.8, 0.3> }
}
merge {
  object { Ring rotate 60*x scale <0.7, 0.8, 0.7> pigment { rgb <0.2, 0.8, 0.4> } }
  sphere { <0.5, 0.3, -0.4>, 0.5 pigment { rgb <0.2, 0.4, 1> } }
  translate <2.4, 0, 0>
}
intersection {
  union {
    object { Ring scale 0.6 pigment { rgb <1, 0.4, 0.2> } }
    sphere { 0, 0.25 pigment { rgb <0.9, 0.2, 0.5> } }
  }
  difference {
    box { -2, 2 }
    sphere { <0, 0, -0.9>, 0.5 }
  }
  rotate -40*x
  translate <0, -0.9, -2.4>
}
