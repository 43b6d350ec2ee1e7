// Shapes with equations of their own: turned, stretched, open, closed, in a mirror, in one another's shadow.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 5 }
background { color rgb <0.3, 0.4, 0.6> }
camera { location <0, 6, -13> look_at <0, 0.7, 0.5> angle 44 }
light_source { <7, 12, -9> color rgb 1 }
light_source { <-9, 7, -4> color rgb <0.25, 0.25, 0.35> }
#declare Red = texture { pigment { color rgb <0.9, 0.25, 0.2> } finish { phong 0.6 phong_size 30 } }
#declare Green = texture { pigment { color rgb <0.3, 0.75, 0.35> } finish { specular 0.5 roughness 0.03 } }
#declare Blue = texture { pigment { color rgb <0.25, 0.4, 0.9> } finish { phong 0.4 } }
#declare Sand = texture { pigment { color rgb <0.85, 0.75, 0.5> } finish { ambient 0.15 diffuse 0.7 } }
#declare Mirror = texture { pigment { color rgb 0.1 } finish { diffuse 0.2 reflection 0.75 } }
#declare Glass = texture { pigment { color rgbf <0.8, 1, 0.9, 0.75> } finish { diffuse 0.2 specular 0.6 } }

plane { y, 0 texture { Sand } }
plane { <0.1, 0, -1>, -9 texture { pigment { color rgb <0.6, 0.65, 0.75> } finish { reflection 0.2 } } }

box { <-0.8, 0, -0.6>, <0.8, 1.3, 0.6> texture { Red } rotate <0, 35, 0> translate <-5, 0, 1> }
box { <0.6, 0.9, 0.5>, -0.4 texture { Glass } rotate <25, 40, 10> translate <-3.6, 0.8, -2.4> }
cylinder { 0, <0, 1.6, 0>, 0.7 texture { Green } translate <-2.6, 0, 2> }
cylinder { <-0.9, 0.6, 0>, <0.9, 0.8, 0.3>, 0.55 open texture { Blue } rotate y*25 translate <-1.6, 0, -1.6> }
cone { 0, 0.9, <0.2, 1.8, 0>, 0 texture { Blue } translate <0, 0, 0.8> }
cone { <0, 0.2, 0>, 0.3, <0, 1.2, 0>, 0.8 open texture { Red } scale <1.2, 1, 0.8> translate <0.7, 0, -2.6> }
cone { <0, 0, 0>, 0.8, <0, 1, 0>, 0.4 texture { Mirror } translate <2.2, 0, 2.2> }
disc { <0, 1, 0>, <-0.4, 0.8, -0.6>, 0.9, 0.35 texture { Green } translate <2.4, 0, -1.6> }
disc { <0, 1.4, 0>, <0.3, 0.2, -1>, 1.1 texture { Mirror } translate <4.6, 0, 3> }
torus { 0.8, 0.3 texture { Red } rotate <70, 0, 20> translate <4.4, 1, -0.8> }
torus { 1, 0.18 sturm texture { Blue } scale <1, 1.4, 0.6> translate <-0.4, 0.3, 4> }
torus { 0.5, 0.22 texture { Glass } rotate x*30 translate <-0.1, 0.7, -3.4> }
quadric {
  <1, -0.5, 1.3>, <0.2, 0, 0>, <0, 0.1, 0>, -0.06
  clipped_by { box { -0.7, 0.7 } } texture { Green } rotate z*15 translate <-3.9, 0.75, 0.2>
}
quadric { <1, 0, 1.2>, <0, 0, 0>, <0, 0, 0>, -0.02 texture { Blue } translate <-6.3, 0, 4.5> }
intersection {
  quadric { <1, 0, 1.5>, <0, 0, 0>, <0, -0.8, 0>, 0 texture { Red } }
  plane { y, 0.7 texture { Blue } }
  rotate <-25, 0, -10> translate <5.6, 0.1, -2>
}
superellipsoid { <0.3, 0.6> texture { Green } scale 0.5 rotate <-60, 0, 30> translate <5.4, 2, 1.2> }
superellipsoid { <1.5, 0.25> texture { Glass } scale 0.45 rotate <80, 20, 0> translate <-1.8, 0.6, -4.2> }
superellipsoid { <2.5, 3> texture { Red } scale 1.1 rotate <10, 30, 20> translate <-6.8, 1.4, 1.6> }
sphere { 0, 0.6 texture { Mirror } scale <1, 0.8, 1.2> translate <-4.8, 2, 2.8> no_shadow }
