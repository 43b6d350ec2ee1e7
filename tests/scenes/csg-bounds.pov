// CSG whose extent only its parts together have: slanted planes, and quadrics that something else ends.
#version 3.7;
global_settings { assumed_gamma 1 }

camera { location <0, 5, -13> right 4/3*x look_at <0, 0.2, 0> angle 42 }
light_source { <-20, 30, -25> rgb 1 }
background { rgb <0.2, 0.25, 0.35> }

// A dodecahedron, and one that hardly misses its lower corners.
#declare Dodecahedron = intersection {
  plane { y, 1 }
  plane { -y, 1 }
  #declare I = 0;
  #while (I < 5)
    plane { -z, 1 rotate -26.56505117708*x rotate I*72*y }
    plane { -z, 1 rotate 26.56505117708*x rotate (I*72 + 36)*y }
    #declare I = I + 1;
  #end
}
object { Dodecahedron rotate 10*y translate <-3.4, 0.2, 0> pigment { rgb <0.9, 0.5, 0.2> } }
difference {
  object { Dodecahedron }
  plane { <0.3, 1, 0.2>, -0.4 }
  pigment { rgb <0.9, 0.8, 0.3> }
  translate <-1, 0.2, 2.5>
}

// Corners that reach to infinity: three planes, and four of which one changes nothing.
intersection {
  plane { <0.2, 1, -0.1>, -1.3 }
  plane { <1, 0.1, 0.4>, 0.5 }
  plane { <-0.3, 0.2, -1>, 2 }
  plane { <0.2, 1, -0.1>, 4 }
  pigment { checker rgb 0.4 rgb 0.8 }
}

// Quadrics without an end of their own, along both directions of their axis.
#declare Pipe = intersection {
  quadric { <1, 1, 0>, 0, 0, -0.4 }
  box { -1.3, 1.3 }
}
object { Pipe rotate 90*x translate <1.1, 0.6, 1> pigment { rgb <0.3, 0.7, 0.5> } }
object { Pipe rotate -90*x translate <2.2, -0.6, -2> pigment { rgb <0.3, 0.5, 0.8> } }
difference {
  sphere { <3.8, 0.3, 0>, 1.2 }
  quadric { <1, 0, 1>, 0, 0, -0.3 translate <3.8, 0, -0.4> }
  pigment { rgb <0.8, 0.3, 0.4> }
}

// A pyramid of slanted planes with a hole, inverse in part.
intersection {
  plane { <1, 0.7, 0>, 0.6 }
  plane { <-1, 0.7, 0>, 0.6 }
  plane { <0, 0.7, 1>, 0.6 }
  plane { <0, 0.7, -1>, 0.6 }
  plane { <0.1, 1, 0>, -0.6 inverse }
  cylinder { -2*z, 2*z, 0.25 inverse }
  translate <4, 1.8, 3>
  pigment { rgb <0.6, 0.6, 0.9> }
}
