// expect: objects-doubled.pov:7:1: error: the scene has more than 100000 objects (--max objects=N allows more)
// arguments: --max objects=100000
#declare U = sphere { 0, 1 }
#for (I, 1, 30)
  #declare U = union { object { U } object { U } }
#end
object { U }
