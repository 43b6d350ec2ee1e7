// expect: include-cycle.inc:1:10: error: does 'include-cycle.pov' include itself? Files are included more than 64 deep (--max include-depth=N allows more)
#include "include-cycle.inc"
