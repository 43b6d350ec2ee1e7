// Rainbows that share a part of the sky, an arc that fades, filtering and clear colours, in front of near and far things,
// in a mirror, through glass, behind fog.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 6 }
camera { location <0, 4, -25> look_at <0, 7, 0> angle 75 }
light_source { <100, 200, -400> rgb 1 }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.7, 0.75, 0.85>] [1 rgb <0.2, 0.3, 0.6>] } } }
fog { distance 400 rgbt <0.7, 0.75, 0.8, 0.5> }

#declare Colours = color_map {
  [0.000 rgbf <1.0, 0.5, 1.0, 1.0>]
  [0.100 rgbf <1.0, 0.5, 1.0, 0.8>]
  [0.214 rgbf <0.5, 0.5, 1.0, 0.8>]
  [0.328 rgbft <0.2, 0.2, 1.0, 0.8, 0.1>]
  [0.442 rgbft <0.2, 1.0, 1.0, 0.8, 0.1>]
  [0.556 rgbft <0.2, 1.0, 0.2, 0.8, 0.2>]
  [0.670 rgbft <1.0, 1.0, 0.2, 0.8, 0.2>]
  [0.784 rgbf <1.0, 0.5, 0.2, 0.8>]
  [0.900 rgbf <1.0, 0.2, 0.2, 0.8>]
}
rainbow { direction <-0.1, -0.15, 1> angle 24 width 6 distance 60 color_map { Colours } }
rainbow {
  direction <-0.1, -0.15, 1> angle 28 width 6 distance 60 color_map { Colours }
  arc_angle 150 falloff_angle 70 up <0.3, 1, 0>
}
rainbow { direction <0.2, 0, -1> angle 30 width 12 distance 100 color_map { Colours } }

plane { y, 0 pigment { checker rgb <0.3, 0.5, 0.2> rgb <0.4, 0.6, 0.3> scale 6 } hollow }
sphere { <-9, 6, 4>, 5 pigment { rgb 0.2 } finish { diffuse 0.3 reflection 0.7 } }
sphere { <7, 5, -4>, 3 pigment { rgbf <0.9, 1, 0.95, 0.9> } interior { ior 1.3 } hollow }
box { <2, 0, 20>, <14, 16, 28> pigment { rgb <0.8, 0.6, 0.5> } }
cylinder { <-2, 0, -12>, <-2, 5, -12>, 0.4 pigment { rgb <0.5, 0.4, 0.3> } }
