// Gives celltrace/spe/spu_mfcio.hpp the name that existing SPE sources include.
#pragma once

#include "celltrace/spe/spu_mfcio.hpp"
