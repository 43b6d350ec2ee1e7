// Two buffers, with a tag each. The get of the next block has a fence: the buffer's last results have to be
// out before.
#include "task.hpp"

using celltrace::ea_t;
using celltrace::EmulatedSpu;

void process_blocks(EmulatedSpu& spu, ea_t argument) {
  constexpr std::uint32_t kBuffers = 2;
  constexpr std::uint32_t kBytes = kBlockFloats * sizeof(float);
  Task* task = spu.allocate<Task>();
  spu.get(task, argument, sizeof *task, 0);
  spu.wait_all(1u << 0);

  float* buffers[kBuffers];
  for (float*& buffer : buffers)
    buffer = spu.allocate<float>(kBlockFloats);
  const auto block = [&](std::uint32_t i) { return task->blocks + ea_t{i} * kBytes; };
  const auto fetch = [&](std::uint32_t i) {
    if (i < task->count) spu.getf(buffers[i % kBuffers], block(i), kBytes, i % kBuffers);
  };

  fetch(0);
  for (std::uint32_t i = 0; i < task->count; ++i) {
    const std::uint32_t buffer = i % kBuffers;
    fetch(i + 1);
    spu.wait_all(1u << buffer);
    work_on(spu, buffers[buffer]);
    spu.put(buffers[buffer], block(i), kBytes, buffer);
  }
  spu.wait_all((1u << kBuffers) - 1);
}
