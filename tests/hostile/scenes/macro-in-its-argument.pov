// expect: macro-in-its-argument.pov:2:15: error: macros and directives are nested too deeply
#macro M(A) M(M(A)) #end
M(1)
