// expect: missing-end.pov:2:1: error: #end is missing for what starts here
#if (1)
sphere { 0, 1 }
