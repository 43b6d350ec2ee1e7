#include "backends/cell_emu/machine.hpp"

#include "backends/cell_emu/config_rules.hpp"
#include "backends/cell_emu/free_scheduler.hpp"
#include "backends/cell_emu/local_store_watch.hpp"
#include "backends/cell_emu/lockstep_scheduler.hpp"
#include "backends/cell_emu/mfc_rules.hpp"
#include "backends/cell_emu/program_guard.hpp"
#include "backends/cell_emu/simulator/simulated_programs.hpp"
#include "backends/cell_emu/simulator/simulated_spu.hpp"
#include "backends/cell_emu/spu.hpp"

#include <algorithm>
#include <exception>
#include <functional>
#include <utility>

namespace celltrace::cell_emu {
namespace {

MachineConfig checked(MachineConfig config) {
  if (config.spes > kMaxSpes)
    throw InputError("cell_emu has at most " + std::to_string(kMaxSpes) + " SPEs, not " +
                     std::to_string(config.spes));
  check_emulation(config.emulation);
  if (config.spes == 0) config.spes = config.emulation.timing.spes;
  for (const SignalMode mode : config.signal_mode)
    if (mode != SignalMode::overwrite && mode != SignalMode::logical_or)
      throw InputError("a signal notification register is in overwrite or in logical_or mode");
  const std::uint64_t taken = std::uint64_t{config.code_bytes} + config.stack_bytes + 2 * kLineBytes;
  if (taken > kLocalStoreBytes)
    throw InputError("code (" + std::to_string(config.code_bytes) + " bytes) and stack (" +
                     std::to_string(config.stack_bytes) +
                     " bytes) leave no arena in a local store of 262144 bytes");
  return config;
}

/// Returns the arena of a program, which is the local store between its code and its stack; empty if nothing
/// is left.
ArenaRange arena_of(LocalStoreUse use) {
  const std::uint64_t begin = (std::uint64_t{use.code_bytes} + kLineBytes - 1) / kLineBytes * kLineBytes;
  const std::uint64_t taken = begin + use.stack_bytes + 2 * kLineBytes;
  if (taken > kLocalStoreBytes) return {0, 0};
  return {static_cast<std::uint32_t>(begin), kLocalStoreBytes - use.stack_bytes};
}

std::unique_ptr<Trace> make_trace(const MachineConfig& config) {
  if (config.emulation.trace == nullptr) return nullptr;
  return std::make_unique<Trace>(*config.emulation.trace, config.spes, config.emulation.timing.clock_hz);
}

class EmulatedCell final : public Machine {
public:
  explicit EmulatedCell(const MachineConfig& config);
  ~EmulatedCell() override;

  Backend backend() const noexcept override { return simulated() ? Backend::cell_sim : Backend::cell_emu; }
  unsigned spe_count() const noexcept override { return map_.spes(); }
  bool direct_memory() const noexcept override { return Spu::direct_memory; }
  std::string_view spu_key() const noexcept override { return simulated() ? SimulatedSpu::kKey : Spu::kKey; }
  std::endian byte_order() const noexcept override {
    return simulated() ? std::endian::big : std::endian::native;
  }

  void start(unsigned spe, const SpeProgram& program, ea_t argument) override;
  SpeStop wait(unsigned spe) override;
  void resume(unsigned spe) override;
  bool running(unsigned spe) const override;
  void interrupt() noexcept override;

  void write_in_mailbox(unsigned spe, std::uint32_t value) override;
  unsigned in_mailbox_space(unsigned spe) const override;
  std::optional<std::uint32_t> read_out_mailbox(unsigned spe) override {
    Spe& from = *spes_.at(spe);
    return from.state.read_out_mailbox(scheduler_->enter());
  }
  std::optional<std::uint32_t> read_out_interrupt_mailbox(unsigned spe) override {
    Spe& from = *spes_.at(spe);
    return from.state.read_out_interrupt_mailbox(scheduler_->enter());
  }
  void write_signal(unsigned spe, Signal which, std::uint32_t value) override;
  bool wait_for_mail(std::chrono::milliseconds timeout) override;

  void proxy_command(unsigned spe, MfcOpcode op, std::uint32_t lsa, ea_t ea, std::uint32_t size,
                     std::uint32_t tag) override;
  std::uint32_t proxy_tag_status(unsigned spe, std::uint32_t mask, TagUpdate request) override;

  void register_object(const MemoryObject& object) override { bounds_.objects.add(object); }
  void forget_object(ea_t begin) override { bounds_.objects.remove(begin); }

  std::vector<Diagnostic> diagnostics() const override { return log_.all(); }
  SpeAddresses addresses(unsigned spe) const override {
    spes_.at(spe);
    return map_.addresses(spe);
  }
  SpeStatistics statistics(unsigned spe) const override { return spes_.at(spe)->counters.statistics(); }

private:
  /// Returns true if the SPUs execute machine code.
  bool simulated() const { return config_.backend == Backend::cell_sim; }
  bool lockstep() const { return config_.emulation.schedule == Schedule::lockstep; }
  std::unique_ptr<Scheduler> make_scheduler();
  ArenaState arena(unsigned spe, ArenaRange range) const;
  /// The run of a program on an SPE, from its start to its end and clean-up.
  using Run = std::function<void(Spe&)>;
  Run host_code(unsigned spe, const SpeProgram& program, ea_t argument, ArenaRange& range);
  Run machine_code(unsigned spe, const SpeProgram& program, ea_t argument, ArenaRange& range);
  template <class AnySpu, class Execute, class Check>
  void execute(Spe& spe, AnySpu& spu, Execute program, Check check);
  void run(Spe& spe, const Run& program);
  [[noreturn]] void refuse_too_large(unsigned spe, const std::string& name, LocalStoreUse use);
  void fail(Spe& spe, const std::string& error);
  void report_ppe(Rule rule, unsigned spe, const std::string& what);
  void wait_until_stopped(const Spe& spe);
  void collect(Spe& spe);
  void resume_when_idle();

  const MachineConfig config_;
  AddressMap map_;
  std::unique_ptr<Trace> trace_;
  DiagnosticLog log_;
  Flights flights_;
  Bounds bounds_;
  std::vector<DmaTiming> timing_; ///< one for all SPEs, but on the free schedule one for each SPE
  std::vector<ProblemState*> registers_;
  Bus bus_;
  const MfcContext mfc_context_;
  Spes spes_;
  std::unique_ptr<Scheduler> scheduler_;
  std::unique_ptr<SimulatedPrograms> programs_; ///< only for SPUs that execute machine code
  /// By SPE: true if its program was started and its end not yet waited for.
  std::vector<bool> started_;
  unsigned stops_seen_ = 0; ///< programs that had stopped when the PPE last waited for mail
  bool failed_ = false;     ///< true if an SPE has failed and interrupted the others; PPE thread only
  std::atomic<bool> interrupted_{false};
};

EmulatedCell::EmulatedCell(const MachineConfig& config)
    : config_(checked(config)), map_(config_.spes), trace_(make_trace(config_)),
      log_(
          config_.emulation, trace_ == nullptr
                                 ? DiagnosticLog::Listener{}
                                 : [this](const Diagnostic& diagnostic) { trace_->diagnostic(diagnostic); }),
      flights_(config_.spes), bounds_(config_.spes, config_.emulation.objects),
      bus_(map_, registers_), mfc_context_{bus_,         flights_,    bounds_, log_, config_.emulation,
                                           trace_.get(), byte_order()},
      started_(config_.spes) {
  scheduler_ = make_scheduler();
  if (simulated()) programs_ = std::make_unique<SimulatedPrograms>(config_, map_);
  timing_.assign(lockstep() ? 1 : config_.spes, DmaTiming(config_.emulation.timing, config_.spes));
  for (unsigned spe = 0; spe < config_.spes; ++spe) {
    spes_.push_back(std::make_unique<Spe>(spe, config_.signal_mode, *scheduler_, mfc_context_,
                                          timing_[lockstep() ? 0 : spe]));
    registers_.push_back(&spes_.back()->state);
  }
}

std::unique_ptr<Scheduler> EmulatedCell::make_scheduler() {
  if (lockstep()) return std::make_unique<LockstepScheduler>(spes_, config_.spes, log_, config_.emulation);
  return std::make_unique<FreeScheduler>(spes_, config_.spes, log_);
}

EmulatedCell::~EmulatedCell() {
  interrupt();
  scheduler_->shut_down();
}

// --- run control ---

ArenaState EmulatedCell::arena(unsigned spe, ArenaRange range) const {
  std::uint8_t* const base = map_.local_store(spe);
  return {base + range.begin, base + range.end, base + range.begin};
}

void EmulatedCell::start(unsigned spe, const SpeProgram& program, ea_t argument) {
  Spe& started = *spes_.at(spe);
  scheduler_->enter();
  if (started.running) throw SpeError("SPE " + std::to_string(spe) + " is running");
  ArenaRange range{0, kLocalStoreBytes};
  const Run entered =
      simulated() ? machine_code(spe, program, argument, range) : host_code(spe, program, argument, range);
  collect(started);
  started.error.clear();
  started.exit_code = 0;
  started.mfc.begin_program(range);
  started.state.start();
  scheduler_->start(started, [this, &started, entered] { run(started, entered); });
  started_[spe] = true;
}

EmulatedCell::Run EmulatedCell::host_code(unsigned spe, const SpeProgram& program, ea_t argument,
                                          ArenaRange& range) {
  const SpeProgram::Entry entry = program.entry(Spu::kKey);
  if (!entry) throw SpeError("program \"" + program.name() + "\" was not compiled for cell_emu");
  const LocalStoreUse use =
      program.local_store_use().value_or(LocalStoreUse{config_.code_bytes, config_.stack_bytes});
  range = arena_of(use);
  if (range.end == 0) refuse_too_large(spe, program.name(), use);
  return [this, entry, argument, range](Spe& runs) {
    const ProgramGuard guard(map_.local_store(runs.id), range);
    bus_.hold_local_store(runs.id, [&] { guard.fill(); });
    HostCodeSpu spu(runs, {mfc_context_, *scheduler_}, arena(runs.id, range));
    execute(
        runs, spu, [&] { entry(static_cast<Spu*>(&spu), argument); },
        [&] { bus_.hold_local_store(runs.id, [&] { guard.check(runs.id, runs.mfc.arena_end(), log_); }); });
  };
}

EmulatedCell::Run EmulatedCell::machine_code(unsigned spe, const SpeProgram& program, ea_t argument,
                                             ArenaRange&) {
  const auto code = programs_->find(program);
  const StartRegisters arguments = programs_->arguments(*code, spe, argument);
  return [this, code, arguments](Spe& runs) {
    bus_.hold_local_store(runs.id, [&] {
      fill_with_poison(map_.local_store(runs.id), kLocalStoreBytes);
      code->elf().load(map_.local_store(runs.id));
    });
    SimulatedSpu spu(
        runs, {mfc_context_, *scheduler_}, *code, [this](auto... call) { return programs_->call(call...); },
        config_.simulation.profile);
    execute(
        runs, spu, [&] { spu.run(arguments); }, [] {});
  };
}

void EmulatedCell::refuse_too_large(unsigned spe, const std::string& name, LocalStoreUse use) {
  Diagnostic diagnostic;
  diagnostic.rule = Rule::local_store_exhausted;
  diagnostic.spe = spe;
  const std::string what = "program \"" + name + "\" takes " + std::to_string(use.code_bytes) +
                           " bytes of code and data and " + std::to_string(use.stack_bytes) +
                           " of stack: " + std::string(text_of(Rule::local_store_exhausted));
  log_.report(diagnostic, what);
  throw SpeError("SPE " + std::to_string(spe) + ": " + what);
}

template <class AnySpu, class Execute, class Check>
void EmulatedCell::execute(Spe& spe, AnySpu& spu, Execute program, Check check) {
  try {
    program();
  } catch (const SpeExit& exit) {
    spe.exit_code = exit.code;
  } catch (...) {
    spu.abandon();
    throw;
  }
  spu.finish();
  check();
}

void EmulatedCell::run(Spe& spe, const Run& program) {
  const auto broken_off = [&](const std::string& error) {
    spe.mfc.abandon();
    fail(spe, error);
  };
  const auto threw = [&](const std::string& what) {
    Diagnostic diagnostic;
    diagnostic.rule = Rule::kernel_exception;
    diagnostic.spe = spe.id;
    diagnostic.cycle = spe.now;
    const bool kept = log_.note(diagnostic, what + ": " + std::string(text_of(diagnostic.rule)));
    broken_off(kept ? diagnostic.text : "SPE " + std::to_string(spe.id) + ": " + what);
  };
  try {
    program(spe);
  } catch (const SpeError& error) {
    broken_off(error.what());
  } catch (const std::exception& error) {
    threw(error.what());
  } catch (...) {
    threw("an unknown exception");
  }
}

void EmulatedCell::fail(Spe& spe, const std::string& error) {
  spe.error = error;
  scheduler_->break_off(", because another SPE failed first: " + error);
}

void EmulatedCell::wait_until_stopped(const Spe& spe) {
  const auto stopped = [&] { return !spe.running || spe.paused(); };
  const std::string what = "SPE " + std::to_string(spe.id) + " to stop";
  try {
    scheduler_->wait(stopped, std::nullopt, what);
  } catch (const SpeError&) {
    // The exception reports a deadlock, which also ends the programs of the SPEs.
    scheduler_->wait(stopped, std::nullopt, what);
  }
}

SpeStop EmulatedCell::wait(unsigned spe) {
  Spe& stopped = *spes_.at(spe);
  if (!started_[spe]) return {SpeStop::Reason::exit, stopped.exit_code};
  wait_until_stopped(stopped);
  if (stopped.running) return {SpeStop::Reason::stop_and_signal, stopped.signal};
  collect(stopped);
  if (!stopped.error.empty()) {
    stopped.exit_code = 0;
    throw SpeError(std::exchange(stopped.error, {}));
  }
  return {SpeStop::Reason::exit, stopped.exit_code};
}

void EmulatedCell::resume(unsigned spe) {
  Spe& paused = *spes_.at(spe);
  scheduler_->enter();
  if (!paused.paused()) throw SpeError("SPE " + std::to_string(spe) + " has not stopped with a signal");
  scheduler_->resume(paused);
}

bool EmulatedCell::running(unsigned spe) const {
  const Spe& asked = *spes_.at(spe);
  scheduler_->enter();
  return asked.running && !asked.paused();
}

void EmulatedCell::collect(Spe& spe) {
  if (!started_[spe.id]) return;
  scheduler_->collect(spe);
  started_[spe.id] = false;
  failed_ = failed_ || !spe.error.empty();
  resume_when_idle();
}

/// Withdraws interrupts after a failure, once all programs have been waited for.
void EmulatedCell::resume_when_idle() {
  if (!failed_ || std::find(started_.begin(), started_.end(), true) != started_.end()) return;
  failed_ = false;
  for (const auto& spe : spes_)
    spe->state.resume();
  // interrupt(), which is permanent, may have been called by another thread meanwhile.
  if (interrupted_) scheduler_->interrupt();
}

void EmulatedCell::interrupt() noexcept {
  interrupted_ = true;
  scheduler_->interrupt();
}

// --- registers ---

void EmulatedCell::report_ppe(Rule rule, unsigned spe, const std::string& what) {
  Diagnostic diagnostic;
  diagnostic.rule = rule;
  diagnostic.spe = Diagnostic::kPpe;
  diagnostic.other_spe = spe;
  log_.report(diagnostic, what + " of SPE " + std::to_string(spe) + ": " + std::string(text_of(rule)));
}

void EmulatedCell::write_in_mailbox(unsigned spe, std::uint32_t value) {
  Spe& to = *spes_.at(spe);
  const auto full = [&] { return to.state.in_mailbox_count() == kInboundMailboxEntries; };
  const auto stopped = [&] { return !to.running || to.paused(); };
  scheduler_->wait([&] { return !full() || stopped(); }, std::nullopt,
                   "room in the mailbox of SPE " + std::to_string(spe));
  if (full())
    throw SpeError("SPE " + std::to_string(spe) + ": is not running, and its inbound mailbox is full");
  // On the lockstep schedule nothing has happened since the wait; on the free schedule an SPE may have filled
  // the mailbox meanwhile.
  if (!to.state.write_in_mailbox(value, {Diagnostic::kPpe, scheduler_->post_at_once()}))
    report_ppe(Rule::mailbox_overwritten, spe, "inbound mailbox");
}

unsigned EmulatedCell::in_mailbox_space(unsigned spe) const {
  const Spe& asked = *spes_.at(spe);
  scheduler_->enter();
  return kInboundMailboxEntries - asked.state.in_mailbox_count();
}

void EmulatedCell::write_signal(unsigned spe, Signal which, std::uint32_t value) {
  Spe& to = *spes_.at(spe);
  if (to.state.write_signal(which, value, {Diagnostic::kPpe, scheduler_->post()})) return;
  report_ppe(Rule::signal_overwritten, spe, which == Signal::one ? "signal 1" : "signal 2");
}

bool EmulatedCell::wait_for_mail(std::chrono::milliseconds timeout) {
  const auto news = [&] {
    if (scheduler_->stops() != stops_seen_) return true;
    return std::any_of(spes_.begin(), spes_.end(),
                       [](const auto& spe) { return spe->state.has_outbound_mail(); });
  };
  const bool rang = scheduler_->wait(news, timeout, "mail");
  stops_seen_ = scheduler_->stops();
  return rang;
}

// --- proxy commands ---

void EmulatedCell::proxy_command(unsigned spe, MfcOpcode op, std::uint32_t lsa, ea_t ea, std::uint32_t size,
                                 std::uint32_t tag) {
  Mfc& mfc = spes_.at(spe)->mfc;
  const MfcCommand command{op, tag, lsa, size, ea};
  if (!mfc.check_proxy(command, scheduler_->enter())) return;
  if (!lockstep()) return mfc.perform_proxy(command);
  scheduler_->wait([&] { return mfc.free_proxy_entries() != 0; }, std::nullopt,
                   "room in the proxy queue of SPE " + std::to_string(spe));
  mfc.issue_proxy(command, scheduler_->enter());
}

std::uint32_t EmulatedCell::proxy_tag_status(unsigned spe, std::uint32_t mask, TagUpdate request) {
  Mfc& mfc = spes_.at(spe)->mfc;
  Cycle now = scheduler_->enter();
  const auto complete = [&] { return lockstep() ? mask & ~mfc.outstanding_proxy_tags() : mask; };
  const auto ready = [&] {
    return request == TagUpdate::immediate ||
           (request == TagUpdate::all ? complete() == mask : complete() != 0);
  };
  if (!ready()) {
    scheduler_->wait(ready, std::nullopt, "a proxy tag group of SPE " + std::to_string(spe));
    now = scheduler_->enter();
  }
  const std::uint32_t tags = complete();
  if (lockstep()) mfc.observe_proxy(tags, now);
  return tags;
}

} // namespace

std::unique_ptr<Machine> make_machine(const MachineConfig& config) {
  return std::make_unique<EmulatedCell>(config);
}

} // namespace celltrace::cell_emu
