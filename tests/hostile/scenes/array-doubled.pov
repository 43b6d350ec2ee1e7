// expect: array-doubled.pov:4:30: error: the arrays of the scene have more than 1200000 elements (--max array-elements=N allows more)
#declare A = array[2] { 1, 1 }
#for (I, 1, 40)
  #declare A = array[2] { A, A }
#end
