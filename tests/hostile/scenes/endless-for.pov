// expect: endless-for.pov:2:1: error: the loops of the scene run more than 1000000000 times (--max loop-steps=N allows more)
#for (I, 0, 1, 1e-12)
#end
