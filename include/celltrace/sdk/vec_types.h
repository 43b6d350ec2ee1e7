// The header's name in existing SPE sources: the names of VMX for vector types.
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
