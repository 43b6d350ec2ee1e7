// Large pigments and textures that many objects have, each at another place.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -5> look_at 0 angle 46 }
light_source { <2, 3, -9> rgb 1 shadowless }
#macro Squares(A, B, Level)
  pigment {
    checker
    #if (Level > 0)
      Squares(A, (A + B) / 2, Level - 1) Squares((A + B) / 2, B, Level - 1)
    #else
      rgb A rgbt <B, 1, A, 0.2>
    #end
    scale 0.97 translate <0.013, 0.017, 0.011>
  }
#end
#macro Tiles(A, B, Level)
  texture {
    gradient x + Level*y
    texture_map {
      #if (Level > 0)
        [0 Tile_map(A, (A + B) / 2, Level - 1)] [1 Tile_map((A + B) / 2, B, Level - 1)]
      #else
        [0 pigment { rgb A } finish { phong 0.5 }] [1 pigment { rgb <B, A, 1> } finish { ambient 0.3 }]
      #end
    }
    scale 0.7
  }
#end
#macro Tile_map(A, B, Level)
  gradient x + Level*y
  texture_map {
    #if (Level > 0)
      [0 Tile_map(A, (A + B) / 2, Level - 1)] [1 Tile_map((A + B) / 2, B, Level - 1)]
    #else
      [0 pigment { rgb A } finish { phong 0.5 }] [1 pigment { rgb <B, A, 1> } finish { ambient 0.3 }]
    #end
  }
  scale 0.7
#end
#declare Pigment = Squares(0, 1, 7)
#declare Texture = Tiles(0.1, 1, 2)
plane { z, 3 pigment { rgb 0.5 } }
#for (I, 0, 19)
  #for (J, 0, 19)
    #local At = <I, J, 0> / 20 * 3.4 - <1.7, 1.7, 0>;
    #switch (mod(I + J, 4))
      #case (0)
        box { 0, 0.14 pigment { Pigment scale 0.5 + I / 60 rotate <J, I, 20> } translate At }
        #break
      #case (1)
        sphere { 0.08, 0.08 pigment { Pigment warp { turbulence 0.05 } scale 0.6 } translate At }
        #break
      #case (2)
        box { <0, 0, 0.003>, 0.14 texture { Texture rotate I*z } rotate J*y translate At }
        #break
      #case (3)
        sphere { 0.08, 0.08 texture { pigment { rgb <1, 0.5, 0> } } texture { pigment { Pigment scale 3 } } translate At }
        #break
    #end
  #end
#end
