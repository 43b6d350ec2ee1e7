// Under the name that existing SPE sources include; see celltrace/spe/spu_mfcio.hpp.
#pragma once

#include "celltrace/spe/spu_mfcio.hpp"
