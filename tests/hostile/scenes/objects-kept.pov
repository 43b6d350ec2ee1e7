// expect: objects-kept.pov:5:*: error: the declarations of the scene need more than 67108864 bytes of memory (--max memory=N allows more)
// arguments: --max memory=64M
#declare A = array[100000];
#for (I, 0, 99999)
  #declare A[I] = sphere { 0, 1 texture { pigment { rgb 1 } finish { phong 1 } } }
#end
