// expect: missing-semicolon.pov:2:10: error: 'A' needs a ';' behind its value, unless a #version below 3.5 comes first
#declare A = 1 B = 2;
