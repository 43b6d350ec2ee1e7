// Every kind of light source: spotlights with and without tightness, a hard edge, cylinders, parallel light,
// fading, lights that can be seen, and several at once behind glass.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 6 }
background { rgb <0.02, 0.03, 0.06> }
camera { location <0, 7, -13> look_at <0, 0.6, 0.5> angle 58 right x*4/3 }

#default { finish { ambient 0.05 diffuse 0.8 } }

plane { y, 0 pigment { rgb <0.85, 0.85, 0.8> } }
plane { z, 9 pigment { rgb <0.6, 0.65, 0.8> } }

#declare Ball = sphere { 0, 0.7 pigment { rgb <0.9, 0.5, 0.3> } finish { phong 0.7 specular 0.3 } }
#for (Column, 0, 4)
  #for (Row, 0, 2)
    object { Ball translate <Column*2.6 - 5.2, 0.7, Row*3 - 2.5> }
  #end
#end
sphere { <1.3, 1.1, -4.2>, 0.9 pigment { rgbf <0.8, 0.95, 0.9, 0.8> } interior { ior 1.4 } }
box { <-6.5, 0, 4>, <-5.5, 3, 5> pigment { rgb <0.4, 0.7, 0.5> } finish { reflection 0.2 } }

// The first four are what a bundle of packets asks of together.
light_source {
  <-6, 8, -4> rgb <1, 0.85, 0.6>
  spotlight point_at <-5, 0, 0> radius 12 falloff 22
}
light_source {
  <30, 60, -40> rgb <0.22, 0.22, 0.28>
  parallel point_at <0, 0, 0>
}
light_source {
  <5.5, 9, 1> rgb <0.4, 0.7, 1.2>
  cylinder point_at <4.8, 0, -1.5> radius 1.2 falloff 2.4
}
light_source {
  0, rgb <1.1, 0.5, 0.9>
  fade_distance 2.5 fade_power 2
  looks_like { sphere { 0, 0.25 pigment { rgb <1, 0.6, 0.9> } finish { ambient 1 diffuse 0 } } }
  translate <0, 2.6, -1.2>
}

#declare Torch = light_source {
  0 rgb <0.5, 1, 0.5>
  spotlight point_at -y radius 25 falloff 25 tightness 6
  looks_like { cone { 0, 0.1, -0.4*y, 0.35 open pigment { rgb <0.2, 0.5, 0.2> } finish { ambient 1 } } }
}
union {
  light_source { Torch }
  sphere { 0.3*y, 0.2 pigment { rgb <0.7, 0.7, 0.2> } }
  rotate 25*z
  translate <-1.5, 5, 4>
}
light_source { <3, 3, 6> rgb <0.9, 0.7, 0.3> spotlight point_at <2, 2.5, 9> tightness 10 radius 0 falloff 70 }
light_source { <-3, 6, 2> rgb <1, 0.3, 0.2> cylinder point_at <-3, 0, 2> tightness 1.5 radius 0 falloff 2 }
light_source { <-3, 4, -9> rgb <0.2, 0.2, 0.25> spotlight shadowless fade_distance 9 fade_power 1 }
light_source { <0, 1, 8> rgb <0.1, 0.07, 0.05> parallel point_at <2, 0.8, 9> }
// Behind parallel light distances are negative, of which odd powers are, too, and others may be no numbers.
light_source { <-6, 1, 9> rgb <0.05, 0.08, 0.06> parallel point_at <-6, 0.8, 10> fade_distance 40 fade_power 3 }
light_source { <2, 3, 1> rgb <0.1, 0.06, 0.06> parallel point_at <4, 1, 1.5> fade_distance 5 fade_power 1.5 }
light_source { <4, 6, -9> rgb <0.04, 0.04, 0.08> fade_distance -60 fade_power 1 }
