// Surfaces of one shape at one place, of which the same one is seen everywhere: in unions within CSG, clipped unions and CSGs of different sizes.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.5, 3, -11> look_at <0, 0, 0> angle 40 }
light_source { <-6, 10, -9> rgb 1 }
background { rgb <0.3, 0.4, 0.6> }

#declare Red = pigment { rgb <0.9, 0.2, 0.2> }
#declare Green = pigment { rgb <0.2, 0.8, 0.3> }
#declare Blue = pigment { rgb <0.2, 0.3, 0.9> }
#declare Ball = sphere { 0, 1 }
#declare Roll = cylinder { -y, y, 0.8 }

// Unions within an intersection, a difference and a merge: the first part.
intersection {
  union { object { Ball pigment { Red } } object { Ball pigment { Blue } } }
  box { <-2, -2, -2>, <2, 0.5, 2> pigment { Green } }
  translate <-3, 1.5, 0>
}
difference {
  union {
    object { Roll pigment { Blue } }
    union { object { Roll pigment { Green } } object { Roll pigment { Red } } }
  }
  sphere { <0.3, 0.5, -0.8>, 0.5 pigment { Green } }
  translate <-1, 1.5, 0>
}
merge {
  union { object { Ball pigment { Green } } object { Ball pigment { Red } } }
  sphere { <0, 0.9, -0.4>, 0.6 pigment { Blue } }
  translate <1.1, 1.5, 0>
}

// Turned twice, and clipped: the last one.
intersection {
  intersection {
    union { object { Ball pigment { Red } } object { Ball pigment { Blue } } }
    sphere { 0, 2 }
  }
  box { <-2, -2, -2>, <2, 0.4, 2> pigment { Green } }
  translate <3.1, 1.5, 0>
}
union {
  union { object { Ball pigment { Red } } object { Ball pigment { Blue } } }
  object { Ball pigment { Green } }
  clipped_by { plane { <0.5, 1, -0.3>, 0.3 } }
  translate <-3, -1, 0>
}

// Two CSGs: the one whose box rays enter first.
union {
  intersection { object { Roll pigment { Red } } box { <-0.7, -0.9, -1.5>, 0.9 pigment { Red } } }
  intersection { object { Roll pigment { Blue } } box { <-0.75, -0.95, -1.6>, 0.95 pigment { Blue } } }
  rotate 20 * y
  translate <-1, -1, 0>
}
union {
  intersection { object { Roll pigment { Red } } box { <-0.75, -0.95, -1.6>, 0.95 pigment { Red } } }
  intersection { object { Roll pigment { Blue } } box { <-0.7, -0.9, -1.5>, 0.9 pigment { Blue } } }
  rotate 20 * y
  translate <1, -1, 0>
}
// A CSG before a shape by itself.
intersection { object { Ball pigment { Red } } plane { z, 0.5 pigment { Red } } translate <3, -1, 0> }
sphere { <3, -1, 0>, 1 pigment { Blue } }
