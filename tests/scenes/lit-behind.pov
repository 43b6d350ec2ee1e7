// Light from behind: finishes that send it on, objects that do not tell it from light from before, albedos.
#version 3.7;
global_settings { assumed_gamma 1 }
background { rgb <0.1, 0.12, 0.2> }
camera { location <0, 2.5, -9> look_at <0, 1.2, 0> angle 50 }
light_source { <5, 8, -9> rgb 0.4 }
light_source { <-4, 6, 8> rgb <1, 0.9, 0.7> }
light_source { <6, 3, 5> rgb <0.2, 0.3, 0.6> shadowless }
#default { finish { ambient 0.05 } }

plane { y, 0 pigment { checker rgb 0.4 rgb 0.8 } }
#macro Leaf(Place, Turn, Finish)
  union {
    disc { 0, z, 0.7, 0.2 }
    polygon { 3, <-0.7, 0.6>, <0.7, 0.6>, <0, 1.2> }
    pigment { rgb <0.5, 0.9, 0.3> }
    finish { Finish }
    rotate Turn translate Place
  }
#end
Leaf(<-3.6, 1, 0>, <0, 20, 0>, finish { diffuse 0.6, 0.4 })
Leaf(<-1.8, 1, 0.5>, <0, -30, 0>, finish { diffuse 0.6 0.4 brilliance 2 })
Leaf(<0, 1, 0>, <0, 60, 0>, finish { diffuse albedo 0.5, 0.4 brilliance 3 phong albedo 0.1 phong_size 20 })
Leaf(<1.8, 1, 0.5>, <10, 10, 0>, finish { diffuse 0.5, 0.5 specular albedo 0.2 roughness 0.04 })
Leaf(<3.6, 1, 0>, <0, -20, 0>, finish { diffuse 0.1, 0.8 irid { 0.3 thickness 0.5 } })
object {
  Leaf(<-2.6, 3, 1>, <0, 30, 0>, finish { diffuse 0.6 phong 0.4 phong_size 5 specular 0.4 roughness 0.1 })
  double_illuminate
}
object { Leaf(<-0.6, 3, 1>, <0, -40, 0>, finish { diffuse 0.6, 0.2 brilliance 1.5 }) double_illuminate }
union {
  Leaf(<1.2, 3, 1>, <0, 15, 0>, finish { diffuse 0.6 })
  mesh {
    triangle { <2.2, 2.4, 1>, <3.4, 2.4, 1.4>, <2.8, 3.8, 1> }
    smooth_triangle { <3.6, 2.4, 1>, <-0.3, 0, -1>, <4.6, 2.4, 1>, <0.3, 0, -1>, <4.1, 3.8, 1>, <0, 0.3, -1> }
    pigment { gradient y color_map { [0 rgb <1, 0.4, 0.3>] [1 rgb <0.3, 0.5, 1>] } }
    normal { bumps 0.4 scale 0.2 }
  }
  double_illuminate
}
sphere { <-1.2, 0.5, -2.5>, 0.5 pigment { rgbt <0.9, 0.7, 0.5, 0.4> } finish { diffuse 0.5, 0.5 } }
sphere {
  <1.2, 0.5, -2.5>, 0.5
  texture { pigment { rgb <0.3, 0.5, 0.9> } finish { diffuse 0.4, 0.6 } }
  texture { pigment { checker rgbt 1 rgb <0.9, 0.9, 0.2> scale 0.2 } finish { diffuse 0.7 } }
}
