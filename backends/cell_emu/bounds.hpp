// Bounds that transfers must not cross, besides the bounds of storage: allocations of programs in local
// stores, and registered objects in main memory.
#pragma once

#include "backends/cell_emu/allocations.hpp"
#include "backends/cell_emu/memory_objects.hpp"

#include <memory>

namespace celltrace::cell_emu {

struct Bounds {
  Bounds(unsigned spes, const std::vector<MemoryObject>& host_objects)
      : allocations(std::make_unique<Allocations[]>(spes)), objects(host_objects) {}

  std::unique_ptr<Allocations[]> allocations; ///< index: SPE
  MemoryObjects objects;
};

} // namespace celltrace::cell_emu
