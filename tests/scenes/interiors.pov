// Interiors that fade and throw caustics, and objects that look different from inside, with their shadows.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 10 }
background { color rgb <0.3, 0.4, 0.6> }
camera { location <0, 3, -9> look_at <0, 0.9, 0> angle 50 }
light_source { <3, 10, -8> color rgb 1 }
light_source { <-8, 6, -3> color rgb 0.3 area_light x, y, 2, 2 }
plane { y, 0 pigment { checker color rgb 0.9 color rgb 0.65 } finish { reflection 0.1 } }
sphere {
  <0, 1.3, 0>, 1.3 pigment { color rgbf <1, 1, 1, 0.9> } finish { reflection { 0, 1 fresnel } conserve_energy }
  interior { ior 1.4 fade_distance 1 fade_power 1 fade_color <0.1, 0.5, 0.9> caustics 0.3 }
}
box {
  <-4, 0.02, -2>, <-2, 2, 0> pigment { color rgbt 0.9 } rotate 20*y
  interior { ior 1.1 fade_distance 0.7 fade_power 1001 fade_color <0.8, 0.3, 0.1> }
}
sphere { <-2.4, 0.7, -2.2>, 0.4 pigment { color rgb <0.9, 0.8, 0.1> } }
box { <3, 0.02, 2>, <5, 3, 3> pigment { color rgbt 1 } interior { fade_distance 2 fade_power 2 } }
cylinder {
  <3, 0.02, -1>, <3, 1.5, -1>, 0.8 open
  texture { pigment { color rgbt <1, 0.8, 0.6, 0.5> } finish { phong 0.6 } }
  interior_texture { pigment { checker color rgb <0.2, 0.8, 0.2> color rgb <0.1, 0.2, 0.9> scale 0.3 } normal { bumps 0.4 scale 0.1 } }
}
difference {
  sphere { <1.5, 0.72, -3>, 0.7 } box { <0, 0.9, -4>, <3, 2, -2> }
  texture { pigment { color rgb <0.9, 0.2, 0.2> } }
  interior_texture { pigment { color rgb <0.9, 0.9, 0.3> } finish { specular 0.5 } }
}
