// The channel intrinsics of the SDK's <spu_intrinsics.h>, for existing SPE sources on the emulated Cell. They
// act on the SPE whose program runs on the present thread, and throw SpeError where none does. The vector
// intrinsics are not here. On a real SPU this header is the compiler's own.
#pragma once

#ifdef __SPU__
#include <spu_intrinsics.h>
#else

#include "celltrace/spe/emulated_spu.hpp"

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
constexpr unsigned int MFC_LSA = 16; ///< takes the offset in local store, see spu_ls_address()
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

namespace celltrace::sdk {

/// The running SPE, about to do what stands at `site`.
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

// --- MFC commands by their word ---

/// What a cast of a local-store pointer to unsigned int gives on a real SPU. Not of the SDK.
inline unsigned int spu_ls_address(const volatile void* pointer) {
  return celltrace::cell_emu::Spu::running().local_address(celltrace::sdk::local_pointer(pointer));
}

/// With the EAH that was written last. For a list command, `eal` is the list's spu_ls_address().
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

// --- run control ---

/// The code is part of the instruction, so it is a constant.
#define spu_stop(code) (celltrace::cell_emu::Spu::running().stop_and_signal<(code)>())

// Loads and stores are in order on the emulated Cell.
inline void spu_sync() {
}
inline void spu_sync_c() {
}
inline void spu_dsync() {
}

#endif
