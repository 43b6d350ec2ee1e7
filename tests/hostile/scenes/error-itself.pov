// expect: error-itself.pov:2:1: error: stop here
#error "stop here"
