// The words in which a software cache records its requests (Spu::record()). Kernel dialect.
//
// The upper 25 bits of a word are the number of a line, its offset divided by 128; the lower 7 bits are the
// operation. docs/software-cache.md has the table.
#pragma once

#include "celltrace/cache/config.hpp"

#include <stdint.h>

namespace celltrace::cache_trace {

constexpr uint32_t kKinds = 8; ///< number of kinds of data that a trace tells apart

enum class Operation : uint8_t {
  read = 0,  ///< + kind
  write = 8, ///< + kind
  prefetch = 16,
  synchronize = 17,     ///< the line is the first line; the next word is the number of lines
  synchronize_all = 18, ///< here and in the operations below, the upper bits are 0
  invalidate_all = 19,
  reset_counters = 20,
  flush = 21,
  begin = 22, ///< a new cache: two words with its configuration follow
  end,        ///< number of values, no operation
};

constexpr uint32_t kOperationBits = 7;
constexpr uint32_t kOperationMask = (1u << kOperationBits) - 1;

/// Returns the word of an operation. `line` is the offset of a line.
constexpr uint32_t make(Operation operation, uint32_t line = 0) {
  return line | static_cast<uint32_t>(operation);
}
constexpr uint32_t make(Operation operation, uint32_t line, uint32_t kind) {
  return line | (static_cast<uint32_t>(operation) + kind);
}
/// Returns the number of words that follow the operation's word.
constexpr uint32_t words_after(Operation operation) {
  return operation == Operation::begin ? 2 : operation == Operation::synchronize ? 1 : 0;
}

// The two words after `begin`, which encode the cache's configuration.
constexpr uint32_t first_word(const CacheConfig& config) {
  return config.ways << 16 | config.sets;
}
constexpr uint32_t second_word(const CacheConfig& config) {
  return static_cast<uint32_t>(config.replacement) << 1 | (config.enabled ? 1u : 0u);
}

static_assert(kLineBytes == 1u << kOperationBits, "the operation takes the place of the byte in the line");

} // namespace celltrace::cache_trace
