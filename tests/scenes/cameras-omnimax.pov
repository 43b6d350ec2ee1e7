// A dome, black outside.
#version 3.7;
#include "cameras.inc"
camera { omnimax location <0, 1, -2> look_at <0, 3, 5> right x*4/3 }
