// expect: infinite-number.pov:2:21: error: this number is not finite
sphere { 0, 1 scale 1e400 }
