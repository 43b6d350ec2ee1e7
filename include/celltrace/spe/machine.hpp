// The PPE's side of the runtime: a machine with n SPEs that run kernels.
#pragma once

#include "celltrace/error.hpp"
#include "celltrace/export.hpp"
#include "celltrace/spe/backend.hpp"
#include "celltrace/spe/emulation.hpp"
#include "celltrace/spe/program.hpp"
#include "celltrace/spe/simulation.hpp"
#include "celltrace/spe/types.hpp"

#include <bit>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace celltrace {

/// Options of a machine. make_machine() throws InputError for values out of range.
struct MachineConfig {
  Backend backend = Backend::native;
  /// Number of SPEs, 1..256; 0: on `native` one per CPU that the calling thread may use,
  /// on `cell_emu` and `cell_sim` `emulation.timing.spes`.
  unsigned spes = 0;
  /// SIMD level, for `native` only.
  SimdLevel simd = SimdLevel::automatic;
  /// Modes of the two signal notification registers of every SPE: a second write replaces the first, or is
  /// ORed to it.
  SignalMode signal_mode[2] = {SignalMode::overwrite, SignalMode::overwrite};
  /// `cell_emu`: bytes of local store for the code and data of a program, and for its stack, unless
  /// SpeProgram::takes() set them. The rest of the 256 KB is the kernel's arena.
  unsigned code_bytes = 104 * 1024;
  unsigned stack_bytes = 24 * 1024;
  /// Options of `cell_emu` and `cell_sim`.
  EmulationConfig emulation;
  /// Options of `cell_sim`.
  SimulationConfig simulation;
};

/// The way in which an SPE's program stopped.
struct SpeStop {
  enum class Reason : unsigned char {
    exit,            ///< the kernel returned, or stopped with one of the codes 0x2000..0x20FF
    stop_and_signal, ///< the kernel waits for Machine::resume()
  };
  Reason reason = Reason::exit;
  /// For exit, the low byte of the stop code (0 if the kernel returned); for stop_and_signal, all 14 bits of
  /// the stop code.
  std::uint32_t code = 0;
};

/// Counters of one SPE since the machine was made.
struct SpeStatistics {
  std::uint64_t dma_commands = 0;
  std::uint64_t dma_list_elements = 0;
  std::uint64_t dma_bytes_read = 0;    ///< main storage -> local store
  std::uint64_t dma_bytes_written = 0; ///< local store -> main storage
  std::uint64_t signals_sent = 0;
  std::uint64_t mailbox_words_sent = 0; ///< words sent to other SPEs and to the PPE
  std::uint64_t local_store_peak = 0;   ///< greatest number of bytes of the arena in use
  std::uint64_t module_fetches = 0;     ///< fetches of code modules
  std::uint64_t module_bytes = 0;
  /// Part of `cycles` spent waiting for code modules; only cell_emu counts it.
  std::uint64_t module_cycles = 0;
  SpuCycles cycles; ///< virtual time; all 0 on `native`
};

/// A machine with n SPEs. Thread safety: one PPE thread at a time calls its members; only interrupt() may be
/// called from any thread, also by a thread that handles signals. Errors: std::out_of_range for an SPE that
/// does not exist.
class CELLTRACE_EXPORT Machine {
public:
  Machine() = default;
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;
  /// Interrupts kernels that still run and joins them.
  virtual ~Machine() = default;

  virtual Backend backend() const noexcept = 0;
  virtual unsigned spe_count() const noexcept = 0;
  /// Returns true if the SPEs can dereference effective addresses (Spu::direct_memory).
  virtual bool direct_memory() const noexcept = 0;
  /// Returns the SPU type in use, for reports: "native.avx512", "cell_emu", "cell_sim".
  virtual std::string_view spu_key() const noexcept = 0;

  /// Returns the byte order of the SPUs. Every number in main storage that their programs read or write has
  /// this order. DMA copies bytes unchanged. Members of Machine take and return words of mailboxes and
  /// signals, and addresses, as numbers in the host's order.
  virtual std::endian byte_order() const noexcept { return std::endian::native; }

  /// Starts a program on an idle SPE. Throws SpeError if the program was not compiled for this machine, or
  /// the SPE is running or waits for resume(). The kernel receives `argument`: the effective address of its
  /// control block, 16-byte aligned by convention.
  virtual void start(unsigned spe, const SpeProgram& program, ea_t argument) = 0;
  /// Blocks until the kernel has stopped. Throws SpeError with the SPE's error if the kernel stopped because
  /// of an error. When an SPE stops with an error, all others are interrupted, so that none waits for this
  /// SPE for ever. Called again before resume() or start(), wait() returns the same stop again. Returns
  /// {exit, 0} after it has thrown, and for an SPE that was never started.
  virtual SpeStop wait(unsigned spe) = 0;
  /// Lets a kernel that stopped with a signal go on after its stop instruction. Throws SpeError if the kernel
  /// did not stop with a signal.
  virtual void resume(unsigned spe) = 0;
  /// Returns true while a kernel runs; false while a kernel waits for resume().
  virtual bool running(unsigned spe) const = 0;
  /// Stops every kernel that stalls on a channel or waits for resume(), now or later; wait() then
  /// throws SpeError. For shutdown.
  virtual void interrupt() noexcept = 0;

  /// Writes a word to the inbound mailbox; blocks while it is full (libspe2's SPE_MBOX_ALL_BLOCKING). Throws
  /// SpeError if the SPE has stopped with the mailbox full.
  virtual void write_in_mailbox(unsigned spe, std::uint32_t value) = 0;
  /// Returns the number of free entries of the inbound mailbox, 0..4.
  virtual unsigned in_mailbox_space(unsigned spe) const = 0;
  /// Take the word out of the outbound (interrupt) mailbox and return it; return nothing if the mailbox is
  /// empty. Never block.
  virtual std::optional<std::uint32_t> read_out_mailbox(unsigned spe) = 0;
  virtual std::optional<std::uint32_t> read_out_interrupt_mailbox(unsigned spe) = 0;
  /// Writes a signal notification register.
  virtual void write_signal(unsigned spe, Signal which, std::uint32_t value) = 0;
  /// Sleeps until an SPE has a word in an outbound mailbox, until an SPE has stopped since the last call, or
  /// until the timeout. Returns false on timeout.
  virtual bool wait_for_mail(std::chrono::milliseconds timeout) = 0;

  // Proxy commands: DMA between main storage and the local store of an SPE on behalf of the PPE. `op` is a
  // get or put, with or without fence or barrier, but no list; `lsa` is the offset in local store, from
  // addresses().local_store; `tag` is 0..15. On `native`, commands complete at once, and commands that it
  // cannot execute throw SpeError.

  /// Queues the command. Blocks while all 8 entries of the queue are in use.
  virtual void proxy_command(unsigned spe, MfcOpcode op, std::uint32_t lsa, ea_t ea, std::uint32_t size,
                             std::uint32_t tag) = 0;
  /// Returns the tag groups in `mask` whose proxy commands are complete. Requests `any` and `all` block until
  /// one group or all groups are complete.
  virtual std::uint32_t proxy_tag_status(unsigned spe, std::uint32_t mask, TagUpdate request) = 0;

  // Objects in main memory. `cell_emu` and `cell_sim` check that a transfer that touches an object stays
  // within the object (Rule::object_bounds). Lock-line commands are not checked, because they move whole
  // lines. Thread-safe.

  /// Registers an object. Throws InputError if it has no bytes or overlaps another.
  virtual void register_object(const MemoryObject&) {}
  /// Removes the object that begins at an address; call this before the memory is used for something else.
  /// Throws InputError if no registered object begins there.
  virtual void forget_object(ea_t) {}

  /// Returns the rules that were broken since the machine was made, in the order of their discovery; only the
  /// first few thousand are kept. Empty on `native`, which does not check.
  virtual std::vector<Diagnostic> diagnostics() const { return {}; }

  /// Returns the addresses where an SPE's local store and registers are mapped.
  virtual SpeAddresses addresses(unsigned spe) const = 0;
  virtual SpeStatistics statistics(unsigned spe) const = 0;
};

/// Makes a machine. Throws InputError for a value out of range, and for a SIMD level that the build or the
/// CPU lacks.
CELLTRACE_EXPORT std::unique_ptr<Machine> make_machine(const MachineConfig& config);

/// Returns the effective address of an object in main memory.
inline ea_t to_ea(const void* object) {
  return reinterpret_cast<std::uintptr_t>(object);
}

/// Describes an array, a record, or the elements of a contiguous container for EmulationConfig::objects and
/// Machine::register_object().
template <class T> MemoryObject memory_object(const T& object, std::string name = {}) {
  if constexpr (requires { std::data(object), std::size(object); })
    return {to_ea(std::data(object)), std::size(object) * sizeof(*std::data(object)), std::move(name)};
  else
    return {to_ea(&object), sizeof object, std::move(name)};
}

} // namespace celltrace
