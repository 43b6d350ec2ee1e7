sphere { 0,1 pigment{rgb 1} normal { bumps 1 noise_generator 3 scale 0.3 } finish{ambient 0 diffuse 1} }
