// Just enough of an Spu for a cache: a local store, and DMA that moves data as late as it may.
#pragma once

#include "celltrace/spe/simd_host.hpp"
#include "celltrace/spe/spu.hpp"
#include "celltrace/spe/types.hpp"

#include <cstdint>
#include <cstring>
#include <new>
#include <stdexcept>
#include <vector>

namespace celltrace::test {

class FakeSpu {
public:
  static constexpr bool direct_memory = false;
  using simd = HostSimd<xsimd::sse2>;

  template <class T> T* allocate(std::uint32_t count = 1, std::uint32_t alignment = kLineBytes) {
    next_ = (next_ + alignment - 1) & ~(static_cast<std::size_t>(alignment) - 1);
    T* objects = reinterpret_cast<T*>(store_.bytes + next_);
    next_ += count * sizeof(T);
    if (next_ > kLocalStoreBytes) halt(HaltCode::local_store_exhausted);
    for (std::uint32_t i = 0; i < count; ++i)
      new (static_cast<void*>(objects + i)) T();
    return objects;
  }
  void get(void* ls, ea_t ea, std::uint32_t size, std::uint32_t tag) {
    const auto place = reinterpret_cast<std::uintptr_t>(ls);
    if (size % 16 != 0 || place % 16 != 0 || ea % 16 != 0) throw std::logic_error("misaligned transfer");
    if (size > kLineBytes || tag >= kMfcTags) throw std::logic_error("bad transfer");
    for (const Transfer& other : under_way_) {
      if (other.ls < place + size && place < other.ls + other.size) throw std::logic_error("transfers race");
    }
    std::memset(ls, 0xEE, size);
    under_way_.push_back({place, ea, size, tag});
    ++transfers_;
    bytes_ += size;
  }
  std::uint32_t wait_all(std::uint32_t mask) {
    std::vector<Transfer> left;
    for (const Transfer& transfer : under_way_) {
      if ((mask >> transfer.tag & 1) == 0)
        left.push_back(transfer);
      else
        std::memcpy(reinterpret_cast<void*>(transfer.ls), reinterpret_cast<const void*>(transfer.ea),
                    transfer.size);
    }
    under_way_ = left;
    return mask;
  }
  void compute(const ScalarWork&) {}
  [[noreturn]] void halt(HaltCode code) { throw code; }

  std::size_t local_store_used() const { return next_; }
  unsigned transfers() const { return transfers_; }
  unsigned bytes() const { return bytes_; }
  std::size_t under_way() const { return under_way_.size(); }

private:
  struct Transfer {
    std::uintptr_t ls;
    ea_t ea;
    std::uint32_t size;
    std::uint32_t tag;
  };
  struct alignas(kLineBytes) Store {
    unsigned char bytes[kLocalStoreBytes];
  };

  Store store_{};
  std::size_t next_ = 0;
  std::vector<Transfer> under_way_;
  unsigned transfers_ = 0;
  unsigned bytes_ = 0;
};

} // namespace celltrace::test
