// expect: missing-parenthesis.pov:3:1: error: macro 'M' takes only 2 arguments
#macro M(A, B) #end
M(1, 2
sphere { 0, 1 }
