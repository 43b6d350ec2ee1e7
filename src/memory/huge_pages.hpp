// Large blocks of memory on huge pages, where the system has them to give (Linux: transparent_hugepage).
//
// Rays that go through such a block in no order then miss the TLB less often; and where the system has such
// pages at hand, a scene's text or triangles fill it sooner than pages that are brought in 4 KB at a time.
// AlignedBlock says why pictures are not on them.
#pragma once

#include <cstddef>
#include <cstdint>

#include <sys/mman.h>

namespace celltrace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;

/// Advice for memory that is about to be filled: it changes what page faults cost and nothing else. Blocks
/// too small to hold a huge page are left alone.
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
