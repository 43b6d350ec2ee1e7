// Main memory to be cached, and ways to walk through it.
#pragma once

#include "celltrace/spe/types.hpp"

#include <cstdint>
#include <random>
#include <vector>

namespace celltrace::test {

/// A region of main memory whose words can be told apart.
class Memory {
public:
  explicit Memory(std::uint32_t lines) : lines_(lines) {
    for (std::uint32_t offset = 0; offset < bytes(); offset += 4)
      word(offset) = offset * 2654435761u + 1;
  }
  ea_t base() const { return reinterpret_cast<std::uintptr_t>(lines_.data()); }
  std::uint32_t bytes() const { return static_cast<std::uint32_t>(lines_.size() * kLineBytes); }
  std::uint32_t& word(std::uint32_t offset) {
    return lines_[offset / kLineBytes].words[offset % kLineBytes / 4];
  }

  const std::uint32_t& word(std::uint32_t offset) const { return const_cast<Memory*>(this)->word(offset); }

private:
  struct alignas(kLineBytes) Line {
    std::uint32_t words[kLineBytes / 4];
  };
  std::vector<Line> lines_;
};

/// Offsets near each other with jumps in between, as rays read a scene.
inline std::uint32_t wander(std::uint32_t from, std::uint32_t bytes, std::mt19937& random) {
  const std::uint32_t step = random() % 8 == 0 ? random() : random() % 1024;
  return (from + step) % bytes & ~3u;
}

} // namespace celltrace::test
