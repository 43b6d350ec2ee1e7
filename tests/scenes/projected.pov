// Lights that shine through something alone: shapes, CSG, a polygon, a mesh, a wall without an end; with areas, parallel,
// without shadows; what is before the projector casts no shadow, what is behind does.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 7, -13> look_at <0, 0.5, 0> angle 52 }
light_source { <3, 12, -12> rgb 0.15 }
#default { finish { ambient 0.03 diffuse 0.8 } }

plane { y, 0 pigment { rgb 0.8 } }
plane { z, 8 pigment { rgb <0.7, 0.7, 0.8> } }
#for (I, -2, 2)
  sphere { <2.4*I, 0.7, 0.5>, 0.7 pigment { rgb <0.9, 0.6 + 0.15*I, 0.5> } finish { phong 0.5 } }
#end
box { <-4.3, 2.2, -3.2>, <-3.7, 2.4, -2.6> pigment { rgb 0.5 } }
cylinder { <4.2, 3.5, -3>, <4.2, 4.5, -3>, 0.2 pigment { rgb <0.4, 0.9, 0.5> } }

light_source {
  <-4, 7, -4> rgb <1, 0.7, 0.5>
  projected_through {
    difference {
      box { <-1, -0.1, -1>, <1, 0.1, 1> }
      cylinder { -y, y, 0.4 }
      translate <-4, 3, -2.5>
    }
  }
}
light_source {
  <4, 8, -5> rgb <0.4, 0.6, 1>
  projected_through {
    polygon { 10, <-1, 0, -1>, <1, 0, -1>, <1, 0, 1>, <-1, 0, 1>, <-1, 0, -1>, <-0.5, 0, -0.5>, <0.5, 0, -0.5>, <0.5, 0, 0.5>, <-0.5, 0, 0.5>, <-0.5, 0, -0.5> }
    rotate 30*y translate <4, 3, -3>
  }
  area_light x*0.4, z*0.4, 5, 5 adaptive 1
}
light_source {
  <0, 9, -3> rgb <0.5, 0.9, 0.5> parallel point_at <0, 0, 0>
  projected_through {
    union {
      mesh { triangle { <-1.4, 4, -2>, <0.2, 4, -2>, <-0.6, 4, 0> } triangle { <0.2, 4, -2>, <1.4, 4, -0.5>, <-0.6, 4, 0> } }
      sphere { <1.6, 4, -1.5>, 0.4 }
    }
  }
}
light_source {
  <0, 5, -9> rgb <0.5, 0.2, 0.4> shadowless
  projected_through { torus { 1.6, 0.35 rotate 70*x translate <0, 3, -4> } }
}
