// The bounds that commands have to keep besides those of the storage itself: the programs' allocations in
// local stores, and the host's objects in main memory.
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
