// HostCodeSpu: the SPU that runs a kernel compiled for the host. It executes the runtime's operations on
// channels and the MFC, and advances the SPE's virtual clock by the cycles of counted operations.
#pragma once

#include "backends/cell_emu/spu_core.hpp"
#include "celltrace/spe/emulated_spu.hpp"

#include <functional>
#include <map>

namespace celltrace::cell_emu {

/// The SPU during one run of a kernel on one SPE. Thread safety: belongs to the thread that runs the SPE.
class HostCodeSpu final : public SpuCore, public Spu {
public:
  /// Makes the SPU; the kernel allocates from `arena`, a part of the SPE's local store.
  HostCodeSpu(Spe& spe, const SpuContext& context, const ArenaState& arena);
  ~HostCodeSpu();

  using Spu::id;
  void release(std::uint8_t* marked, CallSite site) override;
  SpeAddresses addresses(std::uint32_t spe) const override;
  ArenaState& arena() override;

  std::uint32_t read_channel(unsigned channel) override;
  void write_channel(unsigned channel, std::uint32_t value) override;
  std::uint32_t channel_count(unsigned channel) override;

  void note(const char* what, std::uint32_t value) override;
  void* local_static(const void* key, std::uint32_t bytes, std::uint32_t alignment) override;
  void enable_interrupts(std::function<void(Spu&)> handler) override;
  void enable_interrupts() override;
  void disable_interrupts() override { interrupts_enabled_ = false; }
  Cycle cycles() override {
    settle();
    return now();
  }

  /// Completes queued commands after the kernel has returned, or stopped with an exit code, and reports what
  /// the kernel left undone.
  void finish();
  /// Ends the run of a kernel that ended with an exception.
  void abandon();

private:
  void allocated(void* begin, std::uint32_t bytes, std::uint32_t alignment, CallSite site) override;
  [[noreturn]] void throw_halted_by_instruction() override;
  [[noreturn]] void throw_halted(HaltCode code, CallSite site) override;
  void issue(MfcOpcode op, std::uint32_t lsa, ea_t ea, std::uint32_t size, std::uint32_t tag) override;
  void fetch_module(const CodeModule& module) override;
  [[noreturn]] void report_absent_module(const CodeModule& module, CallSite site) override;
  void stop(std::uint32_t code) override;

  /// Advances virtual time by the operations that were counted since the last call.
  void settle();
  void charge(std::uint32_t channel_reads, std::uint32_t channel_writes);
  void run_interrupts();

  ArenaState arena_;
  std::map<const void*, void*> statics_;
  bool in_handler_ = false;
  std::function<void(Spu&)> interrupt_handler_;
};

} // namespace celltrace::cell_emu
