// Patterns and normals of random points and waves, noise of generator 3, and heights by slope maps.
#version 3.7;
global_settings { assumed_gamma 1 number_of_waves 7 }
camera { orthographic location <0, 0, -5> look_at 0 right 8*x up 6*y }
light_source { <-50, 50, -100> rgb 1 parallel point_at 0 }

#default { finish { ambient 1 diffuse 0 } }
#macro Coloured(X, Y, Pigment)
  sphere { 0, 0.7 pigment { Pigment } translate <X, Y, 0> }
#end
Coloured(-3, 2, pigment { crackle scale 0.3 })
Coloured(-1.5, 2, pigment { crackle form <1, 0, 0> scale 0.3 })
Coloured(0, 2, pigment { crackle form <-1, 0.5, 0.3> metric 1 scale 0.3 })
Coloured(1.5, 2, pigment { crackle form <1, 0, 0> metric 3 offset 0.2 scale 0.3 })
Coloured(3, 2, pigment { crackle solid scale 0.3 })
Coloured(-3, 0.5, pigment { crackle turbulence 0.3 scale 0.2 translate 100 })
Coloured(-1.5, 0.5, pigment { cells scale 0.1 translate 0.03 })
Coloured(0, 0.5, pigment { waves scale 0.1 })
Coloured(1.5, 0.5, pigment { ripples scale 0.1 frequency 2 phase 0.3 })
Coloured(3, 0.5, pigment { crackle solid noise_generator 3 scale 0.2 })
Coloured(-3, -1, pigment { bozo noise_generator 3 scale 0.2 })
Coloured(-1.5, -1, pigment { granite noise_generator 3 })
Coloured(0, -1, pigment { agate noise_generator 3 scale 0.5 })
Coloured(1.5, -1, pigment { marble turbulence 0.6 noise_generator 3 scale 0.2 })
Coloured(3, -1, pigment { wrinkles noise_generator 3 scale 0.3 })

#default { pigment { rgb 1 } finish { ambient 0 diffuse 1 } }
#declare Steps = slope_map { [0.1 <0, 1>] [0.5 <0.5, 1>] [0.5 <0.7, 0>] [0.9 <0.2, -1>] }
#macro Bumpy(X, Normal)
  sphere { 0, 0.55 normal { Normal } translate <X, -2.4, 0> }
#end
Bumpy(-3.3, normal { crackle 1 scale 0.3 })
Bumpy(-2.2, normal { waves 1 scale 0.1 })
Bumpy(-1.1, normal { ripples 1 scale 0.1 })
Bumpy(0, normal { facets coords 0.5 scale 3 })
Bumpy(1.1, normal { dents 1 noise_generator 3 scale 0.1 })
Bumpy(2.2, normal { bozo 0.7 triangle_wave frequency 2 slope_map { Steps } scale 0.5 })
Bumpy(3.3, normal { gradient x 1 slope_map { Steps } scale 0.4 })
#macro Faceted(X, Y, Normal)
  object { sphere { 0, 0.35 } normal { Normal } translate <X, Y, 0> }
#end
Faceted(-0.75, 1.25, normal { facets size 0.3 })
Faceted(0.75, 1.25, normal { facets size 0.8 rotate <20, 50, 0> scale <1, 2, 0.7> })
