// expect: missing-quote.pov:2:14: error: this string is never closed
#declare S = "abc;
sphere { 0, 1 }
