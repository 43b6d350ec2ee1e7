// expect: huge-width.pov:2:1: error: <invalid>
#error str(1, 1e9, 1e9)
