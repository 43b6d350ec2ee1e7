// expect: layers-without-end.pov:4:30: error: a texture has at most 64 layers
#declare T = texture { pigment { rgbt 1 } }
#for (I, 1, 100000)
  #declare T = texture { T } texture { pigment { rgbt 1 } }
#end
sphere { 0, 1 texture { T } }
