// expect: infinite-number.pov:2:13: error: this number is not finite
sphere { 0, 1e400 }
