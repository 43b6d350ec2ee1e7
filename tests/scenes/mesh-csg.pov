// Meshes as parts of CSG: cut, cutting, inverse, clipped, clipping, smooth, textured, in glass.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
background { color rgb <0.4, 0.47, 0.6> }
camera { location <0, 7, -12> look_at <0.2, 0.6, 0.4> angle 48 }
light_source { <-6, 11, -9> color rgb 1 }
light_source { <8, 6, -5> color rgb <0.3, 0.3, 0.25> shadowless }
#declare Red = texture { pigment { color rgb <0.9, 0.25, 0.2> } finish { phong 0.5 } }
#declare Gold = texture { pigment { color rgb <0.9, 0.7, 0.2> } finish { specular 0.5 metallic } }
#declare Blue = texture { pigment { color rgb <0.25, 0.4, 0.9> } finish { phong 0.4 reflection 0.15 } }
#declare Clear = texture {
  pigment { color rgbf <0.75, 0.95, 0.85, 0.8> }
  finish { diffuse 0.3 specular 0.5 }
}

plane { y, 0 pigment { color rgb <0.75, 0.72, 0.68> } }

#declare Cube = mesh2 {
  vertex_vectors {
    8, <-1, -1, -1>, <1, -1, -1>, <1, 1, -1>, <-1, 1, -1>, <-1, -1, 1>, <1, -1, 1>, <1, 1, 1>, <-1, 1, 1>
  }
  face_indices {
    12, <0, 1, 2>, <0, 2, 3>, <4, 5, 6>, <4, 6, 7>, <0, 4, 7>, <0, 7, 3>, <1, 5, 6>, <1, 6, 2>, <3, 2, 6>,
    <3, 6, 7>, <0, 1, 5>, <0, 5, 4>
  }
  inside_vector <0.1, 1, 0.2>
}

// A ring whose tube bulges, with the normals of a torus. Rings are sides of the whole, sides those of the tube.
#declare Rings = 24;
#declare Sides = 12;
#macro RingPoint(Ring, Side)
  #local Out = vrotate(x, <0, 0, 360 * Side / Sides>);
  vrotate(x * 0.8 + Out * (0.3 + 0.05 * cos(2 * pi * 3 * Ring / Rings)), <0, 360 * Ring / Rings, 0>)
#end
#macro RingNormal(Ring, Side)
  vrotate(vrotate(x, <0, 0, 360 * Side / Sides>), <0, 360 * Ring / Rings, 0>)
#end
#macro Corner(Ring, Side) RingPoint(Ring, Side), RingNormal(Ring, Side) #end
#declare Ring = mesh {
  #for (I, 0, Rings - 1)
    #for (J, 0, Sides - 1)
      smooth_triangle { Corner(I, J), Corner(I + 1, J), Corner(I + 1, J + 1) }
      smooth_triangle { Corner(I, J), Corner(I + 1, J + 1), Corner(I, J + 1) texture { Gold } }
    #end
  #end
  inside_vector y
}

// A ball of flat triangles, all of them apart.
#macro BallPoint(Row, Column) vrotate(vrotate(y, <180 * Row / 8, 0, 0>), <0, 360 * Column / 16, 0>) #end
#declare Ball = mesh {
  #for (I, 0, 7)
    #for (J, 0, 15)
      #if (I > 0) triangle { BallPoint(I, J), BallPoint(I, J + 1), BallPoint(I + 1, J) } #end
      #if (I < 7) triangle { BallPoint(I, J + 1), BallPoint(I + 1, J + 1), BallPoint(I + 1, J) } #end
    #end
  #end
  inside_vector <1, 2, 3>
}

// A mesh that a ball, a cylinder and another mesh are taken from.
difference {
  object { Cube }
  sphere { <0, 0, -1>, 0.8 texture { Blue } }
  cylinder { -2 * y, 2 * y, 0.4 texture { Gold } }
  object { Ball scale 0.6 translate <1, 1, -1> texture { Gold } }
  texture { Red }
  rotate 35 * y
  translate <-4.2, 1.01, 0.7>
}
// A mesh that cuts a box, with the normals of its smooth triangles on the cut.
difference {
  box { -1, 1 }
  object { Ring scale 1.1 translate 0.9 * y }
  texture { Red }
  rotate <0, -20, 0>
  scale <1, 0.8, 1>
  translate <-1.3, 0.81, 0.2>
}
// What is outside of a mesh.
intersection {
  sphere { 0, 1.3 }
  object { Cube inverse scale <0.8, 1.4, 0.8> texture { Gold } }
  texture { Blue }
  rotate <10, 30, 0>
  translate <1.7, 1.3, 1.5>
}
// Open: half of a ring.
object {
  Ring
  clipped_by { plane { z, 0.1 } }
  texture { Blue }
  rotate <-40, 30, 0>
  translate <-2.7, 0.9, -2.6>
}
// What a mesh clips.
sphere {
  0, 0.8
  clipped_by { object { Cube scale <0.5, 2, 0.6> rotate 20 * z } }
  texture { Gold }
  translate <-0.3, 0.8, -2.5>
}
// In glass a merge leaves out what is inside.
merge {
  object { Ball scale 0.75 }
  object { Ball scale 0.6 translate 0.7 * x }
  texture { Clear }
  interior { ior 1.1 }
  translate <3.9, 0.76, -1.1>
}
// In a merge inside out, two levels deep: what is in the cube and in neither the ring nor the box.
merge {
  merge {
    object { Cube scale 0.8 inverse texture { Red } }
    object { Ring texture { Blue } }
  }
  box { <0, -1, -2>, <2, 0.1, 0> }
  texture { Gold }
  inverse
  rotate <-25, 20, 0>
  translate <4.4, 1.3, 1.9>
}
// Nothing is in a triangle, nor in a mesh without an inside vector: of others they show nothing.
#declare Sheet = mesh {
  triangle { <-1, 0, -1>, <1, 0.3, -1>, <1, 0, 1> }
  triangle { <-1, 0, -1>, <1, 0, 1>, <-1, 0.3, 1> }
}
object {
  Sheet
  clipped_by { sphere { 0, 0.5 inverse } }
  texture { Blue }
  rotate <-15, 40, 0>
  translate <1.6, 0.5, -2.4>
}
intersection {
  sphere { 0, 0.7 }
  triangle { <-2, 0.4, -2>, <2, 0.4, -2>, <0, 0.4, 2> inverse texture { Gold } }
  rotate -20 * x
  translate <3.2, 0.6, -3>
}
