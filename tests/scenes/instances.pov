// Instances that are more triangles together than the scene image has copies of: a smooth mesh with two textures of its
// own and a flat one, turned, stretched and mirrored, in a mirror, behind glass and in two kinds of light.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 4 }
camera { location <0, 5, -14> look_at <0, 0.6, 0> angle 48 }
light_source { <20, 40, -30> rgb 0.8 }
light_source { <-15, 20, -10> rgb 0.5 spotlight point_at 0 radius 20 falloff 35 }
fog { distance 80 rgb <0.6, 0.7, 0.8> }
plane { y, -1.5 pigment { checker rgb 0.3 rgb 0.7 } finish { reflection 0.2 } }
sphere { <0, 1, -8>, 0.8 pigment { rgbf <1, 0.9, 0.9, 0.9> } interior { ior 1.3 } }

#declare Columns = 96;
#declare Rows = 48;
#declare Place = function(turn, tube, along) { (along = 1) * 0.4 * sin(tube) + (along = 0) * cos(turn) * (1 + 0.4 * cos(tube))
                                             + (along = 2) * sin(turn) * (1 + 0.4 * cos(tube)) }
#macro Point(I, J)
  #local Turn = I / Columns * 2 * pi;
  #local Tube = J / Rows * 2 * pi;
  <Place(Turn, Tube, 0), Place(Turn, Tube, 1), Place(Turn, Tube, 2)>
#end
#macro Normal(I, J)
  #local Turn = I / Columns * 2 * pi;
  #local Tube = J / Rows * 2 * pi;
  <cos(Turn) * cos(Tube), sin(Tube), sin(Turn) * cos(Tube)>
#end

#declare Smooth = mesh2 {
  vertex_vectors { Columns * Rows #for(I, 0, Columns - 1) #for(J, 0, Rows - 1) , Point(I, J) #end #end }
  normal_vectors { Columns * Rows #for(I, 0, Columns - 1) #for(J, 0, Rows - 1) , Normal(I, J) #end #end }
  texture_list {
    2,
    texture { pigment { rgb <0.9, 0.4, 0.2> } finish { phong 0.6 } }
    texture { pigment { rgb <0.3, 0.8, 0.4> } finish { reflection 0.3 diffuse 0.5 } }
  }
  face_indices {
    Columns * Rows * 2
    #for(I, 0, Columns - 1)
      #for(J, 0, Rows - 1)
        #local A = I * Rows + J;
        #local B = mod(I + 1, Columns) * Rows + J;
        #local C = mod(I + 1, Columns) * Rows + mod(J + 1, Rows);
        #local D = I * Rows + mod(J + 1, Rows);
        , <A, B, C>, mod(I, 2), <A, C, D>, mod(I, 2)
      #end
    #end
  }
}
#declare Flat = mesh {
  #for(I, 0, Columns - 1)
    #for(J, 0, Rows - 1)
      triangle { Point(I, J), Point(I + 1, J), Point(I + 1, J + 1) }
    #end
  #end
}

#declare R = seed(5);
#macro Somewhere()
  rotate 360 * <rand(R), rand(R), rand(R)>
  scale <0.3, 0.2, 0.4> * (0.6 + rand(R))
  translate (<rand(R), rand(R), rand(R)> - <0.5, 0.2, 0.3>) * <14, 5, 14>
#end
#for(I, 0, 39)
  object { Smooth scale <1, 1, 2 * mod(I, 2) - 1> Somewhere() }
#end
#for(I, 0, 34)
  object {
    Flat
    Somewhere()
    texture { pigment { gradient y color_map { [0 rgb <rand(R), rand(R), 1>] [1 rgb 1] } scale 0.3 } finish { specular 0.4 } }
  }
#end
