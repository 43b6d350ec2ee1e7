// A kernel that uses SIMD and DMA: adds up the 16 lanes of two vectors' sum.
#pragma once

#include "celltrace/spe/types.hpp"

#include <stdint.h>

namespace celltrace::test {

struct alignas(16) LaneSumBlock {
  float a[16];
  float b[16];
  float sum;
  uint32_t pad[3];
};
static_assert(sizeof(LaneSumBlock) == 144, "LaneSumBlock crosses DMA");

template <class Spu> void lane_sum(Spu& spu, ea_t argument) {
  using F = typename Spu::simd::F;
  LaneSumBlock* block = spu.template allocate<LaneSumBlock>();
  float* lanes = spu.template allocate<float>(16);
  spu.get(block, argument, sizeof *block, 0);
  spu.wait_all(1);
  F::load(block->a).store(lanes);
  (F::load(lanes) + F(1.0f)).store(lanes);
  block->sum = 0;
  for (uint32_t i = 0; i < 16; ++i)
    block->sum += lanes[i];
  spu.put(block, argument, sizeof *block, 0);
  spu.wait_all(1);
}

} // namespace celltrace::test
