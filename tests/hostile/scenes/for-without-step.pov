// expect: for-without-step.pov:3:1: error: the step of a #for must not be 0
// arguments: --max loop-steps=100000
#for (I, 0, 1, 0)
#end
