// expect: endless-while.pov:3:1: error: this loop never ends: nothing in it changes what that depends on
#declare I = 0;
#while (I < 10)
  sphere { I * x, 1 }
#end
