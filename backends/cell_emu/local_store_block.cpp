#include "backends/cell_emu/local_store_block.hpp"

#include "backends/cell_emu/access_checkers.hpp"
#include "backends/cell_emu/local_store_watch.hpp"

#include <cstring>
#include <new>

#if defined(__unix__) || defined(__APPLE__)
#define CELLTRACE_HAS_MMAP 1
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace celltrace::cell_emu {
namespace {

constexpr std::uint32_t kEdgeBytes = 4096;
constexpr std::size_t kAlignment = kLocalStoreBytes;

} // namespace

#ifdef CELLTRACE_HAS_MMAP
LocalStoreBlock::LocalStoreBlock(unsigned spes) : bytes_(kLocalStoreBytes + spes * kStride) {
  memory_bytes_ = bytes_ + kAlignment;
  memory_ = mmap(nullptr, memory_bytes_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory_ == MAP_FAILED) throw std::bad_alloc();
  const auto address = reinterpret_cast<std::uintptr_t>(memory_);
  begin_ = static_cast<std::uint8_t*>(memory_) + (kAlignment - address % kAlignment) % kAlignment;
  // The former user of these addresses, such as a stack, may have left them forbidden to access checkers.
  permit_access(begin_, bytes_);
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t edge = (kEdgeBytes + page - 1) / page * page;
  for (unsigned spe = 0; spe < spes; ++spe) {
    if (mprotect(local_store(spe) - edge, kLocalStoreBytes + 2 * edge, PROT_READ | PROT_WRITE) != 0) {
      munmap(memory_, memory_bytes_);
      throw std::bad_alloc();
    }
    take_overrun(spe);
  }
}

LocalStoreBlock::~LocalStoreBlock() {
  // Memory that is mapped here next must not be forbidden.
  permit_access(begin_, bytes_);
  munmap(memory_, memory_bytes_);
}
#else
LocalStoreBlock::LocalStoreBlock(unsigned spes) : bytes_(kLocalStoreBytes + spes * kStride) {
  begin_ = new (std::align_val_t{kAlignment}) std::uint8_t[bytes_];
  for (unsigned spe = 0; spe < spes; ++spe) {
    std::memset(local_store(spe), 0, kLocalStoreBytes);
    take_overrun(spe);
  }
}

LocalStoreBlock::~LocalStoreBlock() {
  permit_access(begin_, bytes_);
  ::operator delete[](begin_, std::align_val_t{kAlignment});
}
#endif

bool LocalStoreBlock::is_intact(const std::uint8_t* at, std::uint32_t bytes) {
  permit_access(at, bytes);
  const bool intact = is_poison(at, bytes);
  forbid_access(at, bytes);
  return intact;
}

std::optional<std::int64_t> LocalStoreBlock::first_change(unsigned spe, const std::uint8_t* edge) const {
  constexpr std::uint32_t kWord = 8;
  if (is_intact(edge, kEdgeBytes)) return std::nullopt;
  while (is_intact(edge, kWord))
    edge += kWord;
  return edge - local_store(spe);
}

std::optional<std::int64_t> LocalStoreBlock::take_overrun(unsigned spe) const {
  std::uint8_t* const edges[] = {local_store(spe) - kEdgeBytes, local_store(spe) + kLocalStoreBytes};
  std::optional<std::int64_t> first;
  for (std::uint8_t* const edge : edges) {
    if (!first) first = first_change(spe, edge);
    permit_access(edge, kEdgeBytes);
    fill_with_poison(edge, kEdgeBytes);
    forbid_access(edge, kEdgeBytes);
  }
  return first;
}

} // namespace celltrace::cell_emu
