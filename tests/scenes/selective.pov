// Objects that only mirrors show, or that no mirror shows; films on surfaces.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
background { color rgb <0.2, 0.3, 0.6> }
camera { location <0, 2.5, -9> look_at <0, 1, 0> angle 55 }
light_source { <3, 10, -10> color rgb 1 }
light_source { <-6, 5, -6> color rgb <0.3, 0.35, 0.4> }
plane { y, 0 pigment { checker color rgb 1 color rgb 0.5 } finish { reflection 0.5 } }
sphere { <-2, 1, 0>, 1 pigment { color rgb <1, 0.2, 0.2> } no_reflection }
sphere { <0, 1, 0>, 1 pigment { color rgb <0.2, 1, 0.2> } no_image }
sphere { <2, 1, 0>, 1 pigment { color rgbt 0.9 } interior { ior 1.5 } finish { reflection 0.1 } }
difference {
  cylinder { <3.2, 0, 3>, <3.2, 4, 3>, 0.5 } plane { -z, -3 }
  pigment { color rgb <1, 0, 1> } no_reflection
}
cylinder { <1.6, 0, 3>, <1.6, 4, 3>, 0.3 pigment { color rgb <0, 1, 1> } no_image }
triangle { <-5, 0, 4>, <-1, 0, 4>, <-3, 4, 4> pigment { color rgb <0.9, 0.8, 0.2> } no_image }
triangle { <-6, 0, 5>, <-2, 0, 5>, <-4, 4, 5> pigment { color rgb <0.5, 0.3, 0.7> } no_reflection }
sphere { <-1, 0.6, -2.5>, 0.6 pigment { color rgb <0.6, 0.6, 0.7> } finish { diffuse 0.5 specular 0.5 roughness 0.05 irid { 0.4 thickness 0.9 turbulence 0.3 } } }
sphere { <0.8, 0.6, -2.8>, 0.6 pigment { gradient y color_map { [0 color rgb 0.4] [1 color rgb 0.9] } scale 0.3 } finish { reflection { 0.4 exponent 1.4 } irid { 0.35 thickness 0.5 } } }
intersection {
  sphere { <3.2, 0.6, -2.5>, 0.6 no_image no_shadow } box { <2.6, 0, -3>, <3.7, 1, -2> no_reflection }
  pigment { color rgb <0.9, 0.5, 0.1> }
}
// What parts say of it counts in unions and, in part, in merges.
merge {
  sphere { 0, 0.4 no_image } sphere { <0.9, 0, 0>, 0.4 no_reflection }
  sphere { <0.5, 0.9, 0>, 0.4 no_shadow } sphere { <0.9, 1.1, 0>, 0.4 }
  pigment { color rgb <0.3, 0.8, 0.6> } translate <-4.2, 0.5, 0.5>
}
intersection {
  union { box { <0, 0, 0>, <0.8, 1.2, 0.8> no_image } box { <0.4, 0.2, -0.2>, <1.2, 0.9, 0.6> no_reflection no_shadow } }
  box { <0.1, -1, -2>, <1.1, 2, 2> }
  pigment { color rgb <0.8, 0.7, 0.2> } translate <3.5, 0, 0>
}
union {
  box { <0, 0, 0>, <0.8, 1.2, 0.8> } box { <0.4, 0.2, -0.2>, <1.2, 0.9, 0.6> no_reflection }
  clipped_by { plane { x, 1 } }
  pigment { color rgb <0.3, 0.4, 0.9> } translate <4.6, 0, 3>
}
// What is mirrored within glass is mirrored, too.
intersection {
  box { -0.5, 0.5 rotate 45*y scale <1, 2.4, 1> } plane { z, 0 }
  pigment { color rgbt 0.9 } interior { ior 1.6 } translate <0.3, 1.4, 3>
}
// Parts of a merge that a ray does not see hide nothing from it.
merge {
  box { <0, 0, 0>, <0.8, 0.7, 0.6> no_image }
  sphere { <0.8, 0.6, 0>, 0.45 }
  intersection { sphere { <0.3, 0.7, -0.1>, 0.5 } box { -1, 0.95 } no_reflection }
  merge { cylinder { <0.3, 0.2, 0>, <1.4, 0.2, 0.2>, 0.2 } sphere { <1.3, 0.3, 0.1>, 0.3 no_image } no_reflection }
  pigment { color rgbt <0.9, 0.6, 0.2, 0.3> } translate <-3.8, 0, -2.2>
}
// What is subtracted becomes a merge if it is an intersection or a difference: then what it says itself counts.
difference {
  sphere { 0, 0.8 }
  intersection { box { <-0.3, -0.2, -1>, <0.5, 0.5, 0.1> } sphere { -0.3*z, 0.7 } no_image }
  merge { box { <-0.6, -0.1, -1>, <-0.4, 0.4, 0.1> } sphere { -0.8*y, 0.2 } no_image }
  pigment { color rgb <0.5, 0.9, 0.3> } translate <0.2, 2.9, 2>
}
