// expect: macro-in-a-value.pov:2:25: error: macros and directives are nested too deeply
#macro M() #declare A = M(); #end
M()
