// Patterns that are made of others: how bright a pigment is, what is inside of an object; and lists with waves.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -20> look_at 0 right 16*x up 12*y }
background { rgb <0.1, 0.12, 0.15> }
light_source { <-20, 30, -40> rgb 1 }
light_source { <30, 10, -30> rgb 0.3 shadowless }

#declare Colours = color_map { [0 rgb <0.9, 0.3, 0.2>] [0.4 rgb <0.95, 0.85, 0.6>] [0.7 rgb <0.2, 0.5, 0.6>] [1 rgb <0.1, 0.1, 0.3>] }
#declare Turn = transform { rotate <12, 17, 23> translate <0.13, 0.21, 0.34> }
#declare Stone = texture { pigment { rgb <0.8, 0.8, 0.75> } finish { phong 0.5 } }
#declare Shiny = texture { pigment { rgb <0.9, 0.6, 0.2> } finish { phong 1 reflection 0.2 } }

#macro Place(Number)
  translate <mod(Number, 7)*2.25 - 6.75, 4.5 - div(Number, 7)*2.9, 0>
#end
#macro Both(Number, Coloured, Bumpy)
  union {
    sphere { <-0.5, 0.6, 0>, 0.543 texture { pigment { Coloured scale 0.35 transform Turn } } }
    box { <-1.053, -0.917, -0.2>, <0.047, -0.063, 0.2> texture { pigment { Coloured scale 0.3 } } rotate 15*y }
    sphere { <0.6, 0, 0>, 0.493 texture { Stone normal { Bumpy scale 0.3 transform Turn } } }
    Place(Number)
  }
#end
#macro Textured(Number, Look)
  sphere { 0, 0.97 texture { Look scale 0.35 transform Turn } Place(Number) }
#end

// Pigments.
#declare Rings = pigment { onion color_map { [0 rgb <0.2, 0.9, 0.4>] [0.5 rgb <1, 0.2, 0.7>] [1 rgb <0.2, 0.9, 0.4>] } }
#declare Mixed = pigment { average pigment_map { [1 Rings] [2 gradient <1, 2, 0.3> triangle_wave] [0.5 leopard scale 0.2] } }
Both(0, pigment { pigment_pattern { Rings } color_map { Colours } }, normal { pigment_pattern { Rings } 0.8 })
Both(1, pigment { pigment_pattern { Mixed } color_map { Colours } frequency 3 sine_wave }, normal { pigment_pattern { Mixed } 1.5 frequency 2 triangle_wave })
Both(2, pigment { pigment_pattern { checker pigment { Rings scale 0.5 } pigment { wood turbulence 0.1 } translate 0.2 } pigment_map { [0.1 Rings] [0.6 rgb 1] } turbulence 0.3 },
  normal { pigment_pattern { bozo color_map { [0 rgb 0] [0.5 rgb 1] [1 rgb x] } scale 0.7 turbulence 0.4 } normal_map { [0.2 onion 0.7 sine_wave] [0.8 bumps 0.9 scale 0.4] } scale 1.3 })
Both(3, pigment { gradient y pigment_map { [0 rgb y] [0.4 pigment_pattern { pigment_pattern { marble turbulence 0.5 } color_map { [0 rgb 1] [1 rgb 0.2] } } color_map { Colours }] [1 rgb 1] } triangle_wave },
  normal { pigment_pattern { rgb 0.5 } 1 })
Textured(4, texture { pigment_pattern { Mixed scale 2 } texture_map { [0.3 Stone] [0.6 Shiny] } })
Textured(5, texture { pigment_pattern { pigment_pattern { leopard scale 0.3 } color_map { [0 rgb 0] [0.5 rgb 1] } rotate 20*z } texture_map { [0.3 Shiny] [0.7 pigment_pattern { Rings } texture_map { [0 Stone] [1 Shiny] } ] } })
sphere { 0, 0.97 texture { uv_mapping pigment { pigment_pattern { checker rgb 1, rgb 0.3 scale 0.1 } color_map { Colours } } } Place(6) }

// Objects.
#declare Ball = sphere { 0, 1 }
#declare Part = difference {
  merge { box { -1, <0.4, 1, 1> } sphere { x*0.6, 0.8 } }
  cylinder { -2*z, 2*z, 0.4 }
  torus { 0.9, 0.2 rotate 90*x }
}
// Where the spheres of a cell are, as the patterns see it.
#declare Left = transform { scale 1.5 translate <-1.7, 0.2, -1.6> }
#declare Right = transform { translate <1.8, -0.3, -2.6> }
Both(7, pigment { object { Ball scale 1.3 transform Left rgb <0.9, 0.4, 0.2>, rgb <0.2, 0.4, 0.9> } }, normal { object { Ball transform Right } 0.8 })
Both(8, pigment { object { Part scale 1.4 transform Left rgb <0.9, 0.9, 0.2>, rgb <0.7, 0.2, 0.4> } turbulence 0.2 }, normal { object { Part transform Right normal { bumps 0.7 scale 0.3 } normal { onion 0.5 sine_wave } } })
Both(9, pigment { object { object { cone { -y, 1.1, y*2, 0.1 inverse } rotate 30*z transform Left } pigment { Rings }, pigment { object { Ball scale 0.9 rgb 0, rgb 1 } warp { repeat x*1.2 } warp { repeat y*1.2 } } } },
  normal { object { quadric { <1, -1, 1>, 0, 0, -0.3 } transform Right } 1 })
Textured(10, texture { object { Part scale 2 translate -z texture { Stone } texture { Shiny } } })
Textured(11, texture { object { union { object { Ball scale 1.7 translate -2*z } plane { x, -1 } } texture { object { Part scale 1.6 translate -2*z texture { Shiny } texture { Stone } } } texture { pigment { Rings } } } })
box { -0.85, 0.85 texture { pigment { pigment_pattern { object { Part rgb 0.2, rgb 0.9 } turbulence 0.3 scale 0.7 } color_map { Colours } } } rotate <20, 30, 0> Place(12) }
sphere { 0, 0.97 texture { pigment { object { intersection { object { Ball scale 2.5 } plane { y, 0.3 } box { -0.6, 2 } } rgb <0.3, 0.8, 0.4> rgbt <0.9, 0.3, 0.3, 0.8> } } } Place(13) }

// Lists.
Both(14, pigment { checker rgb <0.9, 0.4, 0.2>, rgb <0.2, 0.4, 0.9> frequency 0.3 phase 0.2 }, normal { checker 0.5 sine_wave frequency 0.3 })
Both(15, pigment { hexagon rgb x, rgb y, rgb z frequency 0.4 cubic_wave }, normal { hexagon 0.5 frequency 0.4 cubic_wave })
Both(16, pigment { cubic rgb x, rgb y, rgb z, rgb 1, rgb 0.3, rgb <1, 0.6, 0> poly_wave 0.7 rotate 30*x }, normal { cubic 0.5 poly_wave 0.5 })
Both(17, pigment { square pigment { Rings }, pigment { rgb y }, pigment { rgb z }, pigment { Mixed } triangle_wave frequency 0.35 }, normal { square normal { bumps 0.8 scale 0.2 }, normal { onion 0.6 sine_wave }, normal { gradient x sine_wave } normal { dents } frequency 0.3 })
Both(18, pigment { triangular rgb x, rgb y, rgb z, rgb 1, rgb 0.3, rgb <1, 0.6, 0> frequency 0.15 phase 0.4 }, normal { triangular 0.4 frequency 0.15 scallop_wave })
Both(19, pigment { brick rgb 0.8, rgb <0.6, 0.2, 0.15> brick_size <2, 0.8, 1.2> mortar 0.1 frequency 0.6 }, normal { brick 0.6 brick_size <2, 0.8, 1.2> mortar 0.1 frequency 0.6 })
Textured(20, texture { checker texture { Stone } texture { Shiny } frequency 0.4 phase 0.1 })
Both(21, pigment { object { Part scale 1.4 transform Left rgb 0.2, rgb <0.9, 0.8, 0.5> } frequency 0.3 sine_wave }, normal { object { Ball transform Right } 0.5 frequency 0.7 })
Both(22, pigment { checker rgb 0.2, rgb <0.9, 0.8, 0.5> phase 0.5 sine_wave }, normal { checker 0.5 phase 0.3 })
Both(23, pigment { cubic rgb x, rgb y, rgb z, rgb 1, rgb 0.3, rgb <1, 0.6, 0> cubic_wave rotate 30*x }, normal { bumps 0.4 scale 0.3 })
