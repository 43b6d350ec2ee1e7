// expect: division-by-zero.pov:2:21: error: this number is not finite
sphere { 0, 1 scale 1 / 0 }
