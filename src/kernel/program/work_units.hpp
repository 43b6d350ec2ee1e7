// The units of a frame on an SPE: their packets and their costs. Kernel dialect.
#pragma once

#include "celltrace/spe/types.hpp"
#include "records/frame.hpp"

namespace celltrace::kernel {

/// Reads the frame's units by cache lines and writes their costs one by one, so that SPEs may share lines of
/// units and of costs.
template <class Spu> class WorkUnits {
public:
  explicit WorkUnits(Spu& spu) : spu_(spu), buffers_(*spu.template allocate<Buffers>()) {}

  void begin_frame(const FrameBlock& frame) {
    units_ = frame.units;
    costs_ = frame.costs;
    line_ = kNoLine;
  }

  UnitRecord at(uint32_t unit) {
    const uint32_t line = unit / kUnitsPerLine;
    if (line != line_) {
      spu_.get(buffers_.line, units_ + line * kLineBytes, kLineBytes, kTag);
      spu_.wait_all(1u << kTag);
      line_ = line;
    }
    return buffers_.line[unit % kUnitsPerLine];
  }

  void write_cost(uint32_t unit, uint32_t ticks) {
    spu_.wait_all(1u << (kCostTag + current_));
    // A transfer needs the word at the same place in its quadword on both sides.
    uint32_t* const word = &buffers_.costs[current_][unit % 4];
    *word = ticks;
    spu_.put(word, costs_ + unit * sizeof(uint32_t), sizeof(uint32_t), kCostTag + current_);
    current_ ^= 1;
  }
  /// Waits until all costs are in main memory.
  void flush() { spu_.wait_all(3u << kCostTag); }

private:
  static constexpr uint32_t kTag = 0;
  static constexpr uint32_t kCostTag = 4;
  static constexpr uint32_t kUnitsPerLine = kLineBytes / sizeof(UnitRecord);
  static constexpr uint32_t kNoLine = ~0u;

  struct alignas(128) Buffers {
    UnitRecord line[kUnitsPerLine];
    alignas(16) uint32_t costs[2][4];
  };

  Spu& spu_;
  Buffers& buffers_;
  ea_t units_ = 0;
  ea_t costs_ = 0;
  uint32_t line_ = kNoLine;
  uint32_t current_ = 0;
};

} // namespace celltrace::kernel
