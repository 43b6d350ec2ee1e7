// expect: camera-at-what-it-looks-at.pov:2:1: error: the camera's 'location' and 'look_at' are the same point
camera { location 1 look_at 1 }
sphere { 0, 1 }
