// expect: huge-width.pov:2:8: error: an argument is out of range
#debug str(1, 1e9, 1e9)
