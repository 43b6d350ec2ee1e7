// expect: nested-csg.pov:4:16: error: objects are nested too deeply
#declare U = sphere { 0, 1 }
#for (I, 1, 2000)
  #declare U = difference { object { U } box { 0, 1 } }
#end
object { U }
