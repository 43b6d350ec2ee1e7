#include "memory/aligned_block.hpp"

#include "memory/huge_pages.hpp"

#include <cstdlib>
#include <cstring>
#include <new>

namespace celltrace {

namespace {

constexpr std::size_t kLine = 128;

std::size_t round_up(std::size_t bytes, std::size_t unit) {
  return (bytes + unit - 1) / unit * unit;
}

} // namespace

void AlignedBlock::Free::operator()(std::byte* bytes) const noexcept {
  std::free(bytes);
}

AlignedBlock AlignedBlock::uninitialised(std::size_t bytes, Pages pages) {
  // Huge pages pay for at least half a huge page: filling one takes a fifth of the time of as many normal
  // pages.
  const bool large = pages == Pages::huge && bytes >= kHugePage / 2;
  const std::size_t unit = large ? kHugePage : kLine;
  const std::size_t whole = round_up(bytes == 0 ? 1 : bytes, unit);
  AlignedBlock block;
  block.bytes_.reset(static_cast<std::byte*>(std::aligned_alloc(unit, whole)));
  if (!block.bytes_) throw std::bad_alloc();
  block.size_ = bytes;
  if (large) use_huge_pages(block.bytes_.get(), whole);
  return block;
}

AlignedBlock::AlignedBlock(std::size_t bytes) : AlignedBlock(uninitialised(bytes)) {
  std::memset(data(), 0, bytes);
}

void AlignedBlock::reserve(std::size_t bytes) {
  if (bytes <= size_) return;
  *this = AlignedBlock(); // frees the old block before it takes the new one
  *this = uninitialised(bytes);
}

} // namespace celltrace
