// expect: break-of-nothing.pov:2:1: error: #break outside of a loop, #switch or macro
#break
