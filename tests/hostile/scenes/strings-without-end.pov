// expect: strings-without-end.pov:9:19: error: the scene makes more than 67108864 bytes of text (--max text-bytes=N allows more)
// arguments: --max text-bytes=64M
#declare S = "0123456789";
#for (I, 1, 15)
  #declare S = concat(S, S);
#end
#declare A = array[1000];
#for (I, 0, 999)
  #declare A[I] = concat(S, str(I, 0, 0));
#end
