// The header's name in existing SPE sources; see celltrace/spe/spu_mfcio.hpp.
#pragma once

#include "celltrace/spe/spu_mfcio.hpp"
