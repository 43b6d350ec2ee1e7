// expect: huge-dimensions.pov:2:14: error: an array has more than 1200000 elements (--max array-elements=N allows more)
#declare A = array[1000][1000][1000];
