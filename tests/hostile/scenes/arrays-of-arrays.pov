// expect: arrays-of-arrays.pov:4:33: error: the arrays of the scene have more than 1200000 elements (--max array-elements=N allows more)
#declare A = array[100];
#for (I, 0, 99)
  #declare A[I] = array[1000000];
#end
