// expect: endless-while.pov:3:1: error: the loops of the scene run more than 100000 times (--max loop-steps=N allows more)
// arguments: --max loop-steps=100000
#while (1)
  #declare A = 1;
#end
