// expect: write-endlessly.pov:5:14: error: the scene writes more than 1048576 bytes to files (--max written-bytes=N allows more)
// arguments: --allow-write OUT --max written-bytes=1M
#fopen F "written.txt" write
#for (I, 1, 1e6)
  #write (F, "0123456789")
#end
