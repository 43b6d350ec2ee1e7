// Light groups: with global lights and without, nested, declared, with lights of every kind and unions that have lights
// of their own. All objects cast shadows in all lights.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 6, -12> look_at <0, 0.5, 0> angle 50 }
light_source { <10, 20, -10> rgb 0.6 }
light_source { <-10, 15, -5> rgb 0.2 shadowless }

#macro Things(C)
  sphere { <0, 1, 0>, 1 pigment { rgb C } finish { phong 0.6 reflection 0.1 } }
  box { <-1.4, 0, -0.4>, <-0.9, 1.2, 0.4> pigment { rgb <0.9, 0.8, 0.7> } }
#end

plane { y, 0 pigment { checker rgb 0.4 rgb 0.9 } }
light_group {
  light_source { <-5, 8, -6> rgb <1, 0.3, 0.3> }
  Things(<1, 1, 1>)
  translate -3*x
}
light_group {
  light_source { <0, 8, -6> rgb <0.3, 1, 0.3> spotlight point_at <0, 1, 0> radius 8 falloff 14 }
  Things(<1, 1, 1>)
  global_lights on
}
light_group {
  union { Things(<1, 0.9, 0.8>) light_source { <9, 9, -2> rgb <0.15, 0, 0.15> } }
  light_source { <5, 8, -6> rgb <0.3, 0.3, 1> area_light x, z, 3, 3 adaptive 1 }
  light_group {
    light_source { <4, 8, 6> rgb <1, 1, 0.3> }
    difference {
      box { <-0.5, 0, -3>, <0.5, 1, -2> }
      sphere { <0, 1, -2.5>, 0.45 }
      pigment { rgb 1 }
    }
  }
  translate 3*x
}
#declare Group =
light_group {
  light_source { <1, 3, -5> rgb <0, 0.6, 0.6> looks_like { sphere { 0, 0.2 pigment { rgb 1 } } } }
  cylinder { <0, 0, -4>, <0, 0.8, -4>, 0.4 pigment { rgb 1 } }
};
light_group {
  light_source { <-3, 3, -6> rgb <0.5, 0.4, 0> parallel point_at <0, 0, -4> }
  object { Group translate -1*x }
  object { Group translate 1.2*x }
  mesh { triangle { <-4, 0, -3>, <-2, 0, -3>, <-3, 2, -2.5> } pigment { rgb 1 } }
}
