// The camera is in a box, as in a room: what is seen of its inside where floor and ceiling are in other planes too.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 5, -9.5> look_at <0, 4.5, 0> angle 80 }
light_source { <1, 9, -4> rgb 0.9 }
#default { finish { ambient 0.2 } }

box { <-7, 0, -10>, <7, 10, 4> pigment { rgb <0.9, 0.85, 0.7> } }
plane { y, 0 pigment { checker rgb <0.3, 0.3, 0.8> rgb <0.5, 0.5, 0.9> } }
box { <-3, 10, -2>, <3, 10.5, 3> pigment { rgb <0.8, 0.4, 0.3> } }
box { <2, 0, 0>, <4, 2, 2> pigment { rgb <0.3, 0.7, 0.4> } rotate 10*y }
sphere { <-3, 1.5, 0>, 1.5 pigment { rgb 0.8 } finish { reflection 0.4 } }
