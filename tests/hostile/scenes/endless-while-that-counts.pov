// expect: endless-while-that-counts.pov:4:1: error: the loops of the scene run more than 100000 times (--max loop-steps=N allows more)
// arguments: --max loop-steps=100000
#declare I = 1;
#while (I > 0)
  #declare I = I + 1;
#end
