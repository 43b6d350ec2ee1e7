// The SPU of the emulated Cell, for kernels compiled for the host: the interface of
// celltrace/spe/spu.hpp with strict checks and virtual time.
#pragma once

#include "celltrace/export.hpp"
#include "celltrace/spe/channels.hpp"
#include "celltrace/spe/counting_simd.hpp"
#include "celltrace/spe/quadword.hpp"
#include "celltrace/spe/recorder.hpp"
#include "celltrace/spe/simd_host.hpp"
#include "celltrace/spe/spu.hpp"

#include <cstdint>
#include <functional>

namespace celltrace::cell_emu {

/// The SPU during one run of a kernel on one SPE; a machine makes the object. Thread safety: belongs to the
/// thread that runs the SPE.
///
/// A stall, or a poll of a channel whose count is 0, throws SpeError if the SPE has been interrupted. A
/// broken rule with Action::stop also ends the program with an exception.
class CELLTRACE_EXPORT Spu : public SpuBase<Spu> {
public:
  static constexpr const char* kKey = "cell_emu";
  static constexpr bool direct_memory = false;
  using simd = CountingSimd<HostSimd<BaselineArch>>;
  using rare_simd = simd;

  Spu(const Spu&) = delete;
  Spu& operator=(const Spu&) = delete;

  /// Returns the Spu of the program that runs on this thread, for code that has no Spu at hand. Throws
  /// SpeError if no program runs.
  static Spu& running();

  /// As running(), but returns null if no program runs on this thread.
  static Spu* running_or_null();

  // Allocations are tracked, so that commands and stores beyond an allocation are detected.

  template <class T>
  T* allocate(std::uint32_t count = 1, std::uint32_t alignment = kLineBytes,
              CallSite site = CallSite::here()) {
    T* const objects = SpuBase::allocate<T>(count, alignment, site);
    allocated(objects, static_cast<std::uint32_t>(count * sizeof(T)), alignment, site);
    return objects;
  }
  virtual void release(std::uint8_t* marked, CallSite site = CallSite::here()) = 0;

  std::uint32_t id() const { return id_; }
  std::uint32_t count() const { return count_; }
  /// Returns the addresses of an SPE. Throws SpeError if the SPE does not exist.
  virtual SpeAddresses addresses(std::uint32_t spe) const = 0;
  virtual ArenaState& arena() = 0;
  [[noreturn]] void halt(HaltCode code, CallSite site = CallSite::here()) {
    throw_halted(code, site);
    __builtin_unreachable();
  }
  [[noreturn]] void halt_at(HaltCode code, CallSite site) { halt(code, site); }
  /// Ends the program because the condition of heq or another halt instruction held.
  [[noreturn]] void halt_by_instruction() {
    throw_halted_by_instruction();
    __builtin_unreachable();
  }
  template <std::uint32_t code> void stop() { stop(code); }

  template <Channel c> std::uint32_t read_channel() {
    static_assert(is_readable(c), "no such channel, or it cannot be read");
    return read_channel(static_cast<unsigned>(c));
  }
  template <Channel c> void write_channel(std::uint32_t value) {
    static_assert(exists(c) && !is_readable(c), "no such channel, or it cannot be written");
    write_channel(static_cast<unsigned>(c), value);
  }
  template <Channel c> std::uint32_t channel_count() { return channel_count(static_cast<unsigned>(c)); }

  template <MfcOpcode op> void mfc_command(void* ls, ea_t ea, std::uint32_t size, std::uint32_t tag) {
    issue(op, local_address(ls), ea, size, tag);
  }
  template <MfcOpcode op>
  void mfc_list_command(void* ls, ea_t ea, const ListElement* list, std::uint32_t bytes, std::uint32_t tag) {
    issue(op, local_address(ls), (ea & ~ea_t{0xFFFFFFFF}) | local_address(list), bytes, tag);
  }

  // --- members that only the emulator has ---

  /// Returns the floating-point status register of the SDK's intrinsics.
  isa::Quadword& floating_status() { return floating_status_; }

  [[gnu::always_inline]] void compute(const ScalarWork& work) {
    cell_emu::count(work);
    if (recorder_ != nullptr) [[unlikely]]
      recorder_->computed(id_, work);
  }
  /// Fetches the module if it is not in local store: spends the time of the DMA command.
  void enter_module(const CodeModule& module) {
    if (resident_modules_[module.region] != module.number) fetch_module(module);
  }
  void run_in_module(const CodeModule& module, CallSite site = CallSite::here()) {
    if (resident_modules_[module.region] != module.number) [[unlikely]]
      report_absent_module(module, site);
  }
  /// Writes a named value into the trace.
  virtual void note(const char* what, std::uint32_t value) = 0;
  void record(const void* source, std::uint32_t word) {
    if (recorder_ != nullptr) recorder_->record(id_, source, word);
  }
  void at(CallSite site) { call_site_ = site; }

  /// Returns the offset of `pointer` in this SPE's local store; kOutsideLocalStore if it points elsewhere.
  std::uint32_t local_address(const void* pointer) const {
    const std::uintptr_t offset = reinterpret_cast<std::uintptr_t>(pointer) - local_store_;
    return offset < kLocalStoreBytes ? static_cast<std::uint32_t>(offset) : kOutsideLocalStore;
  }
  /// Returns zeroed local store that belongs to `key` until the program ends: the counterpart of a static
  /// object on a real SPE.
  virtual void* local_static(const void* key, std::uint32_t bytes, std::uint32_t alignment) = 0;

  // Channels by number, for programs that compute the number. Access to a channel that does not exist, or not
  // in this direction, ends the program; the count of such a channel is 0.

  virtual std::uint32_t read_channel(unsigned channel) = 0;
  virtual void write_channel(unsigned channel, std::uint32_t value) = 0;
  virtual std::uint32_t channel_count(unsigned channel) = 0;

  /// Enables SPU interrupts: while they are enabled and the event status has a count, `handler` runs before
  /// the next channel access, with interrupts disabled. `handler` is called again until it has read the event
  /// status.
  virtual void enable_interrupts(std::function<void(Spu&)> handler) = 0;
  /// Enables interrupts again, with the last handler. Throws SpeError if there was no handler.
  virtual void enable_interrupts() = 0;
  virtual void disable_interrupts() = 0;
  /// Calls `handler` if the event status has a count (bisled).
  template <class Handler> void branch_if_event(Handler handler) {
    if (event_count() != 0) handler(*this);
  }

  /// Returns the virtual time, in cycles since the machine was made.
  virtual std::uint64_t cycles() = 0;

protected:
  /// Makes the SPU. `site` is set to the place of every operation before the operation.
  Spu(std::uint32_t id, std::uint32_t count, const void* local_store, SpeRecorder* recorder, CallSite& site)
      : id_(id), count_(count), local_store_(reinterpret_cast<std::uintptr_t>(local_store)),
        recorder_(recorder), call_site_(site) {}
  ~Spu();

  std::uint32_t resident_modules_[kMaxModuleRegions] = {}; ///< number of the module in each region, 0: none

private:
  virtual void throw_halted(HaltCode code, CallSite site) = 0;
  virtual void throw_halted_by_instruction() = 0;
  virtual void allocated(void* begin, std::uint32_t bytes, std::uint32_t alignment, CallSite site) = 0;
  virtual void issue(MfcOpcode op, std::uint32_t lsa, ea_t ea, std::uint32_t size, std::uint32_t tag) = 0;
  virtual void fetch_module(const CodeModule& module) = 0;
  virtual void report_absent_module(const CodeModule& module, CallSite site) = 0;
  virtual void stop(std::uint32_t code) = 0;

  const std::uint32_t id_;
  const std::uint32_t count_;
  const std::uintptr_t local_store_;
  SpeRecorder* const recorder_;
  CallSite& call_site_;
  isa::Quadword floating_status_{};
};

} // namespace celltrace::cell_emu
