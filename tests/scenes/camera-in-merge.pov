// The camera is outside of a ball, which is inside of the merge with that ball's inverse. POV-Ray asks only objects
// around whose bounds the camera is, and bounds what is inverse as if it were not: the camera is in none of these.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
camera { location <0, 1.5, -6> look_at <0, 0.2, 0> angle 46 }
background { rgb <0.2, 0.3, 0.5> }
light_source { <-8, 12, -10> rgb 1 }
plane { y, -1.2 pigment { checker rgb <0.9, 0.8, 0.5>, rgbt <0.2, 0.4, 0.6, 0.4> } }

#declare Clear = texture { pigment { rgbt <0.8, 0.9, 0.8, 0.6> } finish { reflection 0.1 } }
#declare Bent = interior { ior 1.4 }
merge {
  intersection { cylinder { <0, -0.9, 0>, <0.3, 0.8, 0>, 0.7 open } box { -0.8, 0.8 } }
  sphere { <0.4, 0, 0.4>, 0.9 inverse }
  texture { Clear } interior { Bent } translate <-1.2, 0, 0>
}
merge {
  difference { sphere { 0, 0.9 } box { <0.2, -2, -2>, 2 inverse } }
  sphere { 0, 0.6 inverse clipped_by { box { -2, 2 } } }
  texture { Clear } interior { Bent } translate <1.3, 0, 0>
}

// The same with a mesh, in front: beside an inverse box, whose bounds would be everywhere, and inverse itself.
#declare Corners = array[4] { <1, 1, 1>, <-1, -1, 1>, <-1, 1, -1>, <1, -1, -1> }
#declare Pyramid = mesh {
  #for (I, 0, 3)
    triangle { Corners[I], Corners[mod(I + 1, 4)], Corners[mod(I + 2, 4)] }
  #end
  inside_vector y
}
union {
  box { -0.3, 0.3 inverse clipped_by { sphere { 0, 0.5 } } }
  object { Pyramid scale 0.2 translate 0.5*y }
  texture { Clear } interior { Bent } translate <-0.7, -0.6, -2>
}
union {
  object { Pyramid scale 0.4 inverse }
  sphere { 0.5*x, 0.2 }
  texture { Clear } interior { Bent } translate <0.6, -0.6, -2>
}
