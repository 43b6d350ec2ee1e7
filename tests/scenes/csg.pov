// Constructive solid geometry: what cuts colours what it cuts, inside out, clipped, infinite, in glass.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
background { color rgb <0.45, 0.5, 0.6> }
camera { location <0, 7, -12> look_at <0.2, 0.6, 0.4> angle 48 }
light_source { <-6, 11, -9> color rgb 1 }
light_source { <8, 6, -5> color rgb <0.3, 0.3, 0.25> shadowless }
#declare Red = texture { pigment { color rgb <0.9, 0.25, 0.2> } finish { phong 0.5 } }
#declare Gold = texture { pigment { color rgb <0.9, 0.7, 0.2> } finish { specular 0.5 metallic } }
#declare Blue = texture { pigment { color rgb <0.25, 0.4, 0.9> } finish { phong 0.4 reflection 0.15 } }
#declare Clear = texture {
  pigment { color rgbf <0.75, 0.95, 0.85, 0.8> }
  finish { diffuse 0.3 specular 0.5 }
}

plane { y, 0 pigment { color rgb <0.75, 0.72, 0.68> } }

// A die: the balls that cut it have their own colour, the cylinder takes the die's.
#declare Die = difference {
  intersection { box { -1, 1 } sphere { 0, 1.45 texture { Gold } } }
  sphere { <0, 0, -1.1>, 0.5 texture { Blue } }
  sphere { <0, 1.1, 0>, 0.45 texture { Gold } }
  union {
    cylinder { -2*x, 2*x, 0.35 }
    cylinder { <-2, 0.6, -0.6>, <2, 0.6, -0.6>, 0.12 }
  }
  texture { Red }
}
object { Die rotate y*35 translate <-4.4, 1, 0.5> }
object { Die scale <0.6, 0.8, 0.6> rotate <0, -20, 90> translate <-2.2, 0.62, -2.6> }

// Four levels deep, and a plane that cuts all of it.
intersection {
  merge {
    difference {
      sphere { 0, 1.2 }
      union { box { <-2, -0.25, -2>, <2, 0.25, 2> } cylinder { -2*z, 2*z, 0.4 } }
    }
    torus { 1, 0.22 texture { Gold } }
  }
  plane { <0.6, 0.8, -0.5>, 0.45 texture { Blue } }
  texture { Red }
  rotate y*20
  translate <-1.2, 1.2, 1.2>
}

// Open: only part of a surface, with its inside to be seen.
sphere {
  0, 1.1
  clipped_by { plane { y, 0.4 } cylinder { -2*z, 2*z, 0.3 inverse } }
  texture { Gold }
  rotate <-20, 0, -25>
  translate <1.9, 1.1, -1.2>
}
union {
  sphere { <-0.5, 0, 0>, 0.6 }
  cylinder { <-0.5, 0, 0>, <0.9, 0, 0>, 0.3 texture { Blue } }
  clipped_by { box { <-2, -1, -0.1>, <2, 1, 1> rotate y*-30 } }
  bounded_by { clipped_by }
  texture { Red }
  translate <1.2, 0.7, 2.8>
}

// In glass a union shows the surfaces inside that a merge leaves out.
#declare Balls = array[3] {
  sphere { <-0.4, 0, 0>, 0.7 }
  sphere { <0.4, 0, 0>, 0.7 }
  box { <-0.3, -0.3, -1>, <0.3, 0.3, 1> }
}
union {
  object { Balls[0] } object { Balls[1] } object { Balls[2] }
  texture { Clear }
  translate <4.8, 0.75, 3.4>
}
merge {
  object { Balls[0] } object { Balls[1] } object { Balls[2] }
  texture { Clear }
  translate <5, 0.75, 0.6>
}
difference {
  sphere { 0, 0.8 }
  sphere { 0, 0.6 }
  plane { -y, 0 translate y*0.2 }
  texture { Clear }
  interior { ior 1.3 }
  rotate <-20, 0, 15>
  translate <0.1, 0.8, -3.2>
}

// An inverse object keeps what is outside of it.
intersection {
  box { -0.7, 0.7 }
  sphere { 0, 0.85 inverse texture { Gold } }
  texture { Blue }
  rotate <10, 50, 0>
  translate <3.4, 0.9, -2.6>
}
