// Rays that share neither origin nor direction.
#version 3.7;
#include "cameras.inc"
camera { cylinder 3 location <0, 1, 0> up 6*y angle 240 rotate <8, 20, 3> }
