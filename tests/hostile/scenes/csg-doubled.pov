// expect: csg-doubled.pov:6:1: error: the scene has more than 4000000 objects (--max objects=N allows more)
#declare U = sphere { 0, 1 }
#for (I, 1, 30)
  #declare U = intersection { object { U } object { U } }
#end
object { U }
