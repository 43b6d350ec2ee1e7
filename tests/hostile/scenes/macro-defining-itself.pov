// expect: macro-defining-itself.pov:2:23: error: macros call one another more than 1000 deep (--max macro-depth=N allows more)
#macro M() #macro M() M() #end M() #end
M()
