// expect: singular-transform.pov:2:1: error: this object's transformation is singular: it has no inverse
sphere { 0, 1 scale <1, 0, 1> matrix <1,1,0, 1,1,0, 0,0,1, 0,0,0> }
