// Many tori that mirror each other: reflected rays scatter, so that few of a packet come near the same one.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 3 }

camera { location <0, 3, -9> look_at 0 angle 40 }
light_source { <-6, 9, -7>, 0.9 }
light_source { <8, 5, -3>, 0.4 }
background { rgb <0.25, 0.35, 0.5> }

#declare Mirror = texture {
  pigment { rgb <0.8, 0.7, 0.5> }
  finish { ambient 0.1 diffuse 0.5 reflection 0.4 }
}

// Around one centre, so that rays come to the bounds of most of them; thin and thick ones by turns.
#for (I, 0, 39)
  torus {
    1 + 0.02 * I, 0.03 + 0.06 * mod(I, 3)
    texture { Mirror }
    rotate <31 * I, 0, 47 * I>
    translate <0.4 * sin(I), 0.4 * cos(2 * I), 0.4 * sin(3 * I)>
  }
#end
plane { y, -2.2 pigment { checker rgb 0.9, rgb 0.3 } finish { ambient 0.1 diffuse 0.7 } }
