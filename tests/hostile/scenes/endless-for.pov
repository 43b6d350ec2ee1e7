// expect: endless-for.pov:3:1: error: the loops of the scene run more than 100000 times (--max loop-steps=N allows more)
// arguments: --max loop-steps=100000
#for (I, 0, 1, 1e-12)
#end
