// Shapes of many parts: prisms, lathes, surfaces of revolution, blobs and polynomials, alone and in CSG.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -7> look_at <0, 0.2, 0> angle 50 }
light_source { <5, 10, -10> rgb 1 }
light_source { <-8, 4, -4> rgb 0.4 shadowless }
plane { y, -1.2 pigment { checker rgb 0.8, rgb 0.4 } }

#declare Shiny = finish { phong 0.5 }

prism {
  linear_sweep linear_spline 0, 1, 10, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>, <-1, -1>, <-0.5, -0.5>, <0.5, -0.5>,
  <0.5, 0.5>, <-0.5, 0.5>, <-0.5, -0.5>
  pigment { rgb <1, 0.5, 0.2> } finish { Shiny } scale 0.5 rotate <-30, 30, 0> translate <-2.6, 1.4, 0>
}
prism {
  cubic_spline 0, 0.6, 7, <0, -1>, <-1, 0>, <0, 1>, <1, 0>, <0, -1>, <-1, 0>, <0, 1>
  pigment { rgb <1, 0.7, 0.3> } finish { Shiny } scale 0.6 rotate -60*x translate <-1.2, 1.5, 0>
}
prism {
  conic_sweep quadratic_spline 0.2, 1, 6, <0, -1>, <1, 0>, <0, 1>, <-1, 0>, <0, -1>, <1, 0>
  pigment { rgb <0.9, 0.9, 0.3> } finish { Shiny } rotate 180*x scale 0.7 translate <0.2, 2, 0>
}
difference {
  prism {
    bezier_spline 0, 0.8, 8, <-1, 0>, <-1, 1>, <1, 1>, <1, 0>, <1, 0>, <1, -1>, <-1, -1>, <-1, 0>
    pigment { rgb <0.8, 0.4, 0.4> } finish { Shiny }
  }
  cylinder { -y, 2*y, 0.5 pigment { rgb <0.2, 0.5, 1> } }
  scale 0.7 rotate -40*x translate <1.6, 1.4, 0>
}
lathe {
  linear_spline 5, <0, -1>, <0.6, -0.8>, <0.2, 0>, <0.7, 0.8>, <0, 1>
  pigment { rgb <0.4, 0.8, 0.5> } finish { Shiny reflection 0.2 } scale 0.8 translate <-2.6, -0.4, -1>
}
lathe {
  cubic_spline 7, <0, -1.2>, <0.3, -1>, <0.8, -0.6>, <0.3, 0>, <0.6, 0.6>, <0.2, 1>, <0, 1.2>
  pigment { rgb <0.4, 0.8, 0.8> } finish { Shiny } scale 0.8 translate <-1.3, -0.4, -1>
}
intersection {
  sor {
    7, <0, -1>, <0.4, -0.9>, <0.6, -0.5>, <0.2, 0.1>, <0.3, 0.6>, <0.1, 1>, <0, 1.1>
    pigment { rgb <0.9, 0.5, 0.7> } finish { Shiny }
  }
  plane { -x, 0.1 pigment { rgb 1 } }
  rotate -20*y translate <-0.1, -0.3, -1.5>
}
blob {
  threshold 0.6 sphere { <0.75, 0, 0>, 1, 1 } sphere { <-0.375, 0.65, 0>, 1, 1 }
  sphere { <-0.375, -0.65, 0>, 1, strength 1 scale <1, 1, 0.7> }
  pigment { rgb <0.8, 0.8, 0.3> } finish { Shiny reflection 0.2 } scale 0.7 translate <1.2, -0.4, -1.4>
}
blob {
  threshold 0.5 cylinder { <-1, 0, 0>, <1, 0, 0>, 0.6, 1 } cylinder { <0, -1, 0>, <0, 1, 0>, 0.5, 1 }
  component -1.5 0.7 <0, 0, 0>
  pigment { rgbt <0.5, 0.8, 0.9, 0.3> } finish { Shiny } scale 0.7 translate <2.7, -0.3, -0.6>
}
quartic {
  <1, 0, 0, 0, 2, 0, 0, 2, 0, -1.25, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, -1.25, 0, 0, 0, 0, 1, 0, 0.75, 0, 0.140625>
  pigment { rgb <0.6, 0.5, 1> } finish { Shiny } scale 0.7 rotate -30*x translate <0.2, -0.8, -3.4>
}
poly {
  3, <1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, -0.3>
  clipped_by { sphere { 0, 1 } } pigment { rgb <0.6, 0.9, 0.6> } finish { Shiny } translate <3, 1.5, 0>
}
