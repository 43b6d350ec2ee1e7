// Fogs: everywhere and on the ground, turbulent, tinting and never quite opaque; not inside of solid objects.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
background { color rgb <0.1, 0.2, 0.5> }
camera { location <0, 2.2, -10> look_at <0, 1, 0> angle 55 }
light_source { <10, 20, -10> color rgb 1 }
fog { distance 45 color rgbft <0.8, 0.7, 0.6, 0.3, 0.2> }
fog {
  fog_type 2 distance 6 fog_offset 0.3 fog_alt 0.4 up <0.1, 1, 0> color rgbf <0.7, 0.8, 0.9, 0.4>
  turbulence <0.5, 1, 0.7> turb_depth 0.6 omega 0.6 lambda 2.5 octaves 4
}
plane { y, 0 pigment { checker color rgb 1 color rgb 0.4 } }
sphere { <0, 1, 0>, 1 pigment { color rgb <1, 0.3, 0.2> } finish { reflection 0.4 } }
sphere { <4, 1, 10>, 1 pigment { color rgb <1, 0.3, 0.2> } }
sphere { <-4, 2, 25>, 2 pigment { color rgb <0.2, 0.9, 0.2> } }
#declare Glass = pigment { color rgbf <0.9, 1, 0.9, 0.9> }
box { <-3, 0.02, -1>, <-2, 2, 1> pigment { Glass } interior { ior 1.3 } }
box { <2, 0.02, -1>, <3, 2, 1> pigment { Glass } interior { ior 1.3 } hollow }
sphere { <1.5, 0.52, -3>, 0.5 pigment { Glass } interior { ior 1.1 } }
sphere { 0, 200 pigment { gradient y color_map { [0.5 color rgb <0.5, 0.6, 0.9>] [1 color rgb <0.1, 0.2, 0.6>] } scale 400 translate -200*y } finish { ambient 1 diffuse 0 } hollow }
