// expect: area-light-of-millions.pov:2:21: error: an area light has 1 to 256 places along each side
light_source { 0, 1 area_light x, y, 1000000, 1000000 }
sphere { 0, 1 }
