// expect: endless-while-in-time.pov:1:1: error: reading the scene takes more than 0 seconds (--max seconds=N allows more)
// arguments: --max seconds=0
#while (1)
  #declare A = sphere { 0, 1 pigment { rgb 1 } }
#end
