// Puts large blocks of memory on huge pages, if the system has them (Linux: transparent_hugepage).
//
// Rays that access such a block in random order then miss the TLB less often. If the system has huge
// pages at hand, a scene's text or triangles also fill them sooner than pages that are brought in 4 KB at a
// time. AlignedBlock explains why pictures are not on them.
#pragma once

#include <cstddef>
#include <cstdint>

#include <sys/mman.h>

namespace celltrace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;

/// Advises the system about memory that is about to be filled; this changes only the cost of page faults.
/// Blocks too small to hold a huge page are left alone.
inline void use_huge_pages(void* data, std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
  const auto begin = reinterpret_cast<std::uintptr_t>(data) & ~(kHugePage - 1);
  const auto end = (reinterpret_cast<std::uintptr_t>(data) + bytes + kHugePage - 1) & ~(kHugePage - 1);
  if (bytes >= kHugePage) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#else
  static_cast<void>(data), static_cast<void>(bytes);
#endif
}

} // namespace celltrace
