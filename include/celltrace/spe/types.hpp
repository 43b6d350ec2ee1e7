// The vocabulary of the Cell Broadband Engine that the host and the kernels share: effective addresses, MFC
// commands, channels, event bits. Freestanding C++17; compiles with spu-elf-g++ 9.3, g++ 12 and clang 14.
#pragma once

#include <stdint.h>

namespace celltrace {

/// An effective address: a place in the main storage domain (main memory, or the mapped local store or
/// problem state of an SPE). A kernel may dereference it only if `Spu::direct_memory`.
using ea_t = uint64_t;

constexpr uint32_t kLocalStoreBytes = 256 * 1024;
/// Local-store address, on the emulated Cell, of a pointer that does not point into the SPE's local store.
constexpr uint32_t kOutsideLocalStore = 0xFFFFFFFFu;
/// Bytes of a cache line, and of a line of the bus (EIB), at which a DMA transfer is most efficient.
constexpr uint32_t kLineBytes = 128;
constexpr uint32_t kMaxDmaBytes = 16 * 1024;
constexpr uint32_t kMfcTags = 32;
constexpr uint32_t kMfcQueueEntries = 16;
constexpr uint32_t kMaxListElements = 2048;
constexpr uint32_t kInboundMailboxEntries = 4;

/// MFC command opcodes. Suffix b: with barrier; f: with fence; l: the command processes a list in local
/// store.
enum class MfcOpcode : uint32_t {
  put = 0x20,
  putb = 0x21,
  putf = 0x22,
  putl = 0x24,
  putlb = 0x25,
  putlf = 0x26,
  /// put with the "result" bit: a hint that the PPE will soon read the data.
  putr = 0x30,
  putrb = 0x31,
  putrf = 0x32,
  putrl = 0x34,
  putrlb = 0x35,
  putrlf = 0x36,
  get = 0x40,
  getb = 0x41,
  getf = 0x42,
  getl = 0x44,
  getlb = 0x45,
  getlf = 0x46,
  // Hints for the data cache of the PPE, and sdcrz, which zeroes lines of main storage.
  sdcrt = 0x80,
  sdcrtst = 0x81,
  sdcrz = 0x89,
  sdcrst = 0x8D,
  sdcrf = 0x8F,
  sndsig = 0xA0,
  sndsigb = 0xA1,
  sndsigf = 0xA2,
  putlluc = 0xB0,
  putllc = 0xB4,
  putqlluc = 0xB8,
  barrier = 0xC0,
  mfceieio = 0xC8,
  mfcsync = 0xCC,
  getllar = 0xD0,
};

/// SPU channels by their architected numbers.
enum class Channel : uint32_t {
  rd_event_stat = 0,
  wr_event_mask = 1,
  wr_event_ack = 2,
  rd_sig_notify_1 = 3,
  rd_sig_notify_2 = 4,
  wr_dec = 7,
  rd_dec = 8,
  wr_ms_sync_req = 9,
  rd_event_mask = 11,
  rd_tag_mask = 12,
  rd_mach_stat = 13,
  wr_srr0 = 14,
  rd_srr0 = 15,
  mfc_lsa = 16,
  mfc_eah = 17,
  mfc_eal = 18,
  mfc_size = 19,
  mfc_tag_id = 20,
  mfc_cmd = 21,
  wr_tag_mask = 22,
  wr_tag_update = 23,
  rd_tag_stat = 24,
  rd_list_stall_stat = 25,
  wr_list_stall_ack = 26,
  rd_atomic_stat = 27,
  wr_out_mbox = 28,
  rd_in_mbox = 29,
  wr_out_intr_mbox = 30,
  // Channels for measuring tools: a mark in a trace, and the start and end of counting.
  set_bookmark_tag = 69,
  pm_start_event = 70,
  pm_stop_event = 71,
};

/// The request that a write to channel 23 (tag status update) makes.
enum class TagUpdate : uint32_t { immediate = 0, any = 1, all = 2 };

/// Bits of the SPU event facility (channels 0, 1, 2 and 11).
namespace event {
constexpr uint32_t tag_status = 0x1;
constexpr uint32_t list_stall = 0x2;
constexpr uint32_t command_queue = 0x8;
constexpr uint32_t in_mailbox = 0x10;
constexpr uint32_t decrementer = 0x20;
constexpr uint32_t out_intr_mailbox = 0x40;
constexpr uint32_t out_mailbox = 0x80;
constexpr uint32_t signal_2 = 0x100;
constexpr uint32_t signal_1 = 0x200;
constexpr uint32_t reservation_lost = 0x400;
constexpr uint32_t privileged_attention = 0x800;
constexpr uint32_t multi_source_sync = 0x1000;
} // namespace event

/// Bits of the atomic command status (channel 27).
namespace atomic_status {
constexpr uint32_t putllc_failed = 0x1;
constexpr uint32_t putlluc_done = 0x2;
constexpr uint32_t getllar_done = 0x4;
} // namespace atomic_status

/// Signal notification register of an SPE.
enum class Signal : uint32_t { one = 1, two = 2 };

/// The reaction of a signal notification register to a write while it still holds an unread value.
enum class SignalMode : uint32_t { overwrite, logical_or };

/// One element of a DMA list in local store: notify bit and size in the first word, low half of the effective
/// address in the second word; the command has the high half. The list is 8-byte aligned.
struct ListElement {
  uint32_t notify_and_size;
  uint32_t ea_low;

  static constexpr uint32_t kNotify = 0x80000000u;
  static constexpr ListElement make(uint32_t size, ea_t ea, bool notify = false) {
    return {size | (notify ? kNotify : 0u), static_cast<uint32_t>(ea)};
  }
  /// Returns the number of bytes of a list of `elements`. If it exceeds 32 bits, returns a length that no MFC
  /// accepts.
  static constexpr uint32_t list_bytes(uint64_t elements) {
    constexpr uint64_t most = 0xFFFFFFFFu / 8;
    return static_cast<uint32_t>(elements < most ? elements : most) * 8;
  }
};
static_assert(sizeof(ListElement) == 8, "a list element is 8 bytes");

/// The reason why a kernel stopped itself: the low bits of the stop-and-signal code.
enum class HaltCode : uint32_t {
  local_store_exhausted = 1,
  bad_argument = 2,
  internal_error = 3,
  stale_pointer = 4, ///< a pointer into a cache was used after its lifetime
};
constexpr HaltCode kLastHaltCode = HaltCode::stale_pointer;

/// Base of the stop-and-signal codes with which a kernel on an SPU halts; the code is kHaltStop + HaltCode.
constexpr uint32_t kHaltStop = 0x1000;

/// Returns the code's text for messages.
constexpr const char* to_text(HaltCode code) {
  switch (code) {
  case HaltCode::local_store_exhausted:
    return "local store exhausted";
  case HaltCode::bad_argument:
    return "bad argument";
  case HaltCode::internal_error:
    return "internal error";
  case HaltCode::stale_pointer:
    return "stale pointer into a cache";
  }
  return "unknown halt code";
}

/// The addresses of an SPE's problem-state registers and local store in the main storage domain. The signal
/// and mailbox addresses are those of 32-bit registers. Their low four bits are 0xC, so that a word to be
/// sent must be the last word of a quadword in local store.
struct alignas(16) SpeAddresses {
  ea_t local_store;
  ea_t signal_1;
  ea_t signal_2;
  ea_t in_mailbox;
};
static_assert(sizeof(SpeAddresses) == 32, "SpeAddresses crosses DMA");

} // namespace celltrace
