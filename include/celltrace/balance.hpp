// Load balancing by generalized dimension exchange and diffusion, usable without the tracer. The functions
// use no clock, no thread and no transport. For the host (C++20); kernels may include balance/strip.hpp
// alone.
#pragma once

#include "celltrace/balance/convergence.hpp"        // measures how fast sweeps converge
#include "celltrace/balance/dimension_exchange.hpp" // synchronous sweeps
#include "celltrace/balance/exchange_parameter.hpp" // best parameters of sweeps, by formulas
#include "celltrace/balance/partition.hpp"          // cuts work into units and strips by measured cost
#include "celltrace/balance/strip.hpp"              // a node of a chain that exchanges work asynchronously
#include "celltrace/balance/strip_tally.hpp"        // the PPE's side of the asynchronous exchange
#include "celltrace/balance/system_graph.hpp"       // chains, rings, meshes, tori, hypercubes, any graph
