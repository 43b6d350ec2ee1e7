// Tracks which bytes of a software cache's lines have been written, and writes them to main memory. Kernel
// dialect.
//
// A flag for each byte allows several SPEs to write different bytes of one line. A line that is dirty in part
// is merged into main memory by an atomic update (getllar, putllc), by which the program loses any
// reservation it has. A line that is dirty as a whole is written by a put. Either write is complete before
// the line is replaced.
#pragma once

#include "celltrace/cache/config.hpp"

#include <stdint.h>

namespace celltrace {

/// Tracks nothing, for a cache that is only read.
template <class Spu, bool write_back> class DirtyBytes {
protected:
  static constexpr uint32_t dirt_bytes(uint32_t) { return 0; }
  void set_up_dirt(Spu&, uint32_t) {}
  void clean(Spu&, uint32_t, const uint8_t*, ea_t, uint32_t) {}
};

template <class Spu> class DirtyBytes<Spu, true> {
public:
  /// Returns the number of lines, or parts of lines, that have been written to main memory.
  uint32_t written_back() const { return written_back_; }

protected:
  static constexpr uint32_t dirt_bytes(uint32_t slots) {
    return slots * static_cast<uint32_t>(sizeof(Dirt)) + kLineBytes;
  }
  void set_up_dirt(Spu& spu, uint32_t slots) {
    merged_ = spu.template allocate<Line>();
    slots_ = spu.template allocate<Dirt>(slots, 16);
  }

  /// Marks `bytes` bytes from byte `first` of the line at `offset` as written; the line lies in `slot`.
  void mark_dirty(uint32_t slot, uint32_t offset, uint32_t first, uint32_t bytes) {
    Dirt& dirt = slots_[slot];
    dirt.offset = offset;
    const uint32_t end = first + bytes;
    for (uint32_t word = first / 32; word * 32 < end; ++word) {
      const uint32_t from = first > word * 32 ? first - word * 32 : 0;
      const uint32_t to = end - word * 32 < 32 ? end - word * 32 : 32;
      dirt.flags[word] |= kAll >> (32 - (to - from)) << from;
    }
  }

  /// Writes the dirty bytes of the line in `slot`, if there are any, to the region at `base`. May wait for
  /// the DMA tag `tag`.
  void clean(Spu& spu, uint32_t slot, const uint8_t* line, ea_t base, uint32_t tag) {
    Dirt& dirt = slots_[slot];
    if ((dirt.flags[0] | dirt.flags[1] | dirt.flags[2] | dirt.flags[3]) == 0) return;
    const ea_t to = base + dirt.offset;
    if ((dirt.flags[0] & dirt.flags[1] & dirt.flags[2] & dirt.flags[3]) == kAll) {
      spu.put(line, to, kLineBytes, tag);
      spu.wait_all(1u << tag);
    } else {
      do {
        spu.getllar(merged_, to);
        merge(dirt, line);
      } while (!spu.putllc(merged_, to));
    }
    ++written_back_;
    dirt = Dirt();
  }

private:
  static constexpr uint32_t kAll = 0xFFFFFFFFu;

  struct alignas(kLineBytes) Line {
    uint8_t bytes[kLineBytes];
  };
  struct alignas(16) Dirt {
    uint32_t flags[kLineBytes / 32]; ///< bit i of word w: byte 32 w + i
    uint32_t offset;                 ///< offset of the line in the region
    uint32_t unused[3];
  };

  void merge(const Dirt& dirt, const uint8_t* line) {
    for (uint32_t word = 0; word < kLineBytes / 32; ++word) {
      for (uint32_t left = dirt.flags[word]; left != 0; left &= left - 1) {
        const uint32_t byte = word * 32 + static_cast<uint32_t>(__builtin_ctz(left));
        merged_->bytes[byte] = line[byte];
      }
    }
  }

  Line* merged_ = nullptr;
  Dirt* slots_ = nullptr;
  uint32_t written_back_ = 0;
};

} // namespace celltrace
