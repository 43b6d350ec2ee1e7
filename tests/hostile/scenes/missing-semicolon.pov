// expect: missing-semicolon.pov:2:16: error: 'B' is not declared
#declare A = 1 B = 2;
