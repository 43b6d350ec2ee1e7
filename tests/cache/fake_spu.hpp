// Just enough of an Spu for a cache: a local store, and DMA that moves data as late as it may, when it is
// waited for.
#pragma once

#include "celltrace/spe/simd_host.hpp"
#include "celltrace/spe/spu.hpp"
#include "celltrace/spe/types.hpp"

#include <cstdint>
#include <cstring>
#include <functional>
#include <new>
#include <stdexcept>
#include <vector>

namespace celltrace::test {

class FakeSpu {
public:
  static constexpr bool direct_memory = false;
  using simd = HostSimd<BaselineArch>;

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
    start({reinterpret_cast<std::uintptr_t>(ls), ea, size, tag, false});
    std::memset(ls, 0xEE, size);
  }
  void put(const void* ls, ea_t ea, std::uint32_t size, std::uint32_t tag) {
    start({reinterpret_cast<std::uintptr_t>(ls), ea, size, tag, true});
  }
  std::uint32_t wait_all(std::uint32_t mask) {
    ++waits_;
    std::vector<Transfer> left;
    for (const Transfer& transfer : in_flight_) {
      if ((mask >> transfer.tag & 1) == 0)
        left.push_back(transfer);
      else
        move(transfer);
    }
    in_flight_ = left;
    return mask;
  }
  void getllar(void* ls, ea_t ea) {
    std::memcpy(ls, reinterpret_cast<const void*>(ea), kLineBytes);
    std::memcpy(reserved_, ls, kLineBytes);
    if (after_getllar) after_getllar();
  }
  bool putllc(const void* ls, ea_t ea) {
    if (std::memcmp(reinterpret_cast<const void*>(ea), reserved_, kLineBytes) != 0) return false;
    std::memcpy(reinterpret_cast<void*>(ea), ls, kLineBytes);
    return true;
  }
  void compute(const ScalarWork&) {}
  void record(const void*, std::uint32_t word) { recorded.push_back(word); }
  [[noreturn]] void halt(HaltCode code) { throw code; }

  std::size_t local_store_used() const { return next_; }
  std::function<void()> after_getllar; ///< what others do to main memory
  std::vector<std::uint32_t> recorded;

  unsigned transfers() const { return transfers_; }
  unsigned bytes() const { return bytes_; }
  unsigned waits() const { return waits_; }
  std::size_t in_flight() const { return in_flight_.size(); }

private:
  struct Transfer {
    std::uintptr_t ls;
    ea_t ea;
    std::uint32_t size;
    std::uint32_t tag;
    bool put;
  };
  struct alignas(kLineBytes) Store {
    unsigned char bytes[kLocalStoreBytes];
  };

  void start(const Transfer& transfer) {
    if (transfer.size % 16 != 0 || transfer.ls % 16 != 0 || transfer.ea % 16 != 0)
      throw std::logic_error("misaligned transfer");
    if (transfer.size > kLineBytes || transfer.tag >= kMfcTags) throw std::logic_error("bad transfer");
    for (const Transfer& other : in_flight_) {
      if (other.ls < transfer.ls + transfer.size && transfer.ls < other.ls + other.size)
        throw std::logic_error("transfers race");
      if ((other.put || transfer.put) && other.ea < transfer.ea + transfer.size &&
          transfer.ea < other.ea + other.size)
        throw std::logic_error("transfers race in main memory");
    }
    in_flight_.push_back(transfer);
    ++transfers_;
    bytes_ += transfer.size;
  }
  static void move(const Transfer& transfer) {
    auto* ls = reinterpret_cast<void*>(transfer.ls);
    auto* ea = reinterpret_cast<void*>(transfer.ea);
    std::memcpy(transfer.put ? ea : ls, transfer.put ? ls : ea, transfer.size);
  }

  Store store_{};
  unsigned char reserved_[kLineBytes]{};
  std::size_t next_ = 0;
  std::vector<Transfer> in_flight_;
  unsigned transfers_ = 0;
  unsigned waits_ = 0;
  unsigned bytes_ = 0;
};

} // namespace celltrace::test
