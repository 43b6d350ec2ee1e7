#include "backends/cell_emu/simulator/ppe/ea_heap.hpp"

#include <algorithm>

#include <sys/mman.h>

namespace celltrace::cell_emu {

namespace {

#ifdef MAP_FIXED_NOREPLACE
constexpr int kOnlyThere = MAP_FIXED_NOREPLACE;
#else
constexpr int kOnlyThere = 0;
#endif

std::uint64_t round_up(std::uint64_t value, std::uint64_t unit) {
  return (value + unit - 1) / unit * unit;
}

std::uint8_t* map(std::uint64_t hint, std::uint64_t bytes, int flags) {
  void* memory = ::mmap(reinterpret_cast<void*>(hint), static_cast<std::size_t>(bytes),
                        PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | flags, -1, 0);
  return memory != MAP_FAILED ? static_cast<std::uint8_t*>(memory) : nullptr;
}

std::uint64_t address_of(const std::uint8_t* memory) {
  return reinterpret_cast<std::uintptr_t>(memory);
}

} // namespace

EaHeap::EaHeap(std::uint64_t most_bytes) : most_bytes_(most_bytes / kAlignment * kAlignment) {
}

EaHeap::~EaHeap() {
  if (memory_ != nullptr) ::munmap(memory_, static_cast<std::size_t>(most_bytes_));
}

bool EaHeap::reserve() {
  if (memory_ != nullptr) return true;
  if (most_bytes_ == 0) return false;
  constexpr std::uint64_t kFirst = 0x2000'0000, kStep = 0x1000'0000, kEnd = 0x1'0000'0000;
  for (std::uint64_t start = kFirst; memory_ == nullptr && start + most_bytes_ <= kEnd; start += kStep) {
    memory_ = map(start, most_bytes_, kOnlyThere);
    if (memory_ == nullptr || address_of(memory_) == start) continue;
    ::munmap(memory_, static_cast<std::size_t>(most_bytes_)); // an old system took the address as a hint only
    memory_ = nullptr;
  }
  if (memory_ == nullptr) memory_ = map(0, most_bytes_, 0);
  if (memory_ != nullptr) add_free(address_of(memory_), most_bytes_);
  return memory_ != nullptr;
}

std::uint64_t EaHeap::allocate(std::uint64_t bytes, std::uint64_t alignment) {
  if (bytes > most_bytes_ || alignment > most_bytes_ || !reserve()) return 0;
  alignment = std::max(alignment, kAlignment);
  const std::uint64_t reserved = std::max(round_up(bytes, kAlignment), kAlignment);
  // Find the smallest free range that has room for the block and its alignment, wherever the range starts.
  const auto fitting = free_by_size_.lower_bound({reserved + alignment - kAlignment, 0});
  if (fitting == free_by_size_.end()) return 0;
  const auto [size, start] = *fitting;
  remove_free(free_.find(start));
  const std::uint64_t ea = round_up(start, alignment), end = ea + reserved;
  if (ea > start) add_free(start, ea - start);
  if (end < start + size) add_free(end, start + size - end);
  used_[ea] = {reserved, bytes};
  return ea;
}

bool EaHeap::release(std::uint64_t ea) {
  const auto block = used_.find(ea);
  if (block == used_.end()) return false;
  std::uint64_t start = ea, end = ea + block->second.reserved;
  used_.erase(block);
  const auto after = free_.lower_bound(ea);
  if (after != free_.begin()) {
    const auto before = std::prev(after);
    if (before->first + before->second == start) {
      start = before->first;
      remove_free(before);
    }
  }
  if (after != free_.end() && after->first == end) {
    end += after->second;
    remove_free(after);
  }
  add_free(start, end - start);
  return true;
}

std::optional<std::uint64_t> EaHeap::bytes_at(std::uint64_t ea) const {
  const auto block = used_.find(ea);
  if (block == used_.end()) return std::nullopt;
  return block->second.bytes;
}

std::uint8_t* EaHeap::at(std::uint64_t ea, std::uint64_t bytes) const {
  auto block = used_.upper_bound(ea);
  if (block == used_.begin()) return nullptr;
  --block;
  const std::uint64_t offset = ea - block->first;
  if (offset > block->second.reserved || bytes > block->second.reserved - offset) return nullptr;
  return memory_ + (ea - address_of(memory_));
}

void EaHeap::add_free(std::uint64_t ea, std::uint64_t bytes) {
  free_.emplace(ea, bytes);
  free_by_size_.emplace(bytes, ea);
}

void EaHeap::remove_free(std::map<std::uint64_t, std::uint64_t>::iterator free) {
  free_by_size_.erase({free->second, free->first});
  free_.erase(free);
}

} // namespace celltrace::cell_emu
