// expect: end-of-nothing.pov:2:1: error: #end without anything to end
#end
