// Load balancing by generalized dimension exchange and diffusion, usable without the tracer. Nothing here has
// a clock, a thread or a transport. Host side (C++20), but for balance/strip.hpp, which kernels include on
// its own.
#pragma once

#include "celltrace/balance/convergence.hpp"        // how fast sweeps converge, measured
#include "celltrace/balance/dimension_exchange.hpp" // synchronous sweeps
#include "celltrace/balance/exchange_parameter.hpp" // how fast they converge and their best parameters, in theory
#include "celltrace/balance/partition.hpp"          // units and strips by what work has cost before
#include "celltrace/balance/strip.hpp"        // the asynchronous exchange of work on a chain: one node of it
#include "celltrace/balance/strip_tally.hpp"  // the PPE's side of that
#include "celltrace/balance/system_graph.hpp" // chains, rings, meshes, tori, hypercubes, any graph
