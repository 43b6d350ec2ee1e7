// expect: nested-loops.pov:3:35: error: the loops of the scene run more than 100000 times (--max loop-steps=N allows more)
// arguments: --max loop-steps=100000
#for (I, 1, 1e4) #for (J, 1, 1e4) #for (K, 1, 1e4)
#end #end #end
