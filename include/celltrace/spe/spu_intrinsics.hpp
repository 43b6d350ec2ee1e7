// The SDK's <spu_intrinsics.h>, for existing SPE sources on the emulated Cell: vector types, and the specific
// (si_*) and generic (spu_*) intrinsics of the C/C++ Language Extensions for Cell. This file defines the
// intrinsics of channels, interrupts and run control. They act on the SPE whose program runs on the present
// thread, and throw SpeError if no program runs. On a real SPU this header includes the compiler's own.
#pragma once

#ifdef __SPU__
#include <spu_intrinsics.h>
#else

#include "celltrace/spe/emulated_spu.hpp"
#include "celltrace/spe/spu_generic.hpp"
#include "celltrace/spe/spu_specific.hpp"

// --- channels by number ---

constexpr unsigned int SPU_RdEventStat = 0;
constexpr unsigned int SPU_WrEventMask = 1;
constexpr unsigned int SPU_WrEventAck = 2;
constexpr unsigned int SPU_RdSigNotify1 = 3;
constexpr unsigned int SPU_RdSigNotify2 = 4;
constexpr unsigned int SPU_WrDec = 7;
constexpr unsigned int SPU_RdDec = 8;
constexpr unsigned int MFC_WrMSSyncReq = 9;
constexpr unsigned int SPU_RdEventMask = 11;
constexpr unsigned int MFC_RdTagMask = 12;
constexpr unsigned int SPU_RdMachStat = 13;
constexpr unsigned int SPU_WrSRR0 = 14;
constexpr unsigned int SPU_RdSRR0 = 15;
constexpr unsigned int MFC_LSA = 16; ///< channel that takes an offset in local store, see spu_ls_address()
constexpr unsigned int MFC_EAH = 17;
constexpr unsigned int MFC_EAL = 18;
constexpr unsigned int MFC_Size = 19;
constexpr unsigned int MFC_TagID = 20;
constexpr unsigned int MFC_Cmd = 21;
constexpr unsigned int MFC_WrTagMask = 22;
constexpr unsigned int MFC_WrTagUpdate = 23;
constexpr unsigned int MFC_RdTagStat = 24;
constexpr unsigned int MFC_RdListStallStat = 25;
constexpr unsigned int MFC_WrListStallAck = 26;
constexpr unsigned int MFC_RdAtomicStat = 27;
constexpr unsigned int SPU_WrOutMbox = 28;
constexpr unsigned int SPU_RdInMbox = 29;
constexpr unsigned int SPU_WrOutIntrMbox = 30;

// --- spu_testsv(): values to test for ---

constexpr int SPU_SV_NEG_DENORM = 0x01;
constexpr int SPU_SV_POS_DENORM = 0x02;
constexpr int SPU_SV_NEG_ZERO = 0x04;
constexpr int SPU_SV_POS_ZERO = 0x08;
constexpr int SPU_SV_NEG_INFINITY = 0x10;
constexpr int SPU_SV_POS_INFINITY = 0x20;
constexpr int SPU_SV_NAN = 0x40;

namespace celltrace::sdk {

/// Returns the running SPE's Spu, and notes `site` as the place of the next operation.
inline cell_emu::Spu& spu_at(CallSite site) {
  cell_emu::Spu& spu = cell_emu::Spu::running();
  spu.at(site);
  return spu;
}

inline void* local_pointer(const volatile void* ls) {
  return const_cast<void*>(ls);
}

} // namespace celltrace::sdk

inline unsigned int spu_readch(unsigned int channel, celltrace::CallSite site = celltrace::CallSite::here()) {
  return celltrace::sdk::spu_at(site).read_channel(channel);
}
inline void spu_writech(unsigned int channel, unsigned int value,
                        celltrace::CallSite site = celltrace::CallSite::here()) {
  celltrace::sdk::spu_at(site).write_channel(channel, value);
}
inline unsigned int spu_readchcnt(unsigned int channel,
                                  celltrace::CallSite site = celltrace::CallSite::here()) {
  return celltrace::sdk::spu_at(site).channel_count(channel);
}

// Channel access with the value in the preferred slot of a register.

inline qword si_rdch(unsigned int channel, celltrace::CallSite site = celltrace::CallSite::here()) {
  return si_from_uint(spu_readch(channel, site));
}
inline qword si_rchcnt(unsigned int channel, celltrace::CallSite site = celltrace::CallSite::here()) {
  return si_from_uint(spu_readchcnt(channel, site));
}
inline void si_wrch(unsigned int channel, qword value,
                    celltrace::CallSite site = celltrace::CallSite::here()) {
  spu_writech(channel, si_to_uint(value), site);
}
inline vec_uint4 spu_readchqw(unsigned int channel, celltrace::CallSite site = celltrace::CallSite::here()) {
  return vec_uint4(si_rdch(channel, site));
}
template <celltrace::sdk::AnyVector V>
void spu_writechqw(unsigned int channel, const V& value,
                   celltrace::CallSite site = celltrace::CallSite::here()) {
  si_wrch(channel, qword(celltrace::sdk::VectorOf<V>(value)), site);
}

// --- MFC commands by their opcode ---

/// Returns the local-store address of a pointer, which on a real SPU is the pointer cast to unsigned int. Not
/// part of the SDK.
inline unsigned int spu_ls_address(const volatile void* pointer) {
  return celltrace::cell_emu::Spu::running().local_address(celltrace::sdk::local_pointer(pointer));
}

inline qword si_from_ptr(const volatile void* pointer) {
  return si_from_uint(pointer == nullptr ? 0 : spu_ls_address(pointer));
}
/// Returns the pointer to a local-store address; null for the address 0.
inline void* si_to_ptr(qword ra) {
  const unsigned int lsa = si_to_uint(ra);
  return lsa == 0 ? nullptr : static_cast<char*>(celltrace::sdk::local_quadword(lsa)) + (lsa & 15);
}

/// Issues a command with the high half of the effective address (EAH) that was written last. For a list
/// command, `eal` is the list's spu_ls_address().
inline void spu_mfcdma32(const volatile void* ls, unsigned int eal, unsigned int size, unsigned int tag,
                         unsigned int command, celltrace::CallSite site = celltrace::CallSite::here()) {
  spu_writech(MFC_LSA, ls == nullptr ? 0 : spu_ls_address(ls), site);
  spu_writech(MFC_EAL, eal, site);
  spu_writech(MFC_Size, size, site);
  spu_writech(MFC_TagID, tag, site);
  spu_writech(MFC_Cmd, command, site);
}
inline void spu_mfcdma64(const volatile void* ls, unsigned int eah, unsigned int eal, unsigned int size,
                         unsigned int tag, unsigned int command,
                         celltrace::CallSite site = celltrace::CallSite::here()) {
  spu_writech(MFC_EAH, eah, site);
  spu_mfcdma32(ls, eal, size, tag, command, site);
}

/// Requests a tag status (`type`: 0 immediate, 1 any, 2 all), waits for it, and returns it.
inline unsigned int spu_mfcstat(unsigned int type, celltrace::CallSite site = celltrace::CallSite::here()) {
  spu_writech(MFC_WrTagUpdate, type, site);
  return spu_readch(MFC_RdTagStat, site);
}

// --- events and interrupts ---

/// Calls `handler()` if the event status has a count.
template <class Handler> void spu_bisled(Handler handler) {
  celltrace::cell_emu::Spu::running().branch_if_event([&](auto&) { handler(); });
}
/// Enables interrupts with the last handler of EmulatedSpu::enable_interrupts(), which stands for the code at
/// address 0 of a real SPU's local store. Throws SpeError if there is no handler.
inline void spu_ienable() {
  celltrace::cell_emu::Spu::running().enable_interrupts();
}
inline void spu_idisable() {
  celltrace::cell_emu::Spu::running().disable_interrupts();
}
/// As spu_bisled(), and disables (_d) or enables (_e) interrupts if it calls `handler`.
template <class Handler> void spu_bisled_d(Handler handler) {
  celltrace::cell_emu::Spu::running().branch_if_event([&](auto& spu) {
    spu.disable_interrupts();
    handler();
  });
}
template <class Handler> void spu_bisled_e(Handler handler) {
  celltrace::cell_emu::Spu::running().branch_if_event([&](auto& spu) {
    spu.enable_interrupts();
    handler();
  });
}

inline unsigned int spu_mfspr(int number) {
  return si_to_uint(si_mfspr(number));
}
inline void spu_mtspr(int number, unsigned int value) {
  si_mtspr(number, si_from_uint(value));
}

// --- run control ---

/// Stops with a code, which has to be a constant, because it is part of the instruction.
#define spu_stop(code) (celltrace::cell_emu::Spu::running().stop_and_signal<(code)>())

#define si_stop(code) spu_stop(code)
/// Stops with the code 0x3FFF; the registers are for debuggers.
#define si_stopd(ra, rb, rc) ((void)(ra), (void)(rb), (void)(rc), spu_stop(0x3FFF))

/// Does nothing: a hint for optimisers.
#define __align_hint(pointer, base, offset) ((void)0)

// Does nothing: loads and stores are in order on the emulated Cell.
inline void spu_sync() {
}
inline void spu_sync_c() {
}
inline void spu_dsync() {
}

#endif
