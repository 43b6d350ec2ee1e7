// expect: else-of-nothing.pov:2:1: error: #else without #if
#else
