// expect: nested-arrays.pov:4:27: error: this array is too large to be copied
#declare A = array[1] { 1 }
#for (I, 1, 1000)
  #declare A = array[1] { A }
#end
