// expect: huge-trace-level.pov:2:35: error: max_trace_level must lie between 1 and 256
global_settings { max_trace_level 1000000000 }
sphere { 0, 1 }
