// Under the name that existing SPE sources include; see celltrace/spe/spu_intrinsics.hpp.
#pragma once

#include "celltrace/spe/spu_intrinsics.hpp"
