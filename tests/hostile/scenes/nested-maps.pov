// expect: nested-maps.pov:4:51: error: maps are nested more than 8 deep
#declare P = pigment { rgb 1 }
#for (I, 1, 1000)
  #declare P = pigment { gradient x pigment_map { [0 P] [1 P] } }
#end
sphere { 0, 1 pigment { P } }
