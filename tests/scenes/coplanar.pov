// Faces in one plane: of boxes that overlap, or are parts of an intersection, of a box in a plane, of glass on a plane, in a wall that is turned.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 5, -8> look_at <0, 0.3, 0> angle 45 }
light_source { <-6, 10, -9> rgb 1 }
background { rgb <0.3, 0.4, 0.6> }

#declare Numbers = seed(7);
#macro Colour() pigment { rgb <rand(Numbers), rand(Numbers), rand(Numbers)> } #end

// Overlapping tops, as of planks that cross.
#declare I = 0;
#while (I < 4)
  box { <-3, 0, -1.5 + I>, <0.3, 0.4, -1 + I> Colour() }
  box { <-2.6 + 0.8 * I, 0, -1.8>, <-2.2 + 0.8 * I, 0.4, 2.1> Colour() }
  #declare I = I + 1;
#end

// A lid in the floor.
plane { y, 0 pigment { checker rgb 0.9 rgb 0.6 } }
box { <0.8, -1, -2.5>, <2.2, 0, -1.1> Colour() }

// Glass on the floor.
box { <0.8, 0, 0.2>, <1.8, 0.8, 1.2> pigment { rgbf <0.8, 1, 0.9, 0.9> } interior { ior 1.2 } }

// What boxes have in common, with faces of both.
intersection {
  box { <-3.5, 0, -3>, <-2.25, 1, -2> Colour() }
  box { <-3, -1, -3>, <-2, 1.5, -1.5> Colour() }
  box { <-3.25, 0.25, -3>, <-2, 1.25, -1.5> Colour() }
}
intersection {
  box { <-0.875, 0.125, -3>, <0.25, 0.5, -2.5> Colour() }
  box { <-1.25, 0, -3>, <-0.25, 0.75, -2> Colour() }
}

// Bricks that overlap in a wall.
union {
  box { <-1.5, 0, 0>, <0.3, 0.5, 0.3> Colour() }
  box { <-0.2, 0.2, 0>, <1.5, 0.7, 0.5> Colour() }
  rotate 20 * y
  translate <2.2, 0, 3>
}

// Glass that stands in a niche, which is cut out.
difference {
  box { <-1.4, 0, 2.2>, <0.6, 1.2, 3.2> }
  box { <-1.2, 0.2, 2>, <0.4, 1, 3> }
  pigment { rgb <0.5, 0.45, 0.4> }
}
cone { <-0.7, 0.2, 2.5>, 0.3, <-0.7, 0.8, 2.5>, 0.1 pigment { rgbf <0.9, 0.9, 1, 0.9> } interior { ior 1.2 } }
box { <-0.2, 0.2, 2.3>, <0.2, 0.6, 2.7> pigment { rgbf <1, 0.8, 0.8, 0.8> } }
