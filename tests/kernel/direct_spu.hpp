// Just enough of an Spu for kernels to run in the test's own thread, with direct memory.
#pragma once

#include "celltrace/spe/simd_host.hpp"
#include "celltrace/spe/spu.hpp"
#include "celltrace/spe/types.hpp"
#include "kernel/direct/strategy.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>

namespace celltrace::test {

class DirectSpu {
public:
  static constexpr bool direct_memory = true;
  std::uint32_t id() const { return 0; }
  using simd = HostSimd<BaselineArch>;
  using rare_simd = simd;

  template <class T> T* allocate(std::uint32_t count = 1, std::uint32_t alignment = kLineBytes) {
    next_ = (next_ + alignment - 1) & ~(std::size_t{alignment} - 1);
    T* objects = reinterpret_cast<T*>(store_->bytes + next_);
    next_ += count * sizeof(T);
    if (next_ > kLocalStoreBytes) halt(HaltCode::local_store_exhausted);
    for (std::uint32_t i = 0; i < count; ++i)
      new (static_cast<void*>(objects + i)) T();
    return objects;
  }
  std::uint8_t* mark() { return store_->bytes + next_; }
  void release(std::uint8_t* marked) { next_ = static_cast<std::size_t>(marked - store_->bytes); }

  void put(const void* ls, ea_t ea, std::uint32_t size, std::uint32_t) {
    std::memcpy(reinterpret_cast<void*>(static_cast<std::uintptr_t>(ea)), ls, size);
  }
  void putl(const void* ls, ea_t ea, const ListElement* list, std::uint32_t elements, std::uint32_t) {
    const auto* from = static_cast<const std::uint8_t*>(ls);
    for (std::uint32_t i = 0; i < elements; ++i) {
      const std::uint32_t size = list[i].notify_and_size;
      const ea_t to = (ea & ~ea_t{0xFFFFFFFF}) | list[i].ea_low;
      std::memcpy(reinterpret_cast<void*>(static_cast<std::uintptr_t>(to)), from, size);
      from += size;
    }
  }
  std::uint32_t wait_all(std::uint32_t mask) { return mask; }
  void enter_module(const CodeModule&) {}
  void run_in_module(const CodeModule&) {}
  void compute(const ScalarWork&) {}
  [[noreturn]] void halt(HaltCode) { throw std::length_error("the kernel halted"); }

private:
  struct alignas(kLineBytes) Store {
    std::uint8_t bytes[kLocalStoreBytes];
  };
  std::unique_ptr<Store> store_ = std::make_unique<Store>();
  std::size_t next_ = 0;
};

} // namespace celltrace::test
