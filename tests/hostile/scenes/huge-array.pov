// expect: huge-array.pov:2:20: error: an array has more than 1200000 elements (--max array-elements=N allows more)
#declare A = array[1e9];
