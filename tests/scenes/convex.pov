// Convex solids of planes and boxes: clear and opaque, cut off in other colours, by slope, turned and in a union.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
background { rgb <0.2, 0.3, 0.5> }
camera { location <0, 4, -9> look_at <0, 0.6, 0> angle 45 }
light_source { <5, 10, -6> rgb 0.9 }
light_source { <-6, 8, -3> rgb 0.4 }

box { <-4, -1.2, -4>, <4, -1, 4> pigment { gradient x color_map { [0 rgb 1] [1 rgb 0.4] } scale 8 translate -4 } }

#declare Octahedron = intersection {
  #for (I, 0, 7)
    plane { <select(mod(I, 2), 1, -1, 1), select(mod(int(I/2), 2), 1, -1, 1), select(I - 3.5, 1, -1)>, 1 }
  #end
}
object {
  Octahedron
  pigment { rgbf <1, 0.9, 0.8, 0.9> } finish { reflection 0.1 specular 0.6 }
  interior { ior 1.5 fade_distance 1 fade_power 2 }
  rotate <10, 30, 5> translate <-2.2, 0.6, 0>
}
union {
  object { Octahedron pigment { rgbt <0.2, 0.9, 0.4, 0.6> } finish { phong 0.5 } rotate 20*y }
  object { Octahedron scale 0.4 pigment { rgb <0.9, 0.3, 0.2> } }
  translate <0, 0.6, 1>
}

#declare ByHeight = pigment { slope <1, 2, 0> color_map { [0 rgb x] [0.5 rgb y] [1 rgb z] } }
difference {
  box { -1, 1 }
  plane { <1, 1, -1>, -0.7 pigment { rgb x } finish { phong 1 } }
  plane { <-1, 1, -1>, -0.6 inverse pigment { rgbt <1, 0.5, 0.5, 0.8> } }
  pigment { rgbt <0.3, 0.3, 1, 0.7> } interior { ior 1.2 }
  rotate 25*y translate <2.2, 0.3, 0>
}
intersection {
  box { -0.5, 0.5 }
  box { -0.55, 0.55 rotate 45*y pigment { rgb <1, 0.8, 0> } }
  box { -0.5, 0.5 rotate 45*x pigment { wood scale 0.2 } }
  pigment { ByHeight }
  translate <0, -0.4, -2>
}
difference {
  box { -0.5, 0.5 }
  plane { <1, 1, 1>, -0.1 }
  pigment { ByHeight } normal { bumps 0.3 scale 0.1 } no_shadow
  translate <1.5, -0.4, -2>
}
intersection {
  plane { y, 0.5 }
  plane { -y, 0.5 }
  plane { x, 0.3 }
  box { <-0.4, -1, -0.6>, <1, 1, 1> }
  plane { z, 0.5 }
  pigment { ByHeight }
  rotate <10, 20, 30> translate <-1.5, -0.3, -2>
}
