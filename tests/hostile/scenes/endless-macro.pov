// expect: endless-macro.pov:3:3: error: macros call one another more than 1000 deep (--max macro-depth=N allows more)
#macro M()
  M()
#end
M()
