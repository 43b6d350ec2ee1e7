// expect: macros-calling-each-other.pov:3:13: error: macros call one another more than 1000 deep (--max macro-depth=N allows more)
#macro A(X) B(X + 1) #end
#macro B(X) A(X + 1) #end
A(0)
