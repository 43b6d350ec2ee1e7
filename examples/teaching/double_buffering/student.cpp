// One buffer: the SPE waits for every block. Make it fetch the next one while it works.
#include "task.hpp"

using celltrace::ea_t;
using celltrace::EmulatedSpu;

void process_blocks(EmulatedSpu& spu, ea_t argument) {
  constexpr std::uint32_t kTag = 0;
  constexpr std::uint32_t kBytes = kBlockFloats * sizeof(float);
  Task* task = spu.allocate<Task>();
  spu.get(task, argument, sizeof *task, kTag);
  spu.wait_all(1u << kTag);

  float* buffer = spu.allocate<float>(kBlockFloats);
  for (std::uint32_t i = 0; i < task->count; ++i) {
    const ea_t block = task->blocks + ea_t{i} * kBytes;
    spu.get(buffer, block, kBytes, kTag);
    spu.wait_all(1u << kTag);
    work_on(spu, buffer);
    spu.put(buffer, block, kBytes, kTag);
    spu.wait_all(1u << kTag);
  }
}
