// Under the name that existing SPE sources include; see celltrace/spe/spu_intrinsics.hpp. `vector` is a
// keyword from here on, as the SDK has it: `vector float` is a vector of the compiler's that the intrinsics
// take and give. C++ sources that mean std::vector write #undef vector, or define CELLTRACE_NO_VECTOR_KEYWORD
// before.
#pragma once

#include "celltrace/spe/spu_intrinsics.hpp"

#ifndef __SPU__
#undef __vector // POWER's compilers have one of their own, of AltiVec's types
#define __vector __attribute__((vector_size(16)))
#ifndef CELLTRACE_NO_VECTOR_KEYWORD
#include <vector> // before the word has another meaning
#define vector __vector
#endif
#endif
