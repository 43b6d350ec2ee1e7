// Pictures and functions as pigments, patterns, normals and heights.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -7> look_at <0, 0.2, 0> angle 50 }
light_source { <5, 10, -10> rgb 1 }
plane { y, -1.2 pigment { checker rgb 0.8, rgb 0.4 } }

#declare f_torus = function { internal(70) }

box {
  -1, 1
  pigment { image_map { png "squares.png" interpolate 2 } translate -0.5 scale 2 }
  rotate <-20, 30, 0> scale 0.8 translate <-2.5, 1, 0>
}
sphere { 0, 1 pigment { image_map { png "squares.png" map_type 1 repeat <4, 2> } } translate <-0.2, 1.2, 0> }
cylinder {
  -y, y, 0.8
  pigment { image_map { png "squares.png" map_type 2 once interpolate 3 } scale <1, 2, 1> translate -0.999*y }
  translate <2.2, 1, 0>
}
torus {
  0.7, 0.3
  pigment { image_pattern { png "squares.png" map_type 5 interpolate 4 } color_map { [0 rgb x] [1 rgb <0, 1, 1>] } }
  rotate -50*x translate <-2.4, -0.7, -1.8>
}
#declare Wave = function (x, y, z, a) { a*sin(x*9)*cos(z*9) + select(y, 0.2, 0.4, 0.6) }
sphere {
  0, 0.8
  pigment { function { Wave(x, y, z, 0.5) + sum(i, 1, 3, abs(y*i))/9 } color_map { [0 rgb <0.1, 0.2, 0.6>] [1 rgb <1, 0.9, 0.6>] } }
  translate <-0.7, -0.4, -2.2>
}
box {
  -0.6, 0.6
  pigment { rgb <0.8, 0.6, 0.4> }
  normal { function { f_torus(x, y, z, 0.4, 0.1)*4 } 0.5 }
  finish { phong 0.4 }
  rotate <-30, 20, 0> translate <0.9, -0.4, -2.2>
}
height_field {
  function 20, 20 { 0.5 + 0.4*sin(x*12)*cos(y*9) } water_level 0.2
  pigment { rgb <0.5, 0.7, 0.5> }
  translate -0.5 scale <1.6, 0.5, 1.6> rotate -20*x translate <2.6, -0.5, -1.8>
}
