// Refraction: nested and overlapping interiors, total internal reflection, Fresnel mirrors, coloured shadows.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 12 adc_bailout 0.002 }
background { color rgb <0.3, 0.4, 0.6> }
camera { location <0, 3, -9> look_at <0, 0.6, 0> angle 48 }
light_source { <5, 10, -6> color rgb 1 }
#declare Glass = material {
  texture { pigment { color rgbf <0.95, 0.98, 0.96, 0.9> } finish { ambient 0 diffuse 0.1 specular 0.7 roughness 0.004 reflection { 0, 1 fresnel on } conserve_energy } }
  interior { ior 1.5 }
}
#declare Water = material {
  texture { pigment { color rgbft <0.7, 0.9, 1, 0.6, 0.3> } finish { ambient 0 diffuse 0 reflection 0.08 } }
  interior { ior 1.33 }
}
sphere { <-2.6, 1, 0>, 1.4 material { Glass } }
sphere { <-2.6, 1, 0>, 0.7 material { Water } }
sphere { <0.4, 0.8, 0.4>, 1.2 material { Glass } }
sphere { <1.4, 0.8, -0.3>, 1.0 material { Water } }
sphere { <3.4, 0.6, 0>, 0.9 pigment { color rgbf <1, 0.3, 0.2, 0.8> } finish { diffuse 0.3 } }
sphere { <-0.6, 0, -2.6>, 0.5 scale <1.6, 1, 0.8> material { Glass } }
sphere { <1.5, 0, -2.6>, 0.5 pigment { color rgbt <0.4, 1, 0.4, 0.5> } }
sphere { <0, 1, 5>, 1.5 pigment { color rgb <1, 0.8, 0.1> } }
triangle { <-20, -0.6, -20>, <20, -0.6, -20>, <20, -0.6, 20> pigment { color rgb <0.9, 0.85, 0.8> } }
triangle { <-20, -0.6, -20>, <20, -0.6, 20>, <-20, -0.6, 20> pigment { color rgb <0.6, 0.65, 0.7> } }
