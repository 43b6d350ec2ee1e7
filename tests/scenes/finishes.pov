// Every term of the finish, one sphere each, over a mirror floor.
#version 3.7;
global_settings { assumed_gamma 1.0 ambient_light rgb <1, 0.9, 0.8> max_trace_level 6 }
background { color rgb <0.1, 0.15, 0.25> }
camera { location <0, 4, -12> look_at <0, 0.5, 0> angle 45 }
light_source { <8, 12, -10> color rgb <1, 0.95, 0.9> }
light_source { <-10, 6, -6> color rgb <0.3, 0.35, 0.5> shadowless }
#macro Ball(X, Z, Pig, Fin)
  sphere { <X, 0, Z>, 0.9 pigment { Pig } finish { Fin } }
#end
#declare Red = pigment { color rgb <0.9, 0.2, 0.1> }
#declare Gold = pigment { color rgb <0.9, 0.7, 0.2> }
Ball(-4, 0, Red, finish { ambient 0.2 diffuse 0.7 brilliance 3 })
Ball(-2, 0, Red, finish { phong 0.8 phong_size 25 })
Ball(0, 0, Gold, finish { phong 0.9 phong_size 90 metallic })
Ball(2, 0, Gold, finish { specular 0.8 roughness 0.02 metallic 0.5 })
Ball(4, 0, Red, finish { emission rgb <0.1, 0.2, 0.1> diffuse 0.4 })
Ball(-4, 3, Gold, finish { reflection { 0.1, 0.9 falloff 3 } diffuse 0.3 })
Ball(-2, 3, Gold, finish { reflection { 0.6 metallic 1 } diffuse 0.3 })
Ball(0, 3, Red, finish { reflection rgb <0.5, 0.3, 0.7> diffuse 0.3 })
Ball(2, 3, Gold, finish { reflection { 0.5 exponent 1.8 } diffuse 0.3 })
Ball(4, 3, Red, finish { specular 0.5 roughness 0.1 brilliance 0.5 })
#declare Floor = texture { pigment { color rgb <0.5, 0.55, 0.5> } finish { diffuse 0.6 reflection 0.25 } }
triangle { <-20, -1, -20>, <20, -1, -20>, <20, -1, 20> texture { Floor } }
triangle { <-20, -1, -20>, <20, -1, 20>, <-20, -1, 20> texture { Floor } }
