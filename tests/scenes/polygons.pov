// Polygons: open and closed, with holes and lines that cross, with many corners, textured, turned, in CSG and clipped.
#version 3.7;
global_settings { assumed_gamma 1 }
background { rgb <0.2, 0.25, 0.35> }
camera { location <0, 3, -9> look_at <0, 1, 0> angle 50 }
light_source { <6, 9, -8> rgb 0.9 }
light_source { <-8, 4, -5> rgb <0.2, 0.25, 0.3> }
#default { finish { ambient 0.1 diffuse 0.8 } }

polygon { 4, <-9, 0, -6>, <9, 0, -6>, <9, 0, 9>, <-9, 0, 9> pigment { checker rgb 0.5 rgb 0.9 } }
polygon {
  10, <-1, 0>, <1, 0>, <1, 2>, <-1, 2>, <-1, 0>, <-0.5, 0.5>, <0.5, 0.5>, <0.5, 1.5>, <-0.5, 1.5>, <-0.5, 0.5>
  pigment { rgb <0.9, 0.5, 0.2> } finish { phong 0.5 } rotate 25*y translate <-3.2, 0, 0>
}
polygon {
  6, <0, 1.8>, <1, -1.5>, <-1.7, 0.6>, <1.7, 0.6>, <-1, -1.5>, <0, 1.8>
  pigment { gradient y color_map { [0 rgb <1, 0.2, 0.2>] [1 rgb <0.2, 0.4, 1>] } scale 2 } scale 0.8 translate <-0.8, 1.6, 1>
}
#declare Corners = 60;
#declare Wheel = polygon {
  2*Corners
  #for (I, 0, Corners - 1)
    #local R = (I = 0 | I = Corners - 1 ? 1 : 0.85 + 0.15*cos(I*pi));
    <R*cos(2*pi*I/(Corners - 1)), R*sin(2*pi*I/(Corners - 1))*(I < Corners - 1)>
  #end
  #for (I, 0, Corners - 1)
    <0.6*cos(2*pi*I/(Corners - 1)), 0.5*sin(2*pi*I/(Corners - 1))*(I < Corners - 1)>
  #end
}
object { Wheel pigment { rgbf <0.6, 0.9, 0.7, 0.6> } rotate <10, -30, 0> translate <1.6, 1.2, -1> }
object { Wheel pigment { rgb <0.4, 0.8, 0.5> } finish { reflection 0.3 } scale <1, 0.6, 1> rotate <70, 0, 20> translate <3, 0.6, 1> }
intersection {
  polygon { 3, <-1, 0, 0>, <1, 0, 0>, <0, 2, 0> pigment { rgb <0.9, 0.9, 0.3> } }
  sphere { <0, 0.8, 0>, 0.7 pigment { rgb <0.9, 0.1, 0.1> } }
  translate <0.2, 0, -2.5>
}
merge {
  box { <-0.4, 0, -0.4>, <0.4, 0.8, 0.4> pigment { rgb <0.7, 0.4, 0.8> } }
  polygon { 3, <-1, 0.4, 0>, <1, 0.4, 0>, <0, 0.4, 1.2> pigment { rgb <0.3, 0.8, 0.9> } }
  translate <-2.2, 0, -2>
}
polygon {
  3, <0, 0>, <2, 0>, <1, 2> pigment { rgb <0.8, 0.3, 0.6> } clipped_by { cylinder { <1, 0.7, -1>, <1, 0.7, 1>, 0.6 inverse } }
  rotate <0, -40, 0> translate <3.2, 0.1, -2>
}
