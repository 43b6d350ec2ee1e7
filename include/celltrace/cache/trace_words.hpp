// The words in which a software cache records what it is asked for (Spu::record()). Kernel dialect.
//
// A word is the number of a line, its offset divided by 128, in the upper 25 bits and what happens to it in
// the lower 7. docs/software-cache.md has the table.
#pragma once

#include "celltrace/cache/config.hpp"

#include <stdint.h>

namespace celltrace::cache_trace {

constexpr uint32_t kKinds = 8; ///< of data that can be told apart

enum class Operation : uint8_t {
  read = 0,  ///< + kind
  write = 8, ///< + kind
  prefetch = 16,
  synchronize = 17,     ///< the line is the first; the next word is their number
  synchronize_all = 18, ///< here and below, the upper bits are 0
  invalidate_all = 19,
  reset_counters = 20,
  flush = 21,
  begin = 22, ///< a new cache: two words that describe it follow
  end,        ///< no operation
};

constexpr uint32_t kOperationBits = 7;
constexpr uint32_t kOperationMask = (1u << kOperationBits) - 1;

/// `line`: the offset of a line.
constexpr uint32_t make(Operation operation, uint32_t line = 0) {
  return line | static_cast<uint32_t>(operation);
}
constexpr uint32_t make(Operation operation, uint32_t line, uint32_t kind) {
  return line | (static_cast<uint32_t>(operation) + kind);
}
/// How many words follow that belong to the operation.
constexpr uint32_t words_after(Operation operation) {
  return operation == Operation::begin ? 2 : operation == Operation::synchronize ? 1 : 0;
}

// The words after `begin`.
constexpr uint32_t first_word(const CacheConfig& config) {
  return config.ways << 16 | config.sets;
}
constexpr uint32_t second_word(const CacheConfig& config) {
  return static_cast<uint32_t>(config.replacement) << 1 | (config.enabled ? 1u : 0u);
}

static_assert(kLineBytes == 1u << kOperationBits, "the operation takes the place of the byte in the line");

} // namespace celltrace::cache_trace
