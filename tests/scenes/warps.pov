// Every warp, and the Mandelbrot set and its kin.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -5> look_at 0 right 8*x up 6*y }
light_source { <-50, 50, -100> rgb 1 parallel point_at 0 }

#default { finish { ambient 1 diffuse 0 } }
#declare Colours = color_map { [0 rgb <1, 0, 0>] [0.3 rgb <1, 1, 0>] [0.6 rgb <0, 0.5, 1>] [1 rgb 1] }
#declare Slanted = pigment { gradient <1, 2, 3> color_map { Colours } scale 2 }
#declare Chequered = pigment { checker rgb 1 rgb x scale 0.1 }
#macro Bent(X, Y, Pigment)
  sphere { 0, 0.55 pigment { Pigment } translate <X, Y, 0> }
#end
Bent(-3.3, 2.2, pigment { Slanted warp { repeat 0.5*x flip y offset <0, 0.2, 0.1> } })
Bent(-2.2, 2.2, pigment { Slanted warp { repeat -0.3*y flip <1, 1, 0> offset <0.1, 0, 0.1> } })
Bent(-1.1, 2.2, pigment { Slanted warp { black_hole <0.2, 0.2, -0.4>, 0.6 } })
Bent(0, 2.2, pigment { Slanted warp { black_hole <0.2, 0.2, -0.4>, 0.6 strength 1.5 falloff 3 inverse } })
Bent(1.1, 2.2, pigment { Slanted warp { black_hole <0.2, 0.2, 0.2>, 0.25 repeat <0.5, 0.5, 0> turbulence <0.2, 0.3, 0.1> } })
Bent(2.2, 2.2, pigment { Slanted warp { planar z, 0.3 } })
Bent(3.3, 2.2, pigment { Chequered warp { planar y, 0.3 } })
Bent(-3.3, 1, pigment { Chequered warp { cylindrical } })
Bent(-2.2, 1, pigment { Chequered warp { cylindrical orientation x } })
Bent(-1.1, 1, pigment { Chequered warp { cylindrical dist_exp 1 } rotate 30*x })
Bent(0, 1, pigment { Chequered warp { spherical } })
Bent(1.1, 1, pigment { Chequered warp { spherical orientation y dist_exp 1 } })
Bent(2.2, 1, pigment { Chequered warp { toroidal } })
Bent(3.3, 1, pigment { Chequered warp { toroidal major_radius 0.5 orientation z dist_exp 0.5 } })
Bent(-3.3, -0.2, pigment { Chequered warp { repeat 0.35*x } warp { turbulence 0.3 } warp { spherical } })

#macro Wrinkled(X, Normal)
  sphere { 0, 0.55 pigment { rgb 1 } finish { ambient 0 diffuse 1 } normal { Normal } translate <X, -0.2, 0> }
#end
Wrinkled(-2.2, normal { bumps 0.7 scale 0.2 warp { repeat 0.35*x flip x } })
Wrinkled(-1.1, normal { gradient <1, 1, 0.2> 0.7 scale 0.2 warp { spherical } })
Wrinkled(0, normal { gradient <1, 1, 0.2> 0.7 scale 0.2 warp { black_hole <0, 0, -0.6>, 0.5 } })

#macro Panel(X, Y, Fractal)
  box { <-0.52, -0.52, 0>, <0.52, 0.52, 0.1> pigment { Fractal color_map { Colours } } translate <X, Y, 0> }
#end
Panel(1.1, -0.2, pigment { mandel 12 scale 0.3 translate 0.15*x })
Panel(2.2, -0.2, pigment { julia <0.353, 0.288>, 8 scale 0.4 })
Panel(3.3, -0.2, pigment { mandel 9 exponent 4 scale 0.4 })
Panel(-3.3, -1.4, pigment { magnet 1 mandel 8 scale 0.15 translate -0.2*x })
Panel(-2.2, -1.4, pigment { magnet 2 mandel 8 scale 0.15 translate -0.2*x })
Panel(-1.1, -1.4, pigment { magnet 1 julia <0.3, 0.2>, 8 interior 1, 1 scale 0.2 })
Panel(0, -1.4, pigment { mandel 8 exterior 4, 0.05 interior 1, 1 scale 0.3 })
Panel(1.1, -1.4, pigment { julia <0.2, 0.3>, 6 exponent 3 exterior 2, 0.1 interior 3, 0.7 scale 0.3 })
Panel(2.2, -1.4, pigment { mandel 6 exterior 0, 0.3 interior 6, 0.5 scale 0.3 })
