#include "backends/native/machine.hpp"

#include "backends/native/cpus.hpp"
#include "backends/native/proxy.hpp"
#include "backends/native/registers.hpp"
#include "backends/native/reservations.hpp"
#include "backends/native/spe.hpp"
#include "backends/native/spu_types.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace celltrace::native {

namespace {

constexpr unsigned kMaxSpes = 256;

unsigned spe_count_of(const MachineConfig& config) {
  if (config.spes > kMaxSpes)
    throw InputError("a machine has at most " + std::to_string(kMaxSpes) + " SPEs, not " +
                     std::to_string(config.spes));
  if (config.spes != 0) return config.spes;
  return std::min(static_cast<unsigned>(usable_cpus().size()), kMaxSpes);
}

/// Returns a CPU for each SPE if there are as many usable CPUs as SPEs. Without binding, two threads that
/// wake up at once may share one CPU for milliseconds, which is as long as a frame. Returns no CPUs
/// otherwise, because then the system balances better.
std::vector<unsigned> cpus_for(unsigned spes) {
  std::vector<unsigned> cpus = usable_cpus();
  if (spes == 1 || cpus.size() != spes) cpus.clear();
  return cpus;
}

std::string name_of(unsigned spe) {
  return "SPE " + std::to_string(spe);
}

/// An SPE with the thread that runs its kernel.
struct Worker {
  Worker(unsigned id, const MachineConfig& config, Doorbell& ppe) : spe(id, config.signal_mode, ppe) {}

  Spe spe;
  std::thread thread; ///< joinable from start() until the kernel's end has been waited for
  std::string error;  ///< written by the thread, read after it was joined; empty: none
};

class NativeMachine final : public Machine {
public:
  explicit NativeMachine(const MachineConfig& config);
  ~NativeMachine() override;

  Backend backend() const noexcept override { return Backend::native; }
  unsigned spe_count() const noexcept override { return static_cast<unsigned>(workers_.size()); }
  bool direct_memory() const noexcept override { return true; }
  std::string_view spu_key() const noexcept override { return current_type_->key; }

  void start(unsigned spe, const SpeProgram& program, ea_t argument) override;
  SpeStop wait(unsigned spe) override;
  void resume(unsigned spe) override;
  bool running(unsigned spe) const override { return worker(spe).spe.channels.running(); }
  void interrupt() noexcept override;

  void write_in_mailbox(unsigned spe, std::uint32_t value) override;
  unsigned in_mailbox_space(unsigned spe) const override;
  std::optional<std::uint32_t> read_out_mailbox(unsigned spe) override;
  std::optional<std::uint32_t> read_out_interrupt_mailbox(unsigned spe) override;
  void write_signal(unsigned spe, Signal which, std::uint32_t value) override;
  bool wait_for_mail(std::chrono::milliseconds timeout) override;

  void proxy_command(unsigned spe, MfcOpcode op, std::uint32_t lsa, ea_t ea, std::uint32_t size,
                     std::uint32_t tag) override;
  std::uint32_t proxy_tag_status(unsigned spe, std::uint32_t mask, TagUpdate request) override;

  SpeAddresses addresses(unsigned spe) const override { return addresses_.at(spe); }
  SpeStatistics statistics(unsigned spe) const override { return worker(spe).spe.counters.snapshot(); }

private:
  Worker& worker(unsigned spe) const { return *workers_.at(spe); }
  std::vector<Channels*> all_channels() const;
  void map_addresses();
  const SpuType& type_for(const SpeProgram& program) const;
  void run(Worker& worker, const SpuType& type, SpeProgram::Entry entry, ea_t argument);
  void fail(Worker& worker, const std::string& what);
  std::string interruption() const;
  void join(Worker& worker);
  void interrupt_all() noexcept;

  const std::vector<const SpuType*> types_; ///< the widest first; not empty
  const SpuType* current_type_;
  const std::vector<unsigned> cpus_; ///< CPU of each SPE; empty: threads are not bound
  Doorbell doorbell_;
  std::vector<std::unique_ptr<Worker>> workers_;
  std::unique_ptr<RegisterMap> registers_;
  std::unique_ptr<Reservations> reservations_;
  std::vector<SpeAddresses> addresses_;

  mutable std::mutex failure_mutex_;
  std::string failure_;    ///< error of the first SPE that failed since all SPEs were last idle
  bool shut_down_ = false; ///< true: interrupt() was called
};

NativeMachine::NativeMachine(const MachineConfig& config)
    : types_(usable_spu_types(config.simd)), current_type_(types_.front()),
      cpus_(cpus_for(spe_count_of(config))) {
  const unsigned count = spe_count_of(config);
  for (unsigned i = 0; i < count; ++i)
    workers_.push_back(std::make_unique<Worker>(i, config, doorbell_));
  registers_ = std::make_unique<RegisterMap>(all_channels());
  reservations_ = std::make_unique<Reservations>(all_channels());
  map_addresses();
  for (const auto& worker : workers_) {
    Spe& spe = worker->spe;
    spe.all = &addresses_;
    spe.mfc = std::make_unique<Mfc>(spe.id, spe.channels, *registers_, *reservations_, spe.counters);
  }
}

NativeMachine::~NativeMachine() {
  interrupt();
  for (const auto& worker : workers_)
    if (worker->thread.joinable()) worker->thread.join();
}

std::vector<Channels*> NativeMachine::all_channels() const {
  std::vector<Channels*> channels;
  for (const auto& worker : workers_)
    channels.push_back(&worker->spe.channels);
  return channels;
}

void NativeMachine::map_addresses() {
  using Register = RegisterMap::Register;
  for (unsigned i = 0; i < spe_count(); ++i)
    addresses_.push_back({to_ea(workers_[i]->spe.arena.begin), registers_->address(i, Register::signal_1),
                          registers_->address(i, Register::signal_2),
                          registers_->address(i, Register::in_mailbox)});
}

// --- kernels ---

const SpuType& NativeMachine::type_for(const SpeProgram& program) const {
  for (const SpuType* type : types_)
    if (program.entry(type->key) != nullptr) return *type;
  std::string keys;
  for (const SpuType* type : types_)
    keys += (keys.empty() ? "" : ", ") + type->key;
  throw SpeError("program \"" + program.name() + "\" was not compiled for this machine, which can run " +
                 keys);
}

void NativeMachine::start(unsigned spe, const SpeProgram& program, ea_t argument) {
  Worker& to_start = worker(spe);
  const Channels& channels = to_start.spe.channels;
  if (channels.running()) throw SpeError(name_of(spe) + " is running");
  if (channels.stopped_with_signal())
    throw SpeError(name_of(spe) + " has stopped with a signal and waits to be resumed");
  const SpuType& type = type_for(program);
  join(to_start);
  current_type_ = &type;
  to_start.error.clear();
  to_start.spe.begin();
  const SpeProgram::Entry entry = program.entry(type.key);
  to_start.thread =
      std::thread([this, &to_start, &type, entry, argument] { run(to_start, type, entry, argument); });
}

void NativeMachine::run(Worker& worker, const SpuType& type, SpeProgram::Entry entry, ea_t argument) {
  if (!cpus_.empty()) stay_on_cpu(cpus_[worker.spe.id]);
  std::uint32_t exit_code = 0;
  try {
    type.run(worker.spe, entry, argument);
  } catch (const Exited& exit) {
    exit_code = exit.code;
  } catch (const Interrupted&) {
    worker.error = name_of(worker.spe.id) + ": interrupted" + interruption();
  } catch (const std::exception& error) {
    fail(worker, error.what());
  } catch (...) {
    fail(worker, "stopped by an unknown exception");
  }
  worker.spe.end(exit_code);
}

void NativeMachine::fail(Worker& worker, const std::string& what) {
  worker.error = name_of(worker.spe.id) + ": " + what;
  {
    const std::lock_guard lock(failure_mutex_);
    if (failure_.empty()) failure_ = worker.error;
  }
  interrupt_all();
}

std::string NativeMachine::interruption() const {
  const std::lock_guard lock(failure_mutex_);
  return failure_.empty() ? "" : " (" + failure_ + ")";
}

SpeStop NativeMachine::wait(unsigned spe) {
  Worker& stopped = worker(spe);
  const SpeStop stop = stopped.spe.channels.wait_while_running();
  if (stop.reason == SpeStop::Reason::stop_and_signal) return stop;
  join(stopped);
  if (stopped.error.empty()) return stop;
  const std::string error = std::move(stopped.error);
  stopped.error.clear();
  throw SpeError(error);
}

void NativeMachine::resume(unsigned spe) {
  if (!worker(spe).spe.channels.resume()) throw SpeError(name_of(spe) + " has not stopped with a signal");
}

/// Joins a worker's thread. Withdraws the interrupts of a failure once all kernels have been waited for.
void NativeMachine::join(Worker& worker) {
  if (!worker.thread.joinable()) return;
  worker.thread.join();
  const std::lock_guard lock(failure_mutex_);
  const bool busy =
      std::any_of(workers_.begin(), workers_.end(), [](const auto& w) { return w->thread.joinable(); });
  if (busy || shut_down_ || failure_.empty()) return;
  failure_.clear();
  for (const auto& idle : workers_)
    idle->spe.channels.withdraw_interrupt();
}

void NativeMachine::interrupt() noexcept {
  {
    const std::lock_guard lock(failure_mutex_);
    shut_down_ = true;
  }
  interrupt_all();
}

void NativeMachine::interrupt_all() noexcept {
  for (const auto& worker : workers_)
    worker->spe.channels.interrupt();
}

// --- mailboxes and signals ---

void NativeMachine::write_in_mailbox(unsigned spe, std::uint32_t value) {
  if (!worker(spe).spe.channels.write_in_mailbox(value))
    throw SpeError(name_of(spe) + " has stopped with its inbound mailbox full");
}

unsigned NativeMachine::in_mailbox_space(unsigned spe) const {
  return kInboundMailboxEntries - worker(spe).spe.channels.in_mailbox_count();
}

std::optional<std::uint32_t> NativeMachine::read_out_mailbox(unsigned spe) {
  return worker(spe).spe.channels.read_out_mailbox(OutMailbox::plain);
}

std::optional<std::uint32_t> NativeMachine::read_out_interrupt_mailbox(unsigned spe) {
  return worker(spe).spe.channels.read_out_mailbox(OutMailbox::interrupting);
}

void NativeMachine::write_signal(unsigned spe, Signal which, std::uint32_t value) {
  worker(spe).spe.channels.write_signal(which, value);
}

bool NativeMachine::wait_for_mail(std::chrono::milliseconds timeout) {
  return doorbell_.wait(timeout, [&] {
    if (doorbell_.take_stop()) return true;
    return std::any_of(workers_.begin(), workers_.end(), [](const auto& worker) {
      const Channels& channels = worker->spe.channels;
      return channels.has_mail(OutMailbox::plain) || channels.has_mail(OutMailbox::interrupting);
    });
  });
}

// --- proxy commands ---

void NativeMachine::proxy_command(unsigned spe, MfcOpcode op, std::uint32_t lsa, ea_t ea, std::uint32_t size,
                                  std::uint32_t tag) {
  run_proxy_command(worker(spe).spe, *registers_, *reservations_, op, lsa, ea, size, tag);
}

std::uint32_t NativeMachine::proxy_tag_status(unsigned spe, std::uint32_t mask, TagUpdate /*request*/) {
  worker(spe); // throws if the SPE does not exist
  return mask;
}

} // namespace

std::unique_ptr<Machine> make_machine(const MachineConfig& config) {
  return std::make_unique<NativeMachine>(config);
}

} // namespace celltrace::native
