// expect: division-by-zero.pov:2:13: error: this number is not finite
sphere { 0, 1 / 0 }
