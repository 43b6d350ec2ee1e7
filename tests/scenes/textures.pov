// Every way to make a texture: lists, blends and noise as colours and as normals, nested maps, averages,
// layers, waves, turbulence, and a sky around it all.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 6 }
camera { location <0, 5, -13> look_at <0, 1.2, 0> angle 52 right x*4/3 }
light_source { <-20, 30, -25> rgb <1, 0.95, 0.9> }
light_source { <15, 12, -10> rgb 0.3 shadowless }

sky_sphere {
  pigment { gradient y color_map { [0 rgb <0.9, 0.75, 0.6>] [0.35 rgb <0.35, 0.5, 0.85>] [1 rgb <0.1, 0.2, 0.5>] } }
  pigment {
    bozo turbulence 0.7 scale <0.4, 0.15, 0.4>
    color_map { [0.45 rgbt <1, 1, 1, 1>] [0.8 rgbt <1, 1, 1, 0.2>] }
  }
}

#declare Stripes = pigment { gradient x color_map { [0.5 rgb <0.9, 0.2, 0.1>] [0.5 rgb <0.95, 0.9, 0.8>] } scale 0.4 }
#declare Clouds = pigment {
  bozo turbulence 0.4 octaves 4 lambda 2.3 omega 0.6
  color_map { [0 rgb <0.1, 0.15, 0.4>] [0.4 rgb <0.2, 0.5, 0.7>] [1 rgb <1, 0.95, 0.8>] }
  scale 0.45
}
#declare Plain = texture { pigment { rgb <0.85, 0.7, 0.4> } finish { ambient 0.1 diffuse 0.7 phong 0.6 } }
#declare Shine = texture { pigment { rgb <0.2, 0.25, 0.3> } finish { ambient 0.05 diffuse 0.4 specular 0.7 reflection 0.4 } }

box {
  <-8, -1, -6>, <8, 0, 6>
  pigment { checker pigment { Stripes rotate 30*y scale 2 }, pigment { rgb <0.5, 0.55, 0.5> } scale 1.7 }
  finish { ambient 0.1 diffuse 0.8 }
}

#macro Ball(Column, Row)
  sphere { 0, 1 scale 0.95 translate <Column*2.2 - 5.5, 1 + Row*2.1, Row*1.5 - 1> }
#end

object { Ball(0, 0) texture { pigment { Stripes rotate <20, 30, 40> } finish { phong 0.8 } } }
object { Ball(1, 0) texture { pigment { Clouds } } }
object {
  Ball(2, 0)
  texture { pigment { rgb <0.7, 0.75, 0.8> } normal { bumps 0.9 scale 0.18 } finish { phong 0.7 reflection 0.15 } }
}
object {
  Ball(3, 0)
  texture {
    pigment {
      gradient y triangle_wave frequency 2 phase 0.3
      pigment_map { [0.2 Clouds] [0.6 checker rgb <1, 0.8, 0.2>, rgb <0.1, 0.3, 0.2> scale 0.25] [0.9 rgb 0.9] }
    }
  }
}
object { Ball(4, 0) texture { checker texture { Plain }, texture { Shine } scale 0.5 rotate <10, 20, 30> } }
object {
  Ball(5, 0)
  texture { pigment { rgb <0.9, 0.5, 0.3> } normal { bozo 0.5 scale 0.3 } }
  texture {
    pigment { gradient x color_map { [0 rgbt <0.1, 0.1, 0.3, 0.1>] [0.5 rgbt <1, 1, 1, 1>] } scale 0.6 }
    finish { phong 1 reflection 0.2 }
  }
}
object {
  Ball(1, 1)
  texture {
    bozo scale 0.5 turbulence 0.5
    texture_map { [0.35 Plain] [0.5 pigment { Stripes } normal { bumps 0.7 scale 0.1 }] [0.6 Shine] }
  }
}
object {
  Ball(2, 1)
  texture {
    pigment { average pigment_map { [1 Stripes] [2 Clouds] [1 rgb <0.2, 0.8, 0.3>] } }
    normal { gradient y normal_map { [0.3 bumps 0.8 scale 0.15] [0.7 gradient x 0.6 sine_wave scale 0.3] } scale 0.9 }
    finish { specular 0.5 }
  }
}
object {
  Ball(3, 1)
  texture { pigment { gradient z scallop_wave color_map { [0 rgbf <1, 0.6, 0.5, 0.9>] [1 rgbt <0.3, 0.5, 1, 0.7>] } } }
  interior { ior 1.3 }
}
object {
  Ball(4, 1)
  texture {
    pigment {
      bozo warp { turbulence <0.8, 0.2, 0.5> } scale <0.3, 0.9, 0.3> rotate 25*z
      cubic_wave frequency 1.5
      color_map { [0 rgb <0.9, 0.85, 0.7>] [1 rgb <0.3, 0.1, 0.05>] }
    }
    finish { phong 0.4 }
  }
}
