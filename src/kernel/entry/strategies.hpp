// The kernel with both strategies: code that compiles it for an SPU includes this file. Kernel dialect.
#pragma once

#include "kernel/direct/strategy.hpp"
#include "kernel/local/strategy.hpp"
