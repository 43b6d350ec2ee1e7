// expect: random-streams-without-end.pov:4:16: error: too many random streams
// arguments: --max list-entries=10000
#for (I, 1, 1e6)
  #declare S = seed(1);
#end
