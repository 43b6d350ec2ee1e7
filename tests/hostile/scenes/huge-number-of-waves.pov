// expect: huge-number-of-waves.pov:2:35: error: there are at most 1000 waves
global_settings { number_of_waves 1000000000 }
sphere { 0, 1 }
