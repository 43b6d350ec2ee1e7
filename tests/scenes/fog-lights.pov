// Lights that fog dims (media_attenuation), through objects that are hollow and others that are not; fogs that tint, lie on
// the ground and are two.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
camera { location <0, 4, -16> look_at <0, 2, 0> angle 55 }
#default { finish { ambient 0.05 diffuse 0.8 } }

fog { distance 30 rgbf <0.6, 0.5, 0.4, 0.5> }
fog { fog_type 2 distance 20 rgbt <0.4, 0.5, 0.6, 0.2> fog_offset 0.5 fog_alt 1.5 }
light_source { <8, 20, -12> rgb 7 media_attenuation on }
light_source { <-6, 7, -3> rgb <2, 1.6, 1> media_attenuation on fade_distance 5 fade_power 1 }
light_source { <-12, 10, -14> rgb 0.3 }
light_source { <4, 6, 5> rgb <0.3, 0.5, 1> media_attenuation on media_interaction off }
light_source { <-8, 9, 6> rgb <0.4, 0.3, 0.4> shadowless media_attenuation on }

plane { y, 0 pigment { checker rgb 0.4 rgb 0.9 scale 2 } hollow }
plane { z, 12 pigment { rgb <0.7, 0.8, 0.7> } hollow }
sphere { <-4, 3, 0>, 2.4 pigment { rgbt <1, 1, 1, 0.9> } finish { diffuse 0.1 phong 0.5 } interior { ior 1.02 } }
sphere { <3, 3, 1>, 2.4 pigment { rgbt <1, 1, 1, 0.9> } finish { diffuse 0.1 phong 0.5 } interior { ior 1.02 } hollow }
box { <-1.2, 0, -3>, <0.2, 2.2, -2> pigment { rgb <0.8, 0.5, 0.3> } }
cylinder { <5.5, 0, -3>, <5.5, 4, -3>, 0.5 pigment { rgbf <0.9, 0.6, 0.5, 0.7> } hollow }
