// The SPU that a kernel compiled for the host sees on the emulated Cell: spells SpuBase's operations in
// channels and MFC commands, and charges the SPE's virtual clock for the operations it counts.
#pragma once

#include "backends/cell_emu/counting_simd.hpp"
#include "backends/cell_emu/spu_core.hpp"
#include "celltrace/spe/quadword.hpp"
#include "celltrace/spe/simd_host.hpp"
#include "celltrace/spe/spu.hpp"

#include <functional>
#include <map>

namespace celltrace::cell_emu {

/// One run of a kernel on one SPE. Thread safety: belongs to the thread that runs the SPE.
///
/// A stall, or a poll that finds a count of 0, throws SpeError when the SPE has been interrupted; a broken
/// rule whose action is to stop throws RuleViolation.
class Spu : public SpuCore, public SpuBase<Spu> {
public:
  static constexpr const char* kKey = "cell_emu";
  static constexpr bool direct_memory = false;
  using simd = CountingSimd<HostSimd<xsimd::sse2>>;
  using rare_simd = simd;

  /// `arena` is the part of the SPE's local store that is the kernel's.
  Spu(Spe& spe, const SpuContext& context, const ArenaState& arena);
  ~Spu();

  /// That of the program which runs here: for code that has no Spu at hand. Throws SpeError if none does.
  static Spu& running();

  // Its allocations are known, so that commands and stores that leave them are found.

  template <class T>
  T* allocate(std::uint32_t count = 1, std::uint32_t alignment = kLineBytes,
              CallSite site = CallSite::here()) {
    T* const objects = SpuBase::allocate<T>(count, alignment, site);
    allocated(objects, static_cast<std::uint32_t>(count * sizeof(T)), alignment, site);
    return objects;
  }
  void release(std::uint8_t* marked, CallSite site = CallSite::here());

  using SpuCore::id;
  std::uint32_t count() const { return context_.mfc.bus.map().spes(); }
  /// Throws SpeError if there is no such SPE.
  SpeAddresses addresses(std::uint32_t spe) const;
  ArenaState& arena();
  [[noreturn]] void halt(HaltCode code, CallSite site = CallSite::here());
  [[noreturn]] void halt_at(HaltCode code, CallSite site) { halt(code, site); }
  /// The condition of heq and its like held.
  [[noreturn]] void halt_by_instruction() { fail(Rule::halted, std::string(text_of(Rule::halted))); }
  template <std::uint32_t code> void stop() { stop(code); }

  template <Channel c> std::uint32_t read_channel() {
    charge(1, 0);
    return channel_read<c>();
  }
  template <Channel c> void write_channel(std::uint32_t value) {
    charge(0, 1);
    channel_write<c>(value);
  }
  /// A channel that does not exist has the count 0.
  template <Channel c> std::uint32_t channel_count() {
    charge(1, 0);
    return channel_count_of<c>();
  }

  template <MfcOpcode op> void mfc_command(void* ls, ea_t ea, std::uint32_t size, std::uint32_t tag) {
    issue({op, tag, local_address(ls), size, ea});
  }
  template <MfcOpcode op>
  void mfc_list_command(void* ls, ea_t ea, const ListElement* list, std::uint32_t bytes, std::uint32_t tag) {
    issue({op, tag, local_address(ls), bytes, (ea & ~ea_t{0xFFFFFFFF}) | local_address(list)});
  }

  // --- what only the emulator has ---

  /// The running program's; null where none runs.
  static Spu* running_or_null();
  /// The floating-point status that the SDK's intrinsics keep.
  isa::Quadword& floating_status() { return floating_status_; }

  [[gnu::always_inline]] void compute(const ScalarWork& work) {
    cell_emu::count(work);
    if (SpeRecorder* recorder = context_.mfc.config.recorder) [[unlikely]]
      recorder->computed(spe_.id, work);
  }
  /// Takes the time of the DMA command that fetches the module, if it is not there.
  void enter_module(const CodeModule& module) {
    if (resident_modules_[module.region] != module.number) fetch_module(module);
  }
  void run_in_module(const CodeModule& module, CallSite site = CallSite::here()) {
    if (resident_modules_[module.region] != module.number) [[unlikely]]
      report_absent_module(module, site);
  }
  void note(const char* what, std::uint32_t value);
  void record(const void* source, std::uint32_t word) {
    if (SpeRecorder* recorder = context_.mfc.config.recorder) recorder->record(spe_.id, source, word);
  }
  void at(CallSite site) { site_ = site; }

  /// Offset in this SPE's local store; kOutsideLocalStore for a pointer to elsewhere.
  std::uint32_t local_address(const void* pointer) const;
  /// Zeroed local store that belongs to `key` until the program ends: what a static object is on a real SPE.
  void* local_static(const void* key, std::uint32_t bytes, std::uint32_t alignment);

  /// Channels by number, for programs that compute it; one that does not exist in this direction ends the
  /// program as an invalid channel does.
  std::uint32_t read_channel(unsigned channel);
  void write_channel(unsigned channel, std::uint32_t value);
  std::uint32_t channel_count(unsigned channel);

  /// SPU interrupts: while they are enabled and the event status has a count, `handler` runs before the next
  /// channel access, with interrupts disabled; it is called again until it has read the event status.
  void enable_interrupts(std::function<void(Spu&)> handler);
  /// Again, with the handler that was given last; SpeError if none was.
  void enable_interrupts();
  void disable_interrupts() { interrupts_enabled_ = false; }
  /// bisled: calls `handler` if the event status has a count.
  template <class Handler> void branch_if_event(Handler handler) {
    if (event_count() != 0) handler(*this);
  }

  /// The virtual time, in cycles since the machine was made.
  Cycle cycles() {
    settle();
    return now();
  }

  /// The kernel has returned, or stopped with an exit code: completes what is queued and looks for what it
  /// left undone.
  void finish();
  /// The kernel was broken off.
  void abandon();

private:
  void allocated(void* begin, std::uint32_t bytes, std::uint32_t alignment, CallSite site);
  void issue(const MfcCommand& command);
  void fetch_module(const CodeModule& module);
  void report_absent_module(const CodeModule& module, CallSite site);
  void stop(std::uint32_t code);

  /// Charges what has been computed since the last access to a channel.
  void settle();
  void charge(std::uint32_t channel_reads, std::uint32_t channel_writes);
  void run_interrupts();

  ArenaState arena_;
  std::uint32_t resident_modules_[kMaxModuleRegions] = {}; ///< by region, 0: none
  std::map<const void*, void*> statics_;
  bool in_handler_ = false;
  isa::Quadword floating_status_{};
  std::function<void(Spu&)> interrupt_handler_;
};

} // namespace celltrace::cell_emu
