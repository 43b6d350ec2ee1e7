#include "backends/cell_emu/simulator/ppe_calls.hpp"

#include "backends/cell_emu/simulator/ppe/ppe_state.hpp"

#include <mutex>
#include <utility>

namespace celltrace::cell_emu {

namespace {

constexpr unsigned kC99 = 0x2100, kPosix = 0x2101, kLinux = 0x2104, kMemory = 0x2105;

std::span<const PpeCall> calls_of(unsigned code) {
  switch (code) {
  case kC99:
    return c99_calls();
  case kPosix:
    return posix_calls();
  case kMemory:
    return memory_calls();
  default:
    return {};
  }
}

CallResult answer(const PpeCall& call, PpeState& state, const CallArguments& arguments) {
  if (call.answer == nullptr) throw CallFailed{SpuErrno::not_implemented};
  return call.answer(state, arguments);
}

} // namespace

struct PpeCalls::State {
  explicit State(PpeCallsConfig config) : shared(std::move(config)) {}

  std::mutex mutex;
  PpeState shared;
};

PpeCalls::PpeCalls(PpeCallsConfig config) : state_(std::make_unique<State>(std::move(config))) {
}

PpeCalls::~PpeCalls() = default;

bool PpeCalls::handle(unsigned code, std::uint8_t* local_store, std::uint32_t npc) {
  const LocalStoreView view(local_store);
  const auto word = view.load<std::uint32_t>(npc & ~3u);
  const std::lock_guard lock(state_->mutex);
  if (code == kLinux) {
    answer_linux_call(state_->shared, view, word);
    return true;
  }
  const std::span<const PpeCall> calls = calls_of(code);
  const std::uint32_t operation = word >> 24;
  if (operation == 0 || operation >= calls.size()) return false;

  const CallArguments arguments(view, word & 0xFFFFFF);
  try {
    const CallResult result = answer(calls[operation], state_->shared, arguments);
    arguments.set_result(result.word0, result.word1, SpuErrno::none);
  } catch (const CallFailed& failure) {
    // The failure value fills both words, for operations whose results have 64 bits.
    const std::uint32_t value = calls[operation].on_failure == PpeCall::OnFailure::zero ? 0 : 0xFFFFFFFF;
    arguments.set_result(value, value, failure.error);
  }
  return true;
}

} // namespace celltrace::cell_emu
