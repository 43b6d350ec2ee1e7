// expect: endless-while-in-time.pov:1:1: error: reading the scene takes more than 0 seconds (--max seconds=N allows more)
// arguments: --max seconds=0
#declare I = 1;
#while (I > 0)
  #declare I = I + 1;
#end
