// expect: nothing.pov:1:1: error: the scene is empty

