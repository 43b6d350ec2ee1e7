// The SPU of a real SPE: the interface of celltrace/spe/spu.hpp as inline wrappers over the channel
// intrinsics of spu-elf-g++.
#pragma once

#include "backends/spu/quad_simd.hpp"
#include "celltrace/spe/control_block.hpp"
#include "celltrace/spe/spu.hpp"

#include <spu_intrinsics.h>
#include <spu_mfcio.h>
#include <stdint.h>

namespace celltrace::spu {

/// A real SPU. If a command breaks a rule that the MFC checks, the MFC stops the SPE. halt() stops the SPE
/// with the signal kHaltStop + code, which libspe2 reports as SPE_STOP_AND_SIGNAL.
class Spu : public SpuBase<Spu> {
public:
  static constexpr bool direct_memory = false;
  static constexpr const char* kKey = "spu";
  using simd = Simd;
  using rare_simd = QuadSimd;

  /// Makes the SPU. `arena` is `bytes` bytes of local store, `control_block` the effective address of the
  /// ControlBlock.
  Spu(ea_t control_block, uint8_t* arena, uint32_t bytes) : arena_{arena, arena + bytes, arena} {
    initialise_base();
    control_ = fetch<ControlBlock>(control_block, 1);
    addresses_ = fetch<SpeAddresses>(control_->addresses, control_->count);
  }
  Spu(const Spu&) = delete;
  Spu& operator=(const Spu&) = delete;

  uint32_t id() const { return control_->id; }
  uint32_t count() const { return control_->count; }
  /// Returns the argument of the kernel.
  ea_t argument() const { return control_->argument; }
  /// Returns the address of the program's file, from which code modules are fetched.
  ea_t program_image() const { return control_->image; }
  const SpeAddresses& addresses(uint32_t spe) const { return addresses_[spe]; }

  template <Channel c> uint32_t read_channel() {
    order_memory<c>();
    const uint32_t value = spu_readch(static_cast<int>(c));
    order_memory<c>();
    return value;
  }
  template <Channel c> void write_channel(uint32_t value) {
    order_memory<c>();
    spu_writech(static_cast<int>(c), static_cast<unsigned>(value));
    order_memory<c>();
  }
  template <Channel c> uint32_t channel_count() { return spu_readchcnt(static_cast<int>(c)); }

  template <MfcOpcode op> void mfc_command(void* ls, ea_t ea, uint32_t size, uint32_t tag) {
    enqueue<op>(ls, ea, static_cast<uint32_t>(ea), size, tag);
  }
  template <MfcOpcode op>
  void mfc_list_command(void* ls, ea_t ea, const ListElement* list, uint32_t bytes, uint32_t tag) {
    enqueue<op>(ls, ea, static_cast<uint32_t>(reinterpret_cast<uintptr_t>(list)), bytes, tag);
  }

  /// Stops. The PPE may read and change local store and main storage before it lets the SPU go on.
  template <uint32_t code> void stop() {
    __asm__ volatile("" ::: "memory");
    spu_stop(code);
    __asm__ volatile("" ::: "memory");
  }
  [[noreturn]] void halt(HaltCode code) {
    // The code is part of the stop instruction, so each code needs an instruction of its own.
    switch (code) {
    case HaltCode::local_store_exhausted:
      stop_for_good<HaltCode::local_store_exhausted>();
    case HaltCode::bad_argument:
      stop_for_good<HaltCode::bad_argument>();
    case HaltCode::stale_pointer:
      stop_for_good<HaltCode::stale_pointer>();
    case HaltCode::internal_error:
      break;
    }
    stop_for_good<HaltCode::internal_error>();
  }
  ArenaState& arena() { return arena_; }

private:
  /// Keeps the compiler from moving memory accesses across a channel access. With -msafe-dma the compiler
  /// moves no accesses across channels 21 to 27, but it still moves them across mailboxes, signals and
  /// events, by which other processors announce that memory has changed.
  template <Channel c> static void order_memory() {
    constexpr bool ordered_by_compiler = c >= Channel::mfc_cmd && c <= Channel::rd_atomic_stat;
    if constexpr (!ordered_by_compiler) __asm__ volatile("" ::: "memory");
  }
  template <MfcOpcode op>
  static void enqueue(void* ls, ea_t ea, uint32_t ea_low, uint32_t size, uint32_t tag) {
    spu_mfcdma64(ls, static_cast<uint32_t>(ea >> 32), ea_low, size, tag, static_cast<uint32_t>(op));
  }
  template <HaltCode code> [[noreturn]] static void stop_for_good() {
    for (;;)
      spu_stop(kHaltStop + static_cast<uint32_t>(code));
  }
  template <class Record> const Record* fetch(ea_t ea, uint32_t count) {
    Record* records = allocate<Record>(count, 16);
    get(records, ea, count * static_cast<uint32_t>(sizeof(Record)), kRuntimeTag);
    wait_all(1u << kRuntimeTag);
    return records;
  }

  ArenaState arena_;
  const ControlBlock* control_ = nullptr;
  const SpeAddresses* addresses_ = nullptr;
};

} // namespace celltrace::spu
