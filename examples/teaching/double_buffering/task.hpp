// The task: an SPE takes blocks of numbers out of main memory, has each worked on, and puts it back.
#pragma once

#include <celltrace/emulator.hpp>

#include <cstdint>

constexpr std::uint32_t kBlockFloats = 1024; // 4 KB

/// The work of an SPE: blocks that lie one behind the other.
struct alignas(128) Task {
  celltrace::ea_t blocks;
  std::uint32_t count;
};

/// Works on a block in local store. On the virtual clock this takes about as long as a block's way to local
/// store.
void work_on(celltrace::EmulatedSpu& spu, float* block);

/// To be written: the SPE's program. `argument` is the effective address of its Task.
void process_blocks(celltrace::EmulatedSpu& spu, celltrace::ea_t argument);
