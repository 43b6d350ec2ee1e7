#include "backends/cell_emu/machine.hpp"

#include "backends/cell_emu/spu.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

namespace celltrace::cell_emu {
namespace {

constexpr unsigned kMaxSpes = 256;
constexpr unsigned kDefaultSpes = 8;

MachineConfig checked(MachineConfig config) {
  if (config.spes > kMaxSpes)
    throw InputError("cell_emu has at most " + std::to_string(kMaxSpes) + " SPEs, not " +
                     std::to_string(config.spes));
  if (config.spes == 0) config.spes = kDefaultSpes;
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

/// What the PPE keeps of one SPE.
struct Spe {
  std::thread thread; ///< joinable from start() until somebody has waited
  Counters counters;
  std::string error; ///< of the last run; empty: none. Written by the thread, read after it was joined.
};

class EmulatedCell final : public Machine {
public:
  explicit EmulatedCell(const MachineConfig& config);
  ~EmulatedCell() override;

  std::string_view backend() const noexcept override { return "cell_emu"; }
  unsigned spe_count() const noexcept override { return map_.spes(); }
  std::string_view spu_key() const noexcept override { return Spu::kKey; }

  void start(unsigned spe, const SpeProgram& program, ea_t argument) override;
  void wait(unsigned spe) override;
  bool running(unsigned spe) const override { return problem_states_.at(spe)->running(); }
  void interrupt() noexcept override;

  void write_in_mailbox(unsigned spe, std::uint32_t value) override {
    problem_states_.at(spe)->write_in_mailbox_when_free(value);
  }
  unsigned in_mailbox_space(unsigned spe) const override {
    return kInboundMailboxEntries - problem_states_.at(spe)->in_mailbox_count();
  }
  std::optional<std::uint32_t> read_out_mailbox(unsigned spe) override {
    return problem_states_.at(spe)->take_out_mailbox();
  }
  std::optional<std::uint32_t> read_out_interrupt_mailbox(unsigned spe) override {
    return problem_states_.at(spe)->take_out_interrupt_mailbox();
  }
  void write_signal(unsigned spe, Signal which, std::uint32_t value) override {
    problem_states_.at(spe)->write_signal(which, value);
  }
  bool wait_for_mail(std::chrono::milliseconds timeout) override;

  SpeAddresses addresses(unsigned spe) const override {
    problem_states_.at(spe);
    return map_.addresses(spe);
  }
  SpeStatistics statistics(unsigned spe) const override { return spes_.at(spe)->counters.statistics(); }

private:
  ArenaState arena(unsigned spe) const;
  void run(unsigned spe, SpeProgram::Entry entry, ea_t argument);
  void fail(unsigned spe, const std::string& error);
  void join(unsigned spe);
  void resume_when_idle();

  const MachineConfig config_;
  AddressMap map_;
  PpeBell bell_;
  Bus::ProblemStates problem_states_;
  Bus bus_;
  std::vector<std::unique_ptr<Spe>> spes_;
  bool failed_ = false; ///< an SPE has failed and interrupted the others. PPE thread only.
  std::atomic<bool> interrupted_{false};
};

EmulatedCell::EmulatedCell(const MachineConfig& config)
    : config_(checked(config)), map_(config_.spes), bus_(map_, problem_states_) {
  for (unsigned spe = 0; spe < config_.spes; ++spe) {
    problem_states_.push_back(std::make_unique<ProblemState>(spe, config_.signal_mode, bell_));
    spes_.push_back(std::make_unique<Spe>());
  }
}

EmulatedCell::~EmulatedCell() {
  interrupt();
  for (const auto& spe : spes_)
    if (spe->thread.joinable()) spe->thread.join();
}

// --- run control ---

ArenaState EmulatedCell::arena(unsigned spe) const {
  std::uint8_t* const base = map_.local_store(spe);
  std::uint8_t* const begin = base + (config_.code_bytes + kLineBytes - 1) / kLineBytes * kLineBytes;
  return {begin, base + kLocalStoreBytes - config_.stack_bytes, begin};
}

void EmulatedCell::start(unsigned spe, const SpeProgram& program, ea_t argument) {
  if (running(spe)) throw SpeError("SPE " + std::to_string(spe) + " is running");
  const SpeProgram::Entry entry = program.entry(Spu::kKey);
  if (entry == nullptr) throw SpeError("program \"" + program.name() + "\" was not compiled for cell_emu");
  join(spe);
  spes_[spe]->error.clear();
  problem_states_[spe]->start();
  try {
    spes_[spe]->thread = std::thread([this, spe, entry, argument] { run(spe, entry, argument); });
  } catch (...) {
    problem_states_[spe]->stop();
    throw;
  }
}

void EmulatedCell::run(unsigned spe, SpeProgram::Entry entry, ea_t argument) {
  try {
    Spu spu(spe, bus_, *problem_states_[spe], spes_[spe]->counters, arena(spe));
    entry(&spu, argument);
    spu.finish();
  } catch (const SpeError& error) {
    fail(spe, error.what());
  } catch (const std::exception& error) {
    fail(spe, "SPE " + std::to_string(spe) + ": " + error.what());
  } catch (...) {
    fail(spe, "SPE " + std::to_string(spe) + ": stopped by an unknown exception");
  }
  problem_states_[spe]->stop();
  bell_.ring_stop();
}

void EmulatedCell::fail(unsigned spe, const std::string& error) {
  spes_[spe]->error = error;
  for (const auto& problem_state : problem_states_)
    problem_state->interrupt(error);
}

void EmulatedCell::wait(unsigned spe) {
  const auto& stopped = spes_.at(spe);
  join(spe);
  if (!stopped->error.empty()) throw SpeError(std::exchange(stopped->error, {}));
}

void EmulatedCell::join(unsigned spe) {
  if (!spes_[spe]->thread.joinable()) return;
  spes_[spe]->thread.join();
  failed_ = failed_ || !spes_[spe]->error.empty();
  resume_when_idle();
}

/// Once nobody is left whom a failure could leave waiting, kernels may stall again.
void EmulatedCell::resume_when_idle() {
  const auto busy = [](const auto& spe) { return spe->thread.joinable(); };
  if (!failed_ || std::any_of(spes_.begin(), spes_.end(), busy)) return;
  failed_ = false;
  for (const auto& problem_state : problem_states_)
    problem_state->resume();
  // An interrupt() from another thread may have come in between; it is for good.
  if (interrupted_) interrupt();
}

void EmulatedCell::interrupt() noexcept {
  interrupted_ = true;
  for (const auto& problem_state : problem_states_)
    problem_state->interrupt({});
}

bool EmulatedCell::wait_for_mail(std::chrono::milliseconds timeout) {
  return bell_.wait_for(timeout, [&] {
    return std::any_of(problem_states_.begin(), problem_states_.end(),
                       [](const auto& problem_state) { return problem_state->has_outbound_mail(); });
  });
}

} // namespace

std::unique_ptr<Machine> make_machine(const MachineConfig& config) {
  return std::make_unique<EmulatedCell>(config);
}

} // namespace celltrace::cell_emu
