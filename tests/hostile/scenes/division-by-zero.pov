// expect: division-by-zero.pov:2:30: error: this number is not finite
sphere { 0, 1 interior { ior 1 / 0 } }
