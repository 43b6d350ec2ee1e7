// Faces that CSG cuts look like what they are cut from.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 5, -7> look_at <0, -0.2, 0> angle 42 }
light_source { <3, 8, -6> rgb 1 }
background { rgb 0.3 }
#default { finish { ambient 0.3 } }
#declare Red = texture { pigment { rgb <1, 0.2, 0.2> } }
#declare Green = texture { pigment { rgb <0.2, 1, 0.2> } finish { phong 0.6 } }
#declare Stripes = texture { pigment { gradient <1, 0.3, 0.2> triangle_wave color_map { [0.4 rgb <1, 1, 0>] [0.6 rgb <0, 1, 1>] } scale 0.37 } }

// one texture, moved with the whole
difference {
  sphere { 0, 1 texture { Stripes } }
  box { <0.03, 0.02, -2>, 2 }
  union { sphere { <-0.8, 0.1, -0.6>, 0.3 texture { Green } } sphere { <0.1, -0.6, -0.8>, 0.3 } }
  cutaway_textures
  rotate y * 20
  translate <-2, 0, 1.2>
}
// several, which overlap; what has none has the default one
difference {
  union {
    sphere { -x * 0.5, 0.9 texture { Red } }
    sphere { x * 0.5, 0.9 texture { Green } }
    sphere { <0, 0, 0.9>, 0.5 }
  }
  box { <-2, 0.1, -2>, <2, 2, 0.05> }
  cutaway_textures
  translate <1.4, 0, 1.2>
}
// all of them
intersection {
  sphere { 0, 0.9 texture { Red } }
  box { -0.7, 0.7 texture { Stripes translate x * 0.1 } }
  plane { <1, 1, -1>, 0.6 }
  cutaway_textures
  translate <-1.6, 0, -1.6>
}
// none: only what is taken away has one
difference {
  box { -0.7, 0.7 }
  sphere { <0.2, 0.7, -0.5>, 0.5 texture { Green } }
  cutaway_textures
  rotate y * 25
  translate <0.3, 0, -1.7>
}
// its own one
difference {
  sphere { 0, 0.8 texture { Red } }
  box { <0, 0.02, -2>, 2 }
  cutaway_textures
  texture { Green }
  translate <2.2, 0, -1.5>
}
