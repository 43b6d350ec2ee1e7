// Gives celltrace/spe/spu_intrinsics.hpp the name that existing SPE sources include. `vector` is a keyword
// from here on, as in the SDK: `vector float` is a vector type of the compiler, which the intrinsics take and
// return. C++ sources that use std::vector write #undef vector, or define CELLTRACE_NO_VECTOR_KEYWORD before
// they include this header.
#pragma once

#include "celltrace/spe/spu_intrinsics.hpp"

#ifndef __SPU__
#undef __vector // POWER's compilers define __vector for AltiVec's types
#define __vector __attribute__((vector_size(16)))
#ifndef CELLTRACE_NO_VECTOR_KEYWORD
#include <vector> // has to be included before `vector` becomes a keyword
#define vector __vector
#endif
#endif
