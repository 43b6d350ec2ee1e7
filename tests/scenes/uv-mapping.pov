// Textures on the coordinates of surfaces: shapes that have such and shapes that have none, meshes, normals,
// maps, and light through them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 5, -13> look_at <0, -0.3, 0> angle 50 }
background { rgb <0.1, 0.15, 0.3> }
light_source { <-8, 14, -12> rgb 1 }

#declare Chequered = pigment { checker rgb <0.9, 0.2, 0.1> rgb <1, 0.95, 0.7> scale 0.125 }
#declare OnSurface = texture { uv_mapping pigment { Chequered } }
#declare Rough = texture {
  uv_mapping pigment { rgb <1, 0.8, 0.6> } normal { quilted 1 scale 0.1 } finish { phong 0.6 }
}

plane { y, -3 pigment { rgb 0.6 } finish { reflection 0.2 } }

// Whatever is done to the object later, the texture stays where it is on it.
sphere { 0, 1 texture { OnSurface } rotate <20, 30, 0> translate <-5, 2.2, 0> }
sphere { 0, 1 pigment { uv_mapping Chequered } scale <1, 0.6, 1.2> rotate <20, -30, 30> translate <-5, 0, 0> }
box { -1, 1 texture { OnSurface } scale 0.8 rotate <20, 30, 10> translate <-2.5, 2.2, 0> }
torus { 0.8, 0.3 texture { OnSurface } rotate <-60, 20, 10> translate <-2.5, 0, 0> }
cylinder { -y, y, 0.7 pigment { uv_mapping Chequered } rotate <20, 30, 10> translate <0, 2.2, 0> }
cone { -y, 0.8, y, 0.3 pigment { uv_mapping Chequered } rotate <20, 30, 10> translate 0 }
quadric { <1, 2, 1>, 0, 0, -0.4 pigment { uv_mapping Chequered } translate <0, -2, -1> }
triangle { <-1, -2.8, -3>, <1, -2.8, -3>, <0, -2, -2.5> pigment { uv_mapping Chequered } }

mesh {
  triangle { <-1, -1, 0>, <1, -1, 0>, <-1, 1, 0.5> uv_vectors <0, 0>, <1, 0>, <0, 1> }
  smooth_triangle {
    <1, -1, 0>, <1, 0, -1>, <-1, 1, 0.5>, <-1, 1, -1>, <1, 1, 0>, <0, 1, -1>
    uv_vectors <1, 0>, <0, 1>, <1, 1>
  }
  texture { OnSurface }
  rotate y*20
  translate <2.5, 2.2, 0>
}
mesh2 {
  vertex_vectors { 4, <-1, -1, 0>, <1, -1, 0>, <-1, 1, 0>, <1, 1, 0.5> }
  normal_vectors { 4, <-0.5, -0.5, -1>, <0.5, -0.5, -1>, <-0.5, 0.5, -1>, <0.5, 0.5, -1> }
  uv_vectors { 5, <0, 0>, <1, 0>, <0, 2>, <1, 2>, <3, 3> }
  texture_list {
    3, texture { OnSurface }, texture { pigment { gradient y color_map { [0 rgb y] [1 rgb z] } scale 0.3 } },
    texture { uv_mapping pigment { bozo color_map { [0 rgb 0] [1 rgb 1] } scale 0.1 } }
  }
  face_indices { 2, <0, 1, 2>, 0, 1, 2, <1, 3, 2>, 2, 0, 0 }
  uv_indices { 2, <0, 1, 2>, <1, 4, 2> }
  rotate y*20
  translate <2.5, 0, 0>
}

// Normals.
sphere { 0, 1 texture { Rough } translate <5, 2.2, 0> }
torus {
  0.7, 0.3 pigment { rgb 1 } normal { uv_mapping granite 0.6 scale 0.3 } finish { specular 0.6 }
  rotate x*-50
  translate <5, 0, 0>
}

// Layers, maps, and a whole union.
sphere {
  0, 0.9
  texture { pigment { uv_mapping bozo color_map { [0 rgb x] [0.5 rgb y] [1 rgb z] } scale 0.1 turbulence 0.3 } }
  texture { pigment { uv_mapping gradient x color_map { [0.5 rgbt 1] [0.5 rgb 1] } frequency 12 } }
  translate <-5, -2, -1>
}
box {
  -0.7, 0.7
  texture {
    uv_mapping gradient x
    texture_map { [0.5 pigment { checker rgb 0 rgb 1 scale 0.05 }] [0.5 Rough] }
    scale 0.3
  }
  rotate <30, 20, 0>
  translate <-2.5, -2, -1>
}
union {
  difference { box { -0.6, 0.6 } sphere { <0, 0.3, -0.6>, 0.5 } }
  sphere { <0.2, 0.9, 0>, 0.4 }
  uv_mapping
  pigment { checker rgb 0 rgb <1, 0.6, 0> scale 0.1 }
  rotate y*25
  translate <2.2, -2.4, -1.5>
}

// Clear.
sphere {
  0, 1 pigment { uv_mapping checker rgbf <1, 0.2, 0.1, 0.9> rgbt <0.4, 1, 0.5, 0.7> scale 0.125 }
  translate <4.8, -2, -1.5>
}
