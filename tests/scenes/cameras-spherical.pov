// All around, from within; the second angle is the picture's height.
#version 3.7;
#include "cameras.inc"
camera { spherical location <0, 0.5, -0.5> angle 330, 150 look_at <1, 0.6, 4> sky <0.1, 1, 0> }
