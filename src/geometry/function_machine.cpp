#include "geometry/function_machine.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "geometry/function_operations.hpp"

namespace celltrace {

namespace {

/// Limit on steps in one run.
constexpr std::uint64_t kMostSteps = 1'000'000'000;

constexpr std::size_t kMostMemoParameters = 8;
constexpr std::size_t kFirstMemoSlots = 64, kMostMemoSlots = 4096;
/// Limit on the size of all memos that grow, in bytes.
constexpr std::uint64_t kMostMemoBytes = 64u << 20;

} // namespace

/// A memo of a function's values: a table in which each set of arguments has one slot.
class FunctionMachine::Memo {
public:
  explicit Memo(std::size_t parameters) : parameters_(parameters) {}

  /// Returns the value for arguments with the same bits; null if the memo has no such value.
  const double* find(const double* arguments, std::uint64_t epoch) {
    if (epoch != epoch_ || slots_ == 0) return nullptr;
    const std::size_t slot = slot_of(arguments);
    const double* const entry = entry_of(slot);
    const bool is_found =
        is_used_[slot] != 0 && std::memcmp(entry, arguments, parameters_ * sizeof(double)) == 0;
    return is_found ? entry + parameters_ : nullptr;
  }

  void add(const double* arguments, double value, std::uint64_t epoch, std::uint64_t& bytes) {
    if (epoch != epoch_ || slots_ == 0) clear(epoch, std::max(slots_, kFirstMemoSlots));
    std::size_t slot = slot_of(arguments);
    if (is_used_[slot] != 0 && ++evictions_ > slots_ && slots_ < kMostMemoSlots && bytes < kMostMemoBytes) {
      clear(epoch, 2 * slots_);
      bytes += slots_ * (parameters_ + 1) * sizeof(double);
      slot = slot_of(arguments);
    }
    is_used_[slot] = 1;
    double* const entry = entry_of(slot);
    std::copy_n(arguments, parameters_, entry);
    entry[parameters_] = value;
  }

private:
  void clear(std::uint64_t epoch, std::size_t slots) {
    epoch_ = epoch;
    slots_ = slots;
    evictions_ = 0;
    is_used_.assign(slots, 0);
    entries_.resize(slots * (parameters_ + 1));
  }
  std::size_t slot_of(const double* arguments) const {
    constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15u;
    std::uint64_t hash = 0;
    for (std::size_t i = 0; i < parameters_; ++i)
      hash = std::rotl((hash ^ std::bit_cast<std::uint64_t>(arguments[i])) * kOdd, 31);
    return static_cast<std::size_t>((hash * kOdd) >> 40) & (slots_ - 1);
  }
  double* entry_of(std::size_t slot) { return entries_.data() + slot * (parameters_ + 1); }

  std::size_t parameters_, slots_ = 0;
  std::uint64_t epoch_ = 0, evictions_ = 0;
  std::vector<std::uint8_t> is_used_;
  std::vector<double> entries_; ///< arguments and value, slot by slot
};

struct FunctionCode::State {
  explicit State(const FunctionGraph& graph) : program(compile(graph)), memo(graph.parameters) {
    registers.resize(program.registers);
    std::copy(program.constants.begin(), program.constants.end(), registers.begin() + graph.parameters);
  }

  FunctionProgram program;
  std::vector<double> registers;
  FunctionMachine::Memo memo;
};

FunctionCode::FunctionCode(FunctionGraph graph) : graph_(std::move(graph)) {
}
FunctionCode::~FunctionCode() = default;

FunctionCode::State& FunctionCode::state() const {
  if (!state_) state_ = std::make_unique<State>(graph_);
  return *state_;
}

/// The place where a calling function continues.
struct FunctionMachine::Return {
  FunctionCode::State* caller;
  const FunctionStep* call;
};

FunctionMachine::FunctionMachine() = default;
FunctionMachine::~FunctionMachine() = default;

double FunctionMachine::run(const FunctionCode& function, const double* arguments,
                            const FunctionContext& context) {
  if (context != context_ || epoch_ == 0) {
    context_ = context;
    ++epoch_;
  }
  FunctionCode::State& state = function.state();
  std::copy_n(arguments, function.parameters(), state.registers.data());
  returns_.clear();
  return run(state);
}

double FunctionMachine::run(FunctionCode::State& function) {
  FunctionCode::State* state = &function;
  const FunctionStep* next = state->program.steps.data();
  double* r = state->registers.data();
  std::uint64_t steps = kMostSteps;
  const auto spend = [&steps](std::uint64_t count) {
    if (count > steps) throw FunctionFault{"this function takes too long"};
    steps -= count;
  };
  const auto jump = [&](const FunctionStep& step) { next = state->program.steps.data() + step.target(); };
  for (;;) {
    const FunctionStep& s = *next++;
    switch (s.op) {
#define CELLTRACE_UNARY(name)                                                                                \
  case FunctionOp::name:                                                                                     \
    r[s.result] = operations::name(r[s.a]);                                                                  \
    break;
#define CELLTRACE_BINARY(name)                                                                               \
  case FunctionOp::name:                                                                                     \
    r[s.result] = operations::name(r[s.a], r[s.b]);                                                          \
    break;
#define CELLTRACE_TERNARY(name)                                                                              \
  case FunctionOp::name:                                                                                     \
    r[s.result] = operations::name(r[s.a], r[s.b], r[s.c]);                                                  \
    break;
#define CELLTRACE_FUSED(first, second)                                                                       \
  case FunctionOp::first##_##second:                                                                         \
    r[s.result] = operations::second(operations::first(r[s.a], r[s.b]), r[s.c]);                             \
    break;
      CELLTRACE_UNARY_OPERATIONS(CELLTRACE_UNARY)
      CELLTRACE_BINARY_OPERATIONS(CELLTRACE_BINARY)
      CELLTRACE_TERNARY_OPERATIONS(CELLTRACE_TERNARY)
      CELLTRACE_FUSED_OPERATIONS(CELLTRACE_FUSED)
#undef CELLTRACE_UNARY
#undef CELLTRACE_BINARY
#undef CELLTRACE_TERNARY
#undef CELLTRACE_FUSED
    case FunctionOp::sum_of_products:
      r[s.result] = r[s.a] * r[s.b] + r[s.c] * r[s.d];
      break;
    case FunctionOp::difference_of_products:
      r[s.result] = r[s.a] * r[s.b] - r[s.c] * r[s.d];
      break;
    case FunctionOp::copy:
      r[s.result] = r[s.a];
      break;
    case FunctionOp::jump:
      jump(s);
      break;
    case FunctionOp::jump_unless_negative:
      if (!(r[s.a] < 0)) jump(s);
      break;
    case FunctionOp::jump_unless_zero:
      if (!(r[s.a] == 0)) jump(s);
      break;
    case FunctionOp::enter_loop:
      if (!(r[s.a] <= r[s.b])) jump(s);
      break;
    case FunctionOp::repeat:
      r[s.a] += 1;
      if (!(r[s.a] <= r[s.b])) break;
      spend(static_cast<std::uint64_t>(next - state->program.steps.data()) - s.target());
      jump(s);
      break;
    case FunctionOp::call_native: {
      const auto& native = *std::get<std::shared_ptr<const NativeFunction>>(state->program.callees[s.a]);
      const std::uint16_t* const operands = state->program.operands.data() + s.target();
      double arguments[kMostParameters];
      for (std::size_t i = 0; i < native.parameters(); ++i)
        arguments[i] = r[operands[i]];
      native.evaluate(arguments, context_, r + s.result);
      break;
    }
    case FunctionOp::call_code: {
      FunctionCode::State& callee =
          std::get<std::shared_ptr<const FunctionCode>>(state->program.callees[s.a])->state();
      const std::uint16_t* const operands = state->program.operands.data() + s.target();
      double* const parameters = callee.registers.data();
      for (std::size_t i = 0; i < callee.program.parameters; ++i)
        parameters[i] = r[operands[i]];
      if (callee.program.parameters <= kMostMemoParameters) {
        if (const double* const known = callee.memo.find(parameters, epoch_)) {
          r[s.result] = *known;
          break;
        }
      }
      spend(callee.program.steps.size());
      returns_.push_back({state, &s});
      state = &callee;
      r = parameters;
      next = callee.program.steps.data();
      break;
    }
    case FunctionOp::finish: {
      const double value = r[s.a];
      if (returns_.empty()) return value;
      if (state->program.parameters <= kMostMemoParameters) state->memo.add(r, value, epoch_, memo_bytes_);
      state = returns_.back().caller;
      const FunctionStep& call = *returns_.back().call;
      returns_.pop_back();
      r = state->registers.data();
      r[call.result] = value;
      next = &call + 1;
      break;
    }
    }
  }
}

} // namespace celltrace
