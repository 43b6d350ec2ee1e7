// expect: include-itself.pov:2:10: error: does 'include-itself.pov' include itself? Files are included more than 64 deep (--max include-depth=N allows more)
#include "include-itself.pov"
