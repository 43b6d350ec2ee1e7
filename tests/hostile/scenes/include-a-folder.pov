// expect: include-a-folder.pov:2:10: error: cannot find the include file '.'
#include "."
