// An open mesh whose inside vector points at the camera: that is beyond the box around the mesh, and so in the fog.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -2> look_at 0 }
light_source { <-0.1, 0.1, -1> rgb 1 }
fog { distance 3 rgb 0.1 }
union {
  mesh2 {
    vertex_vectors { 4, <-0.53, -0.51, 0>, <0.51, -0.5, 0.02>, <0.5, 0.52, 0.03>, <-0.5, 0.55, 0.01> }
    face_indices { 2, <0, 1, 2>, <0, 2, 3> }
    inside_vector z
    pigment { rgb 1 }
  }
  sphere { <0, 0, 3>, 2 pigment { rgb <1, 0.8, 0.6> } }
  sphere { <0, 0, -6>, 1 pigment { rgb 1 } }
}
