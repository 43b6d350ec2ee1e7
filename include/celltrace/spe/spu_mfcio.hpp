// The SDK's <spu_mfcio.h>, for existing SPE sources in C or C++ on the emulated Cell: DMA, tag groups,
// mailboxes, signals, events and the decrementer under the SDK's names. All functions act on the SPE whose
// program runs on the present thread, and throw SpeError if no program runs. On a real SPU this header
// includes the compiler's own.
//
//   #define main saxpy_main
//   #include "saxpy.c"
//   #undef main
//   const EmulatedRun run = emulate(lockstep(2), spe_main(saxpy_main), to_ea(&control));
//
// Differences from the SDK: effective addresses have 64 bits, like main memory on a PC; DMA buffers have to
// be LocalStore objects or memory from EmulatedSpu::allocate(); macros of the SDK are functions here.
// docs/testing-spe-code.md has more.
#pragma once

#ifdef __SPU__
#include <spu_mfcio.h>
#else

#include "celltrace/spe/local_store.hpp"
#include "celltrace/spe/program.hpp"
#include "celltrace/spe/spu_intrinsics.hpp"
#include "celltrace/spe/spu_mfcio_constants.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>

constexpr unsigned int MFC_CMD_WORD(unsigned int tid, unsigned int rid, unsigned int command) {
  return tid << 24 | rid << 16 | command;
}

/// The SDK's list element; its bits have the places of ListElement's.
struct mfc_list_element_t {
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  uint32_t notify : 1;
  uint32_t reserved : 16;
  uint32_t size : 15;
#else
  uint32_t size : 15;
  uint32_t reserved : 16;
  uint32_t notify : 1;
#endif
  uint32_t eal;

  mfc_list_element_t() = default;
  /// Takes the fields in the SDK's order.
  constexpr mfc_list_element_t(uint32_t notify_bit, uint32_t reserved_bits, uint32_t bytes, uint32_t ea_low)
      : eal(ea_low) {
    notify = notify_bit & 1;
    reserved = reserved_bits & 0xFFFF;
    size = bytes & 0x7FFF;
  }
};
static_assert(sizeof(mfc_list_element_t) == sizeof(celltrace::ListElement));

// --- addresses ---

namespace celltrace::sdk {

/// An effective address as an argument of the SDK's functions: an integer of 64 bits, or a pointer of the
/// host.
struct EffectiveAddress {
  ea_t value;

  template <std::integral Integer> constexpr EffectiveAddress(Integer ea) : value(static_cast<ea_t>(ea)) {
    static_assert(sizeof(Integer) == sizeof(ea_t),
                  "an effective address has 64 bits here: keep it in an unsigned long long");
  }
  EffectiveAddress(const volatile void* pointer) : value(reinterpret_cast<uintptr_t>(pointer)) {}
};

} // namespace celltrace::sdk

inline unsigned int mfc_ea2h(celltrace::sdk::EffectiveAddress ea) {
  return static_cast<unsigned int>(ea.value >> 32);
}
inline unsigned int mfc_ea2l(celltrace::sdk::EffectiveAddress ea) {
  return static_cast<unsigned int>(ea.value);
}
constexpr unsigned long long mfc_hl2ea(unsigned int high, unsigned int low) {
  return static_cast<unsigned long long>(high) << 32 | low;
}
template <std::integral Integer> constexpr Integer mfc_ceil128(Integer value) {
  return (value + 127) & ~static_cast<Integer>(127);
}

namespace celltrace::sdk {

template <MfcOpcode op>
void command(const volatile void* ls, EffectiveAddress ea, uint32_t size, uint32_t tag, CallSite site) {
  spu_at(site).mfc_command<op>(local_pointer(ls), ea.value, size, tag);
}
template <MfcOpcode op>
void list_command(const volatile void* ls, EffectiveAddress ea, const volatile void* list, std::size_t bytes,
                  uint32_t tag, CallSite site) {
  // On a PC, a count times the size of an element has 64 bits, and may exceed 32.
  const auto length =
      static_cast<uint32_t>(std::min<std::size_t>(bytes, ListElement::list_bytes(~uint64_t{0})));
  spu_at(site).mfc_list_command<op>(local_pointer(ls), ea.value,
                                    static_cast<const ListElement*>(local_pointer(list)), length, tag);
}

} // namespace celltrace::sdk

// --- DMA ---
// The unnamed arguments tid and rid, the transfer and replacement classes, are ignored: they only affect
// speed.

inline void mfc_put(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, unsigned int size,
                    unsigned int tag, unsigned int, unsigned int,
                    celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::put>(ls, ea, size, tag, site);
}
inline void mfc_putf(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, unsigned int size,
                     unsigned int tag, unsigned int, unsigned int,
                     celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::putf>(ls, ea, size, tag, site);
}
inline void mfc_putb(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, unsigned int size,
                     unsigned int tag, unsigned int, unsigned int,
                     celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::putb>(ls, ea, size, tag, site);
}
inline void mfc_get(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, unsigned int size,
                    unsigned int tag, unsigned int, unsigned int,
                    celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::get>(ls, ea, size, tag, site);
}
inline void mfc_getf(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, unsigned int size,
                     unsigned int tag, unsigned int, unsigned int,
                     celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::getf>(ls, ea, size, tag, site);
}
inline void mfc_getb(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, unsigned int size,
                     unsigned int tag, unsigned int, unsigned int,
                     celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::getb>(ls, ea, size, tag, site);
}

// Lists: `bytes` is the size of the list, 8 for every element; only the high half of `ea` is used.

inline void mfc_putl(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, const volatile void* list,
                     std::size_t bytes, unsigned int tag, unsigned int, unsigned int,
                     celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::list_command<celltrace::MfcOpcode::putl>(ls, ea, list, bytes, tag, site);
}
inline void mfc_putlf(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, const volatile void* list,
                      std::size_t bytes, unsigned int tag, unsigned int, unsigned int,
                      celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::list_command<celltrace::MfcOpcode::putlf>(ls, ea, list, bytes, tag, site);
}
inline void mfc_putlb(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, const volatile void* list,
                      std::size_t bytes, unsigned int tag, unsigned int, unsigned int,
                      celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::list_command<celltrace::MfcOpcode::putlb>(ls, ea, list, bytes, tag, site);
}
inline void mfc_getl(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, const volatile void* list,
                     std::size_t bytes, unsigned int tag, unsigned int, unsigned int,
                     celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::list_command<celltrace::MfcOpcode::getl>(ls, ea, list, bytes, tag, site);
}
inline void mfc_getlf(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, const volatile void* list,
                      std::size_t bytes, unsigned int tag, unsigned int, unsigned int,
                      celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::list_command<celltrace::MfcOpcode::getlf>(ls, ea, list, bytes, tag, site);
}
inline void mfc_getlb(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, const volatile void* list,
                      std::size_t bytes, unsigned int tag, unsigned int, unsigned int,
                      celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::list_command<celltrace::MfcOpcode::getlb>(ls, ea, list, bytes, tag, site);
}

// Lock lines; mfc_read_atomic_status() returns the result of the first three.

inline void mfc_getllar(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, unsigned int,
                        unsigned int, celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::getllar>(ls, ea, celltrace::kLineBytes, 0, site);
}
inline void mfc_putllc(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, unsigned int,
                       unsigned int, celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::putllc>(ls, ea, celltrace::kLineBytes, 0, site);
}
inline void mfc_putlluc(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, unsigned int,
                        unsigned int, celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::putlluc>(ls, ea, celltrace::kLineBytes, 0, site);
}
inline void mfc_putqlluc(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, unsigned int tag,
                         unsigned int, unsigned int, celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::putqlluc>(ls, ea, celltrace::kLineBytes, tag, site);
}

// Signals and order.

inline void mfc_sndsig(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, unsigned int tag,
                       unsigned int, unsigned int, celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::sndsig>(ls, ea, 4, tag, site);
}
inline void mfc_sndsigf(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, unsigned int tag,
                        unsigned int, unsigned int, celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::sndsigf>(ls, ea, 4, tag, site);
}
inline void mfc_sndsigb(const volatile void* ls, celltrace::sdk::EffectiveAddress ea, unsigned int tag,
                        unsigned int, unsigned int, celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::sndsigb>(ls, ea, 4, tag, site);
}
inline void mfc_barrier(unsigned int tag, celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::barrier>(nullptr, nullptr, 0, tag, site);
}
inline void mfc_eieio(unsigned int tag, unsigned int, unsigned int,
                      celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::mfceieio>(nullptr, nullptr, 0, tag, site);
}
inline void mfc_sync(unsigned int tag, celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::mfcsync>(nullptr, nullptr, 0, tag, site);
}

// The cache of the PPE; mfc_sdcrz() zeroes lines of main storage.

inline void mfc_sdcrt(celltrace::sdk::EffectiveAddress ea, unsigned int size, unsigned int tag, unsigned int,
                      unsigned int, celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::sdcrt>(nullptr, ea, size, tag, site);
}
inline void mfc_sdcrtst(celltrace::sdk::EffectiveAddress ea, unsigned int size, unsigned int tag,
                        unsigned int, unsigned int, celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::sdcrtst>(nullptr, ea, size, tag, site);
}
inline void mfc_sdcrz(celltrace::sdk::EffectiveAddress ea, unsigned int size, unsigned int tag, unsigned int,
                      unsigned int, celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::sdcrz>(nullptr, ea, size, tag, site);
}
inline void mfc_sdcrst(celltrace::sdk::EffectiveAddress ea, unsigned int size, unsigned int tag, unsigned int,
                       unsigned int, celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::sdcrst>(nullptr, ea, size, tag, site);
}
inline void mfc_sdcrf(celltrace::sdk::EffectiveAddress ea, unsigned int size, unsigned int tag, unsigned int,
                      unsigned int, celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::command<celltrace::MfcOpcode::sdcrf>(nullptr, ea, size, tag, site);
}

// --- tag groups ---

inline unsigned int mfc_stat_cmd_queue(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readchcnt(MFC_Cmd, site);
}
inline void mfc_write_tag_mask(unsigned int mask, celltrace::CallSite site = celltrace::CallSite::here()) {
  spu_writech(MFC_WrTagMask, mask, site);
}
inline unsigned int mfc_read_tag_mask(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readch(MFC_RdTagMask, site);
}
inline void mfc_write_tag_update(unsigned int request,
                                 celltrace::CallSite site = celltrace::CallSite::here()) {
  spu_writech(MFC_WrTagUpdate, request, site);
}
inline void mfc_write_tag_update_immediate(celltrace::CallSite site = celltrace::CallSite::here()) {
  mfc_write_tag_update(MFC_TAG_UPDATE_IMMEDIATE, site);
}
inline void mfc_write_tag_update_any(celltrace::CallSite site = celltrace::CallSite::here()) {
  mfc_write_tag_update(MFC_TAG_UPDATE_ANY, site);
}
inline void mfc_write_tag_update_all(celltrace::CallSite site = celltrace::CallSite::here()) {
  mfc_write_tag_update(MFC_TAG_UPDATE_ALL, site);
}
inline unsigned int mfc_stat_tag_update(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readchcnt(MFC_WrTagUpdate, site);
}
inline unsigned int mfc_read_tag_status(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readch(MFC_RdTagStat, site);
}
inline unsigned int mfc_read_tag_status_immediate(celltrace::CallSite site = celltrace::CallSite::here()) {
  mfc_write_tag_update_immediate(site);
  return mfc_read_tag_status(site);
}
inline unsigned int mfc_read_tag_status_any(celltrace::CallSite site = celltrace::CallSite::here()) {
  mfc_write_tag_update_any(site);
  return mfc_read_tag_status(site);
}
inline unsigned int mfc_read_tag_status_all(celltrace::CallSite site = celltrace::CallSite::here()) {
  mfc_write_tag_update_all(site);
  return mfc_read_tag_status(site);
}
inline unsigned int mfc_stat_tag_status(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readchcnt(MFC_RdTagStat, site);
}
inline unsigned int mfc_read_list_stall_status(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readch(MFC_RdListStallStat, site);
}
inline unsigned int mfc_stat_list_stall_status(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readchcnt(MFC_RdListStallStat, site);
}
inline void mfc_write_list_stall_ack(unsigned int tag,
                                     celltrace::CallSite site = celltrace::CallSite::here()) {
  spu_writech(MFC_WrListStallAck, tag, site);
}
inline unsigned int mfc_read_atomic_status(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readch(MFC_RdAtomicStat, site);
}
inline unsigned int mfc_stat_atomic_status(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readchcnt(MFC_RdAtomicStat, site);
}
inline void mfc_write_multi_src_sync_request(celltrace::CallSite site = celltrace::CallSite::here()) {
  spu_writech(MFC_WrMSSyncReq, 0, site);
}
inline unsigned int mfc_stat_multi_src_sync_request(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readchcnt(MFC_WrMSSyncReq, site);
}

// --- mailboxes, signals, events, the decrementer ---

inline unsigned int spu_read_in_mbox(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readch(SPU_RdInMbox, site);
}
inline unsigned int spu_stat_in_mbox(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readchcnt(SPU_RdInMbox, site);
}
inline void spu_write_out_mbox(unsigned int value, celltrace::CallSite site = celltrace::CallSite::here()) {
  spu_writech(SPU_WrOutMbox, value, site);
}
inline unsigned int spu_stat_out_mbox(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readchcnt(SPU_WrOutMbox, site);
}
inline void spu_write_out_intr_mbox(unsigned int value,
                                    celltrace::CallSite site = celltrace::CallSite::here()) {
  spu_writech(SPU_WrOutIntrMbox, value, site);
}
inline unsigned int spu_stat_out_intr_mbox(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readchcnt(SPU_WrOutIntrMbox, site);
}
inline unsigned int spu_read_signal1(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readch(SPU_RdSigNotify1, site);
}
inline unsigned int spu_stat_signal1(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readchcnt(SPU_RdSigNotify1, site);
}
inline unsigned int spu_read_signal2(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readch(SPU_RdSigNotify2, site);
}
inline unsigned int spu_stat_signal2(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readchcnt(SPU_RdSigNotify2, site);
}
inline unsigned int spu_read_event_status(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readch(SPU_RdEventStat, site);
}
inline unsigned int spu_stat_event_status(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readchcnt(SPU_RdEventStat, site);
}
inline void spu_write_event_mask(unsigned int mask, celltrace::CallSite site = celltrace::CallSite::here()) {
  spu_writech(SPU_WrEventMask, mask, site);
}
inline unsigned int spu_read_event_mask(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readch(SPU_RdEventMask, site);
}
inline void spu_write_event_ack(unsigned int events, celltrace::CallSite site = celltrace::CallSite::here()) {
  spu_writech(SPU_WrEventAck, events, site);
}
inline unsigned int spu_read_decrementer(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readch(SPU_RdDec, site);
}
inline void spu_write_decrementer(unsigned int value,
                                  celltrace::CallSite site = celltrace::CallSite::here()) {
  spu_writech(SPU_WrDec, value, site);
}
inline unsigned int spu_read_machine_status(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readch(SPU_RdMachStat, site);
}
inline void spu_write_srr0(unsigned int address, celltrace::CallSite site = celltrace::CallSite::here()) {
  spu_writech(SPU_WrSRR0, address, site);
}
inline unsigned int spu_read_srr0(celltrace::CallSite site = celltrace::CallSite::here()) {
  return spu_readch(SPU_RdSRR0, site);
}

// --- the tag manager ---

namespace celltrace::sdk {

/// The tags that an SPE's program has reserved, one bit each.
inline LocalStore<uint32_t, 16> reserved_tags;

/// Returns the bits of `count` tags from `tag` on; 0 if not all of these tags exist.
constexpr uint32_t tag_bits(unsigned int tag, unsigned int count) {
  if (count == 0 || count > kMfcTags || tag > kMfcTags - count) return 0;
  return static_cast<uint32_t>(((uint64_t{1} << count) - 1) << tag);
}

} // namespace celltrace::sdk

/// Reserves `count` consecutive free tags and returns the first tag, or MFC_TAG_INVALID if no such tags are
/// free.
inline unsigned int mfc_multi_tag_reserve(unsigned int count) {
  uint32_t& reserved = *celltrace::sdk::reserved_tags;
  for (unsigned int tag = 0; tag < celltrace::kMfcTags; ++tag) {
    const uint32_t bits = celltrace::sdk::tag_bits(tag, count);
    if (bits == 0 || (reserved & bits) != 0) continue;
    reserved |= bits;
    return tag;
  }
  return MFC_TAG_INVALID;
}
/// Releases `count` tags from `tag` on. Returns MFC_TAG_INVALID, and releases nothing, unless all these tags
/// are reserved.
inline unsigned int mfc_multi_tag_release(unsigned int tag, unsigned int count) {
  uint32_t& reserved = *celltrace::sdk::reserved_tags;
  const uint32_t bits = celltrace::sdk::tag_bits(tag, count);
  if (bits == 0 || (reserved & bits) != bits) return MFC_TAG_INVALID;
  reserved &= ~bits;
  return MFC_TAG_VALID;
}
inline unsigned int mfc_tag_reserve() {
  return mfc_multi_tag_reserve(1);
}
inline unsigned int mfc_tag_release(unsigned int tag) {
  return mfc_multi_tag_release(tag, 1);
}

namespace celltrace {

/// Makes a program for emulate() of the renamed `main(speid, argp, envp)` of an SPE program, which may take
/// fewer arguments. The result of `main` is the exit code.
template <class... Arguments> auto spe_main(int (*main_function)(Arguments...), unsigned long long envp = 0) {
  static_assert(sizeof...(Arguments) <= 3, "main(speid, argp, envp)");
  return [main_function, envp](cell_emu::Spu& spu, ea_t argp) {
    const unsigned long long given[] = {spu.id(), argp, envp};
    const auto call = [&]<std::size_t... i>(std::index_sequence<i...>) {
      return main_function(static_cast<Arguments>(given[i])...);
    };
    throw SpeExit{static_cast<uint32_t>(call(std::index_sequence_for<Arguments...>())) & 0xFF};
  };
}

} // namespace celltrace

#endif
