#pragma once
#include "celltrace/spe/simulation.hpp"
#include <cstdint>
namespace celltrace::cell_emu {
class PpeCalls {
public:
  explicit PpeCalls(const SimulationConfig&) {}
  bool handle(unsigned, std::uint8_t*, std::uint32_t) { return false; }
};
}
