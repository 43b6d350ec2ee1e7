// expect: subscript-outside.pov:3:11: error: this subscript is out of range
#declare A = array[3];
#declare A[1e30] = 1;
