// expect: mesh-index-outside.pov:2:1: error: mesh2 has no vertex 4000000000, there are 3
mesh2 {
  vertex_vectors { 3, <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }
  face_indices { 1, <0, 1, 4000000000> }
}
