// Orthographic camera, gamma 2.2, old opacity rule, attenuated and transmitted light.
#version 3.6;
global_settings { assumed_gamma 2.2 }
background { color rgb <0.5, 0.25, 0.75> }
camera { orthographic location <3, 4, -8> look_at <0, 0, 0> angle 40 }
light_source { <4, 8, -6> color rgb <1, 1, 0.9> }
sphere { <-1.5, 0, 0>, 1 pigment { color rgbf <0.9, 0.4, 0.3, 0.5> } finish { phong 0.6 } }
sphere { <1.5, 0, 0>, 1 pigment { color rgbt <0.3, 0.7, 0.9, 0.4> } finish { reflection 0.3 } }
sphere { <0, 0, 2.5>, 1.2 pigment { color rgb <0.9, 0.9, 0.3> } no_shadow }
triangle { <-9, -1.2, -9>, <9, -1.2, -9>, <0, -1.2, 12> pigment { color rgb <0.7, 0.7, 0.6> } }
