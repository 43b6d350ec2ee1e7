// expect: open-endlessly.pov:5:12: error: #fopen keeps more than 64 files open (--max open-files=N allows more)
// arguments: --allow-write OUT
#declare N = array[1000];
#for (I, 0, 999)
  #fopen F "written.txt" append
  #undef F
#end
