// A sphere and a panel of every pattern, as a colour and as a normal.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -20> look_at 0 right 16*x up 12*y }
background { rgb <0.1, 0.12, 0.15> }
light_source { <-20, 30, -40> rgb 1 }
light_source { <30, 10, -30> rgb 0.3 shadowless }

#declare Colours = color_map { [0 rgb <0.9, 0.3, 0.2>] [0.4 rgb <0.95, 0.85, 0.6>] [0.7 rgb <0.2, 0.5, 0.6>] [1 rgb <0.1, 0.1, 0.3>] }
#declare Turn = transform { rotate <12, 17, 23> translate <0.13, 0.21, 0.34> }
#declare Stone = texture { pigment { rgb <0.8, 0.8, 0.75> } finish { phong 0.5 } }

#macro Place(Number)
  #local Column = mod(Number, 7);
  #local Row = div(Number, 7);
  translate <Column*2.25 - 6.75, 4.5 - Row*2.9, 0>
#end
#macro Both(Number, Coloured, Bumpy)
  union {
    sphere { <-0.5, 0.6, 0>, 0.543 texture { pigment { Coloured scale 0.35 transform Turn } } }
    box { <-1.053, -0.917, -0.2>, <0.047, -0.063, 0.2> texture { pigment { Coloured scale 0.3 } } rotate 15*y }
    sphere { <0.6, 0, 0>, 0.493 texture { Stone normal { Bumpy scale 0.3 transform Turn } } }
    Place(Number)
  }
#end

Both(0, pigment { boxed color_map { Colours } scale 4 }, normal { boxed 2 scale 4 })
Both(1, pigment { spherical color_map { Colours } scale 4 }, normal { spherical 2 scale 4 })
Both(2, pigment { cylindrical color_map { Colours } scale 4 }, normal { cylindrical 2 scale 4 })
Both(3, pigment { planar color_map { Colours } scale 4 }, normal { planar 2 scale 4 })
Both(4, pigment { onion color_map { Colours } }, normal { onion 0.6 sine_wave })
Both(5, pigment { leopard color_map { Colours } scale 0.3 }, normal { leopard 1.5 scale 0.3 })
Both(6, pigment { radial color_map { Colours } frequency 5 }, normal { radial 0.8 frequency 5 sine_wave })
Both(7, pigment { spiral1 3 color_map { Colours } }, normal { spiral1 3 0.5 })
Both(8, pigment { spiral2 4 color_map { Colours } }, normal { spiral2 4 0.4 })
Both(9, pigment { quilted control0 0.3 control1 0.8 phase 0.4 color_map { Colours } }, normal { quilted 1 control0 0.3 control1 0.8 })
Both(10, pigment { square pigment { rgb x }, pigment { rgb y }, pigment { rgb z }, pigment { rgb 1 } }, normal { gradient z 0.8 triangle_wave })
Both(11, pigment { triangular pigment { rgb x }, pigment { rgb y }, pigment { rgb z }, pigment { rgb 1 }, pigment { rgb 0.3 }, pigment { rgb <1, 0.6, 0> } }, normal { cylindrical 1 scale 2 })
Both(12, pigment { hexagon rgb <0.9, 0.4, 0.2>, rgb <0.9, 0.9, 0.7>, rgb <0.2, 0.4, 0.6> }, normal { hexagon 0.4 })
Both(13, pigment { cubic pigment { rgb x }, pigment { rgb y }, pigment { rgb z }, pigment { rgb 1 }, pigment { rgb 0.3 }, pigment { rgb <1, 0.6, 0> } rotate 30*x }, normal { planar 1 triangle_wave })
Both(14, pigment { brick rgb 0.8, rgb <0.6, 0.2, 0.15> brick_size <2, 0.8, 1.2> mortar 0.1 }, normal { brick 0.6 brick_size <2, 0.8, 1.2> mortar 0.1 })
Both(15, pigment { dents color_map { Colours } scale 0.4 }, normal { dents 1.5 scale 0.5 })
Both(16, pigment { granite color_map { Colours } scale 2 }, normal { granite 0.4 scale 2 })
Both(17, pigment { wrinkles color_map { Colours } scale 0.6 }, normal { wrinkles 0.8 scale 0.7 })
Both(18, pigment { agate agate_turb 0.6 color_map { Colours } }, normal { agate 0.6 })
Both(19, pigment { marble turbulence 0.8 color_map { Colours } }, normal { marble 0.7 turbulence 0.5 })
Both(20, pigment { wood turbulence 0.1 color_map { Colours } }, normal { wood 0.8 turbulence 0.05 })
Both(21, pigment { bozo turbulence 0.6 color_map { Colours } scale 0.5 }, normal { bozo 1 scale 0.5 })
Both(22, pigment { checker rgb 0.2, rgb <0.9, 0.8, 0.5> }, normal { checker 0.5 })
Both(23, pigment { gradient <1, 2, 0.5> color_map { Colours } poly_wave 1.7 }, normal { bumps 0.8 scale 0.4 })
