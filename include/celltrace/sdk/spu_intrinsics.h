// The header's name in existing SPE sources; see celltrace/spe/spu_intrinsics.hpp. `vector` is a
// keyword from here on, as in the SDK: `vector float` is a vector type of the compiler's, which the
// intrinsics take and return. C++ sources that mean std::vector write #undef vector, or define
// CELLTRACE_NO_VECTOR_KEYWORD before.
#pragma once

#include "celltrace/spe/spu_intrinsics.hpp"

#ifndef __SPU__
#undef __vector // POWER's compilers have one of their own, for AltiVec's types
#define __vector __attribute__((vector_size(16)))
#ifndef CELLTRACE_NO_VECTOR_KEYWORD
#include <vector> // included before `vector` gets another meaning
#define vector __vector
#endif
#endif
