// Patterns that have no other scene: as pigments, as normals, moved and in waves.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 4.5, -9> look_at <0, 0.9, 0> angle 45 right x*4/3 }
light_source { <-15, 25, -20> rgb <1, 0.95, 0.9> }
background { rgb <0.2, 0.3, 0.45> }

#declare Colours = color_map { [0 rgb <0.9, 0.85, 0.7>] [0.4 rgb <0.8, 0.3, 0.15>] [0.75 rgb <0.15, 0.3, 0.5>] [1 rgb <0.9, 0.85, 0.7>] }

#macro Row(Z, Pigment, Normal)
  box { -0.8, 0.8 rotate 25*y translate <-2, 0.8, Z> texture { pigment { Pigment color_map { Colours } } finish { diffuse 0.8 } } }
  sphere { <0, 0.9, Z>, 0.9 texture { pigment { Pigment color_map { Colours } triangle_wave frequency 2 phase 0.3 turbulence 0.2 } finish { phong 0.5 } } }
  sphere { <2, 0.9, Z>, 0.9 texture { pigment { rgb <0.7, 0.75, 0.7> } normal { Normal scale 0.5 } finish { phong 0.6 } } }
#end

plane { y, 0 texture { pigment { onion color_map { [0 rgb <0.5, 0.55, 0.5>] [1 rgb <0.75, 0.7, 0.6>] } scale 0.7 translate <0.3, 0, 1> } } }
Row(0, pigment { onion scale 0.4 rotate 20*x translate <0.2, 0.1, -0.3> }, normal { onion 2.5 sine_wave })
