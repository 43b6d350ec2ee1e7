// Defines VMX's names of vector types, in a header with the name that existing SPE sources include.
#pragma once

#include "spu_intrinsics.h"

#ifdef __SPU__
#include_next <vec_types.h>
#else
using vec_bchar16 = vec_uchar16;
using vec_bshort8 = vec_ushort8;
using vec_pixel8 = vec_ushort8;
using vec_bint4 = vec_uint4;
#endif
