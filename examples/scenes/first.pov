// The first picture: a mirror, a glass ball and a crystal among a spiral of beads, on a chequered floor.
// Everything is a sphere or a triangle.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }

#declare Evening = rgb <0.34, 0.45, 0.66>;
background { color Evening }

camera {
  location <0.4, 3.1, -8.2>
  right x*image_width/image_height
  look_at <0.1, 0.75, 0.4>
  angle 42
}

light_source { <-7, 11, -6> color rgb <1.15, 1.05, 0.9> }
light_source { <8, 5, -7> color rgb <0.18, 0.22, 0.32> shadowless }

// The floor: two meshes of squares, each square two triangles.
#declare Squares = 16;
#macro Floor(Parity)
  mesh {
    #for (I, -Squares, Squares - 1)
      #for (J, -Squares, Squares - 1)
        #if (mod(I + J + 2*Squares, 2) = Parity)
          triangle { <I, 0, J>, <I + 1, 0, J>, <I + 1, 0, J + 1> }
          triangle { <I, 0, J>, <I + 1, 0, J + 1>, <I, 0, J + 1> }
        #end
      #end
    #end
    scale 0.8
  }
#end
object { Floor(0) pigment { color rgb <0.86, 0.83, 0.76> } finish { diffuse 0.75 reflection 0.06 } }
object { Floor(1) pigment { color rgb <0.10, 0.13, 0.20> } finish { diffuse 0.75 reflection 0.14 } }

// The mirror.
sphere {
  <-1.55, 1.2, 1.1>, 1.2
  pigment { color rgb <0.95, 0.95, 0.97> }
  finish { ambient 0 diffuse 0.06 specular 0.7 roughness 0.004 reflection 0.86 }
}

// The glass ball.
sphere {
  <1.25, 0.8, -1.0>, 0.8
  pigment { color rgbf <0.96, 1, 0.98, 0.94> }
  finish { ambient 0 diffuse 0.02 specular 0.8 roughness 0.002 reflection { 0.03, 0.7 falloff 4 } }
  interior { ior 1.5 }
}

// The crystal: a six-sided bipyramid of flat triangles.
#declare Crystal = mesh {
  #for (I, 0, 5)
    #declare A = vrotate(0.62*x, 60*I*y);
    #declare B = vrotate(0.62*x, 60*(I + 1)*y);
    triangle { A, B, 1.35*y }
    triangle { A, B, -0.75*y }
  #end
}
object {
  Crystal
  rotate <0, 17, -9>
  translate <1.75, 0.92, 1.9>
  pigment { color rgb <0.75, 0.12, 0.20> }
  finish { ambient 0.08 diffuse 0.55 phong 0.6 phong_size 60 reflection 0.22 }
}

// The beads, from warm to cold along a spiral.
#declare Beads = 34;
union {
  #for (I, 0, Beads - 1)
    #declare T = I/(Beads - 1);
    #declare R = 0.11 + 0.13*T;
    sphere {
      vrotate(<0.55 + 2.75*T, R, 0>, (200 + 760*T)*y), R
      pigment { color rgb <1 - 0.85*T, 0.30 + 0.35*sin(pi*T), 0.12 + 0.75*T> }
      finish { ambient 0.08 diffuse 0.65 specular 0.6 roughness 0.015 reflection 0.08 }
    }
  #end
  translate <0, 0, -0.6>
}
