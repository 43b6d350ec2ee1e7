// expect: missing-brace.pov:3:1: error: unexpected end of the scene
sphere { 0, 1
