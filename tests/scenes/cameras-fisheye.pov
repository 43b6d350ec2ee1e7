// A round picture, black outside.
#version 3.7;
#include "cameras.inc"
camera { fisheye location <0, 1, -2> look_at <0, 1.5, 5> angle 200 right x*4/3 }
