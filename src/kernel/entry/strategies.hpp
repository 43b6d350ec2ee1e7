// Binds the kernel to its strategies: whoever compiles it for an SPU includes this. Kernel dialect.
#pragma once

#include "kernel/direct/strategy.hpp"
#include "kernel/local/strategy.hpp"
