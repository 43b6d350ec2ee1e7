// Soft shadows: grids that are adaptive or not, a large one, round ones, ones that turn to the surface, of a spotlight
// and of parallel light, a line, and behind coloured glass. None is jittered: POV-Ray's pictures are of chance then.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 5 }
camera { location <0, 7, -13> look_at <0, 0.6, 0.5> angle 58 right x*4/3 }

#default { finish { ambient 0.05 diffuse 0.8 } }

plane { y, 0 pigment { rgb <0.85, 0.85, 0.8> } }
plane { z, 9 pigment { rgb <0.6, 0.65, 0.8> } }

#for (Column, 0, 4)
  #for (Row, 0, 2)
    sphere {
      <Column*2.6 - 5.2, 0.8 + 0.3*mod(Row + Column, 3), Row*3 - 2.5>, 0.7
      pigment { rgb <0.9, 0.4 + 0.1*Row, 0.3> }
      finish { phong 0.6 }
    }
  #end
#end
sphere { <1.3, 1.1, -4.2>, 0.9 pigment { rgbf <0.3, 0.95, 0.5, 0.8> } interior { ior 1.2 } }
box { <-6.5, 0, 4>, <-5.5, 3, 5> pigment { rgb <0.4, 0.7, 0.5> } finish { reflection 0.3 } }
cylinder { <4, 0, 5>, <4, 4, 5>, 0.2 open pigment { rgb 0.7 } }

// A sky around everything, and planes that are parts of CSG: one occludes lights, the other is the top of a block.
sphere { 0, 300 hollow pigment { rgb <0.02, 0.03, 0.06> } finish { ambient 1 diffuse 0 } }
plane { x + 0.4*y, 4.4 clipped_by { sphere { <3.4, 2.4, -3>, 0.8 } } pigment { rgb <0.8, 0.7, 0.3> } }
intersection {
  plane { y, 1.2 }
  box { <-4.2, 0, -5.6>, <-2.4, 3, -4.4> }
  pigment { rgb <0.5, 0.6, 0.9> }
}

light_source { <-9, 12, -8> rgb <0.6, 0.5, 0.4> area_light 4*x, 4*z, 5, 4 }
light_source {
  0 rgb <0.3, 0.45, 0.6>
  area_light <3, 0, 0>, <0, 3, 0>, 17, 17 adaptive 1 circular orient
  translate <8, 9, -6>
}
light_source { <0, 6, 7> rgb 0.4 area_light 3*x, <0, 0, 1>, 18, 17 adaptive 0 circular fade_distance 8 fade_power 1 }
light_source {
  <2, 10, -6> rgb <0.9, 0.7, 0.9>
  spotlight point_at <1, 0, -2> radius 12 falloff 20
  area_light 1.5*x, 1.5*z, 9, 9 adaptive 2
  rotate 5*z
}
light_source { <-20, 30, 10> rgb 0.15 parallel point_at 0 area_light 6*x, 6*z, 4, 4 adaptive 1 }
light_source { <6, 3, 2> rgb 0.2 area_light x, 3.7*z, 1, 7 }
