// Patterns of how surfaces face a direction: with and without altitude and limits, in maps of colours, pigments
// and textures, on transformed and disturbed surfaces, as normals, and through glass.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 4, -12> look_at <0, 0.2, 0> angle 46 }
background { rgb <0.1, 0.15, 0.3> }
light_source { <-8, 14, -12> rgb 1 }
light_source { <9, 3, -5> rgb 0.3 shadowless }

#declare Bands = color_map { [0 rgb <0.8, 0.1, 0.1>] [0.5 rgb <0.9, 0.9, 0.3>] [1 rgb <0.1, 0.3, 0.8>] }
#declare Snow = pigment { slope y color_map { [0.5 rgb <0.4, 0.35, 0.3>] [0.75 rgb 1] } }

plane { y, -2.2 pigment { checker rgb 0.5 rgb 0.7 } finish { reflection 0.15 } }
sphere { 0, 1 pigment { slope y color_map { Bands } } translate <-4.5, 2.2, 0> }
sphere { 0, 1 pigment { slope { <1, 1, -1>, 0.2, 0.9 } color_map { Bands } } translate <-2.2, 2.2, 0> }
sphere { 0, 1 pigment { slope { y altitude y } color_map { Bands } } scale <1, 0.7, 1> translate <0, 2.2, 0> }
sphere { 0, 1
  pigment { slope { y, 0.1, 0.9 altitude <0.3, 1, 0>, -1, 1 } color_map { Bands } frequency 2 }
  rotate <20, 0, 40> translate <2.3, 2.2, 0>
}
torus { 0.7, 0.3 texture { Snow normal { bumps 0.7 scale 0.3 } } rotate <-50, 20, 0> translate <4.5, 2.2, 0> }
box { -0.8, 0.8 pigment { Snow } rotate <30, 30, 20> translate <-4.5, -0.3, 0> }
cone { -y, 1, y, 0.2 pigment { slope y pigment_map { [0.4 checker rgb 0 rgb 1 scale 0.3] [0.7 rgb <1, 0.6, 0.2>] } }
  translate <-2.2, -0.3, 0>
}
sphere { 0, 1
  texture { slope { y } texture_map {
    [0.3 pigment { rgb <0.2, 0.5, 0.2> } finish { phong 0.7 }]
    [0.6 pigment { rgb <0.7, 0.7, 0.9> } normal { wrinkles 0.6 scale 0.3 }]
  } }
  translate <0, -0.3, 0>
}
sphere { 0, 1 pigment { slope y color_map { [0 rgbf <0.9, 0.4, 0.4, 0.9>] [1 rgbf <0.5, 0.9, 1, 0.9>] } }
  interior { ior 1.2 } translate <2.3, -0.3, -0.5>
}
mesh {
  smooth_triangle { <-1, -1, 0>, <-1, 0, -1>, <1, -1, 0>, <1, 0, -1>, <0, 1, 0.5>, <0, 1, -0.3> }
  triangle { <1, -1, 0>, <1.5, 1, 0.7>, <0, 1, 0.5> }
  texture { Snow }
  translate <4.3, -0.5, 0>
}
// Beyond the limits it starts again, before the frequency is applied; flat ground is just at 1, or at 0 beyond it.
#local At = -4.5;
#for (I, 0, 5)
  #switch (I)
    #case (0) #local Limited = pigment { slope { y, 0, 0.5 } color_map { Bands } } #break
    #case (1) #local Limited = pigment { slope { y, 0.3, 1 } color_map { Bands } } #break
    #case (2) #local Limited = pigment { slope { -y, 0.5, 1 } color_map { Bands } } #break
    #case (3) #local Limited = pigment { slope { y, 0.2, 0.9 } color_map { Bands } frequency 1.7 } #break
    #case (4) #local Limited = pigment { slope { y, 0.3, 0.6 altitude y, -1, 0.4 } color_map { Bands } frequency 0.6 phase 0.2 } #break
    #case (5) #local Limited = pigment { slope { x, 0.4, 0.7 } color_map { Bands } triangle_wave frequency 1.3 } #break
  #end
  union {
    sphere { 0.25*x, 0.5 }
    cylinder { <-0.5, -0.4, -0.4>, <-0.5, 0, -0.4>, 0.35 }
    pigment { Limited }
    translate <At, -1.6, -1>
  }
  #local At = At + 1.8;
#end
