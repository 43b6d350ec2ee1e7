// expect: camera-without-direction.pov:2:1: error: the camera has no direction
camera { location 0 right 0 up 0 direction 0 }
sphere { 0, 1 }
