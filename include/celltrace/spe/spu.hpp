// The SPE's side of the runtime: the operations that a kernel may use on its SPU.
//
// A kernel is `template <class Spu> void kernel(Spu& spu, ea_t argument)`. It is compiled once per backend;
// `Spu` is the backend's type. It derives from `SpuBase<Spu>` below, which expresses every operation by the
// Cell's channels and MFC commands. A backend provides, besides the constructor that its machine calls:
//
// clang-format off
//   static constexpr bool direct_memory      an ea can be dereferenced: reads need no DMA (see cache.hpp, stream.hpp)
//   using simd                               the SIMD facade (simd.hpp)
//   uint32_t id() const, count() const       this SPE and the number of SPEs of the machine; ids are 0 .. count()-1
//   SpeAddresses addresses(spe) const        where another SPE's local store and registers are mapped
//   template <Channel c> uint32_t read_channel()         stalls while the channel's count is 0, if it may stall
//   template <Channel c> void write_channel(uint32_t)    stalls in the same way
//   template <Channel c> uint32_t channel_count()        never stalls
//   template <MfcOpcode op> void mfc_command(void* ls, ea_t ea, uint32_t size, uint32_t tag)
//   template <MfcOpcode op> void mfc_list_command(void* ls, ea_t ea, const ListElement* list, uint32_t bytes, uint32_t tag)
//   template <uint32_t code> void stop()     stop-and-signal
//   [[noreturn]] void halt(HaltCode)         stops this SPE with an error that Machine::wait() reports
//   ArenaState& arena()                      the part of local store that is free for the kernel
//
// A backend that measures or checks also hides the members of SpuBase that do nothing: compute(), note(), record(), at(), halt_at().
// clang-format on
//
// Threads: a Spu belongs to the thread that runs its kernel; no other thread may call its operations.
// Other SPEs access its mapped registers and local store by DMA, the PPE by Machine.
//
// Errors: an operation that breaks a rule of the architecture (size, alignment, tag, local-store address,
// unmapped register) ends the kernel on `cell_emu` with an error that names the rule, the SPE and the
// addresses. `native` does not check operations; on `spu` the hardware decides.
//
// Local store: every `ls` pointer below points into local store, that is into memory that allocate()
// returned. Kernel variables on the stack are not DMA targets.
#pragma once

#include "celltrace/spe/call_site.hpp"
#include "celltrace/spe/code_module.hpp"
#include "celltrace/spe/types.hpp"

#include <new>
#include <type_traits>

namespace celltrace {

/// The state of a bump allocator of local store: [begin, end) is its memory, `next` the first free byte.
struct ArenaState {
  uint8_t* begin;
  uint8_t* end;
  uint8_t* next;
};

/// Scalar work of a stretch of a kernel, in instructions; for SpuBase::compute().
struct ScalarWork {
  uint32_t fixed = 0;    ///< integer and logical operations, compares, selects
  uint32_t floating = 0; ///< single precision operations
  uint32_t memory = 0;   ///< loads and stores of local store
  uint32_t shuffle =
      0; ///< shuffles and rotations; one comes with every scalar load or store outside of the preferred slot
  uint32_t branches = 0;      ///< branches of all kinds
  uint32_t shift = 0;         ///< word shifts and rotations
  uint32_t waits = 0;         ///< cycles that these instructions wait for each other's results
  uint32_t misses = 0;        ///< cycles lost to branches without a hint
  const char* name = nullptr; ///< name of the constant, for recorders that count the work; null: not counted
};

template <class Derived> class SpuBase {
public:
  // --- code ---

  /// Makes a code module resident. Call it before functions of the module are called; it stays until another
  /// module of its region is entered. Does nothing on backends whose code is not in local store.
  void enter_module(const CodeModule&) {}
  /// Checks, on cell_emu, that a module is resident. Functions of the module call this.
  void run_in_module(const CodeModule&) {}

  // --- local store ---

  /// Returns `count` value-initialised objects in local store, aligned to `alignment` (a power of two, at
  /// least 16). Halts the SPE with local_store_exhausted if they do not fit, with bad_argument for another
  /// alignment. Memory is freed by mark() and release() only.
  template <class T>
  T* allocate(uint32_t count = 1, uint32_t alignment = kLineBytes, CallSite site = CallSite::here()) {
    if (alignment < 16 || (alignment & (alignment - 1)) != 0) self().halt_at(HaltCode::bad_argument, site);
    ArenaState& arena = self().arena();
    const uintptr_t mask = static_cast<uintptr_t>(alignment) - 1;
    uint8_t* start = arena.next + ((~reinterpret_cast<uintptr_t>(arena.next) + 1) & mask);
    const uint32_t available = start < arena.end ? static_cast<uint32_t>(arena.end - start) : 0;
    if (count > available / sizeof(T)) self().halt_at(HaltCode::local_store_exhausted, site);
    arena.next = start + count * sizeof(T);
    T* objects = reinterpret_cast<T*>(start);
    if constexpr (std::is_trivially_default_constructible_v<T>) {
      __builtin_memset(start, 0, count * sizeof(T)); // a loop over bytes would take longer than many frames
    } else {
      for (uint32_t i = 0; i < count; ++i)
        new (static_cast<void*>(objects + i)) T();
    }
    return objects;
  }
  /// Returns the arena's first free byte, for release(), which frees everything that was allocated after
  /// mark().
  uint8_t* mark() { return self().arena().next; }
  void release(uint8_t* marked) { self().arena().next = marked; }
  /// Returns the number of free bytes.
  uint32_t available() { return static_cast<uint32_t>(self().arena().end - self().arena().next); }

  // --- DMA ---
  // `size` is 1, 2, 4, 8 or a multiple of 16 up to 16 KB; ls and ea agree in their low four bits and are
  // naturally aligned (16 bytes from size 16 on). `tag` is 0..31 (31 is the runtime's own, see kRuntimeTag).
  // A call stalls while the queue of 16 is full; the data may move at any time until a wait has observed
  // the tag's completion. Suffix f (fence): the command starts after all earlier commands of the tag. Suffix
  // b (barrier): later commands of the tag also wait for it.

  void get(void* ls, ea_t ea, uint32_t size, uint32_t tag, CallSite site = CallSite::here()) {
    command<MfcOpcode::get>(ls, ea, size, tag, site);
  }
  void getf(void* ls, ea_t ea, uint32_t size, uint32_t tag, CallSite site = CallSite::here()) {
    command<MfcOpcode::getf>(ls, ea, size, tag, site);
  }
  void getb(void* ls, ea_t ea, uint32_t size, uint32_t tag, CallSite site = CallSite::here()) {
    command<MfcOpcode::getb>(ls, ea, size, tag, site);
  }
  void put(const void* ls, ea_t ea, uint32_t size, uint32_t tag, CallSite site = CallSite::here()) {
    command<MfcOpcode::put>(ls, ea, size, tag, site);
  }
  void putf(const void* ls, ea_t ea, uint32_t size, uint32_t tag, CallSite site = CallSite::here()) {
    command<MfcOpcode::putf>(ls, ea, size, tag, site);
  }
  void putb(const void* ls, ea_t ea, uint32_t size, uint32_t tag, CallSite site = CallSite::here()) {
    command<MfcOpcode::putb>(ls, ea, size, tag, site);
  }

  // Lists: `list` points to `elements` (at most 2048) ListElements in local store, 8-byte aligned; `ls` is
  // the place of the data, where each element starts at the next 16-byte boundary; `ea` supplies the high
  // half of all effective addresses. The list itself must stay unchanged until the tag is complete.

  void getl(void* ls, ea_t ea, const ListElement* list, uint32_t elements, uint32_t tag,
            CallSite site = CallSite::here()) {
    list_command<MfcOpcode::getl>(ls, ea, list, elements, tag, site);
  }
  void getlf(void* ls, ea_t ea, const ListElement* list, uint32_t elements, uint32_t tag,
             CallSite site = CallSite::here()) {
    list_command<MfcOpcode::getlf>(ls, ea, list, elements, tag, site);
  }
  void getlb(void* ls, ea_t ea, const ListElement* list, uint32_t elements, uint32_t tag,
             CallSite site = CallSite::here()) {
    list_command<MfcOpcode::getlb>(ls, ea, list, elements, tag, site);
  }
  void putl(const void* ls, ea_t ea, const ListElement* list, uint32_t elements, uint32_t tag,
            CallSite site = CallSite::here()) {
    list_command<MfcOpcode::putl>(ls, ea, list, elements, tag, site);
  }
  void putlf(const void* ls, ea_t ea, const ListElement* list, uint32_t elements, uint32_t tag,
             CallSite site = CallSite::here()) {
    list_command<MfcOpcode::putlf>(ls, ea, list, elements, tag, site);
  }
  void putlb(const void* ls, ea_t ea, const ListElement* list, uint32_t elements, uint32_t tag,
             CallSite site = CallSite::here()) {
    list_command<MfcOpcode::putlb>(ls, ea, list, elements, tag, site);
  }

  /// Orders all earlier commands of the queue before all later commands, whatever their tags.
  void mfc_barrier(uint32_t tag, CallSite site = CallSite::here()) {
    command<MfcOpcode::barrier>(nullptr, 0, 0, tag, site);
  }

  // Lock-line commands: one 128-byte line, both addresses 128-byte aligned; not tagged, except putqlluc.

  /// Reads the line and reserves it. Returns the atomic status.
  uint32_t getllar(void* ls, ea_t ea, CallSite site = CallSite::here()) {
    return atomic_command<MfcOpcode::getllar>(ls, ea, site);
  }
  /// Writes the line if the reservation still holds; returns whether it did.
  bool putllc(const void* ls, ea_t ea, CallSite site = CallSite::here()) {
    return (atomic_command<MfcOpcode::putllc>(ls, ea, site) & atomic_status::putllc_failed) == 0;
  }
  /// Writes the line unconditionally.
  uint32_t putlluc(const void* ls, ea_t ea, CallSite site = CallSite::here()) {
    return atomic_command<MfcOpcode::putlluc>(ls, ea, site);
  }
  /// As putlluc(), queued under a tag.
  void putqlluc(const void* ls, ea_t ea, uint32_t tag, CallSite site = CallSite::here()) {
    command<MfcOpcode::putqlluc>(ls, ea, kLineBytes, tag, site);
  }

  // --- tag groups ---

  /// Stalls until all commands of all tag groups in `mask` are complete; returns the completed groups & mask.
  uint32_t wait_all(uint32_t mask, CallSite site = CallSite::here()) {
    return tag_status(mask, TagUpdate::all, site);
  }
  /// Stalls until one tag group in `mask` is complete (for ever if mask is 0); returns the completed groups &
  /// mask.
  uint32_t wait_any(uint32_t mask, CallSite site = CallSite::here()) {
    return tag_status(mask, TagUpdate::any, site);
  }
  /// Returns the completed tag groups & mask, without stalling.
  uint32_t completed(uint32_t mask, CallSite site = CallSite::here()) {
    return tag_status(mask, TagUpdate::immediate, site);
  }

  /// Returns the tag groups whose lists stopped at a notify element; stalls until a list has stopped.
  uint32_t read_list_stall_status(CallSite site = CallSite::here()) {
    return read<Channel::rd_list_stall_stat>(site);
  }
  /// Resumes the stopped lists of one tag.
  void acknowledge_list_stall(uint32_t tag, CallSite site = CallSite::here()) {
    write<Channel::wr_list_stall_ack>(tag, site);
  }

  // --- mailboxes ---

  /// Returns the oldest word of the 4-entry inbound mailbox; stalls while it is empty.
  uint32_t read_in_mailbox(CallSite site = CallSite::here()) { return read<Channel::rd_in_mbox>(site); }
  uint32_t in_mailbox_count(CallSite site = CallSite::here()) { return count_of<Channel::rd_in_mbox>(site); }
  /// Writes a word to the PPE; stalls while the previous word is unread.
  void write_out_mailbox(uint32_t value, CallSite site = CallSite::here()) {
    write<Channel::wr_out_mbox>(value, site);
  }
  /// Returns the free entries of the outbound mailbox: 1 or 0.
  uint32_t out_mailbox_count(CallSite site = CallSite::here()) {
    return count_of<Channel::wr_out_mbox>(site);
  }
  /// As write_out_mailbox(), and interrupts the PPE.
  void write_out_interrupt_mailbox(uint32_t value, CallSite site = CallSite::here()) {
    write<Channel::wr_out_intr_mbox>(value, site);
  }
  uint32_t out_interrupt_mailbox_count(CallSite site = CallSite::here()) {
    return count_of<Channel::wr_out_intr_mbox>(site);
  }

  // --- signal notification ---

  /// Read and clear a signal register; stall while nothing was signalled.
  uint32_t read_signal_1(CallSite site = CallSite::here()) { return read<Channel::rd_sig_notify_1>(site); }
  uint32_t read_signal_2(CallSite site = CallSite::here()) { return read<Channel::rd_sig_notify_2>(site); }
  uint32_t signal_1_count(CallSite site = CallSite::here()) {
    return count_of<Channel::rd_sig_notify_1>(site);
  }
  uint32_t signal_2_count(CallSite site = CallSite::here()) {
    return count_of<Channel::rd_sig_notify_2>(site);
  }

  // --- to other SPEs ---

  /// Raises a signal of SPE `spe`. Returns when the word has been delivered.
  void send_signal(uint32_t spe, Signal which, uint32_t value, CallSite site = CallSite::here()) {
    const SpeAddresses to = self().addresses(spe);
    uint32_t* word = outgoing_word(value);
    command<MfcOpcode::sndsig>(word, which == Signal::one ? to.signal_1 : to.signal_2, 4, kRuntimeTag, site);
    wait_all(1u << kRuntimeTag, site);
  }
  /// Writes a word to the inbound mailbox of SPE `spe`. The word replaces the newest word of a full mailbox,
  /// so the protocol between the SPEs has to bound the number of words under way. Returns when the word has
  /// been delivered.
  void send_mailbox(uint32_t spe, uint32_t value, CallSite site = CallSite::here()) {
    uint32_t* word = outgoing_word(value);
    command<MfcOpcode::put>(word, self().addresses(spe).in_mailbox, 4, kRuntimeTag, site);
    wait_all(1u << kRuntimeTag, site);
  }

  // --- events ---
  // Events become pending even if the mask disables them. The count of the event status becomes 1 when an
  // enabled event occurs, or when an enabled event is still pending after a write of the mask or an
  // acknowledge; only a read of the status makes the count 0. The status can be 0 (phantom event), if an
  // event was masked or acknowledged after the count rose; programs must tolerate this.

  void write_event_mask(uint32_t mask, CallSite site = CallSite::here()) {
    write<Channel::wr_event_mask>(mask, site);
  }
  uint32_t read_event_mask(CallSite site = CallSite::here()) { return read<Channel::rd_event_mask>(site); }
  /// Returns the pending events that the mask enables; stalls until the count is 1. The events stay pending.
  uint32_t read_event_status(CallSite site = CallSite::here()) { return read<Channel::rd_event_stat>(site); }
  uint32_t event_count(CallSite site = CallSite::here()) { return count_of<Channel::rd_event_stat>(site); }
  void acknowledge_events(uint32_t mask, CallSite site = CallSite::here()) {
    write<Channel::wr_event_ack>(mask, site);
  }

  // --- decrementer ---

  void write_decrementer(uint32_t value, CallSite site = CallSite::here()) {
    write<Channel::wr_dec>(value, site);
  }
  /// Returns the decrementer, which counts down at the timebase (79.8 MHz on a PlayStation 3).
  uint32_t read_decrementer(CallSite site = CallSite::here()) { return read<Channel::rd_dec>(site); }

  // --- run control ---

  /// Stops with a 14-bit code. Codes 0x2000..0x20FF end the program as if it returned; after any other code
  /// the SPE waits for Machine::resume(). The code is a template argument because it is part of the real
  /// SPU's instruction.
  template <uint32_t code> void stop_and_signal(CallSite site = CallSite::here()) {
    static_assert(code < 0x4000, "a stop code has 14 bits");
    self().at(site);
    self().template stop<code>();
  }

  // --- for emulated machines, which measure and check; elsewhere these members do nothing ---

  /// Declares scalar work that the SIMD facade does not see.
  void compute(const ScalarWork&) {}
  /// Writes a named value into the trace. The name must be a string literal.
  void note(const char*, uint32_t) {}
  /// Records a word for a recording object of the kernel (recorder.hpp).
  void record(const void*, uint32_t) {}
  /// Tells the machine the place of the next operation in the kernel's source.
  void at(CallSite) {}
  /// Halts as halt() does, and reports the place of the call that failed.
  [[noreturn]] void halt_at(HaltCode code, CallSite) { self().halt(code); }

  /// The DMA tag that send_signal() and send_mailbox() use.
  static constexpr uint32_t kRuntimeTag = 31;

protected:
  /// Reserves the quadword that outgoing words are sent from. Call it once the arena exists, before the
  /// kernel runs.
  void initialise_base() { outgoing_ = self().template allocate<uint32_t>(4, 16); }

private:
  Derived& self() { return static_cast<Derived&>(*this); }

  template <Channel c> uint32_t read(CallSite site) {
    self().at(site);
    return self().template read_channel<c>();
  }
  template <Channel c> void write(uint32_t value, CallSite site) {
    self().at(site);
    self().template write_channel<c>(value);
  }
  template <Channel c> uint32_t count_of(CallSite site) {
    self().at(site);
    return self().template channel_count<c>();
  }
  template <MfcOpcode op> void command(const void* ls, ea_t ea, uint32_t size, uint32_t tag, CallSite site) {
    self().at(site);
    self().template mfc_command<op>(const_cast<void*>(ls), ea, size, tag);
  }
  /// Issues a list command; the backend puts the list's local-store address into the low half of the
  /// effective address.
  template <MfcOpcode op>
  void list_command(const void* ls, ea_t ea, const ListElement* list, uint32_t elements, uint32_t tag,
                    CallSite site) {
    self().at(site);
    self().template mfc_list_command<op>(const_cast<void*>(ls), ea, list, ListElement::list_bytes(elements),
                                         tag);
  }
  template <MfcOpcode op> uint32_t atomic_command(const void* ls, ea_t ea, CallSite site) {
    command<op>(ls, ea, kLineBytes, 0, site);
    return read<Channel::rd_atomic_stat>(site);
  }
  uint32_t tag_status(uint32_t mask, TagUpdate request, CallSite site) {
    write<Channel::wr_tag_mask>(mask, site);
    write<Channel::wr_tag_update>(static_cast<uint32_t>(request), site);
    return read<Channel::rd_tag_stat>(site);
  }
  /// Stores the word to send and returns its address. It is word 3 of a quadword, as registers of other SPEs
  /// are at 0xC of a quadword.
  uint32_t* outgoing_word(uint32_t value) {
    outgoing_[3] = value;
    return outgoing_ + 3;
  }

  uint32_t* outgoing_ = nullptr;
};

} // namespace celltrace
