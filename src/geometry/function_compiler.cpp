// Compiles graphs to programs: finds the values that are needed, the operations that become one step, and a
// register for each value.
#include <algorithm>
#include <limits>
#include <utility>

#include "geometry/function_graph.hpp"
#include "geometry/function_machine.hpp"
#include "geometry/function_operations.hpp"

namespace celltrace {

namespace {

using Kind = FunctionNode::Kind;
using Register = std::uint16_t;

constexpr std::size_t kMostRegisters = std::numeric_limits<Register>::max();

/// The operation of a step, and the values that it reads.
struct Plan {
  FunctionOp op = FunctionOp::copy;
  unsigned count = 0;
  FunctionValue operands[4] = {};
};

/// Returns whether a step can do this operation together with another operation.
bool is_fusible(FunctionOp op) {
  return op == FunctionOp::add || op == FunctionOp::subtract || op == FunctionOp::multiply;
}

/// Returns the fused operation that applies `second` to the result of `first`. This result is the left
/// operand of `second` or, if `is_right` is true, the right operand.
FunctionOp fused(FunctionOp first, FunctionOp second, bool is_right) {
  // Numbers follow the order of CELLTRACE_FUSED_OPERATIONS.
  const auto number = [](FunctionOp op) {
    return op == FunctionOp::add ? 0u : op == FunctionOp::subtract ? 1u : 2u;
  };
  const unsigned which =
      second == FunctionOp::multiply ? 3 : number(second) + (is_right ? number(second) : 0);
  return static_cast<FunctionOp>(static_cast<unsigned>(FunctionOp::add_add) + 4 * number(first) + which);
}

class Compiler {
public:
  explicit Compiler(const FunctionGraph& graph)
      : graph_(graph), uses_(graph.nodes.size()), home_(graph.nodes.size()), inner_(graph.nodes.size()),
        born_(graph.nodes.size()), last_use_(graph.nodes.size()), register_(graph.nodes.size()) {}

  FunctionProgram compile() {
    find_uses();
    const FunctionBlock& body = graph_.blocks[graph_.body];
    fuse(graph_.body);
    number(body);
    touch(body.result);
    place_constants();
    find_expiries();
    position_ = 0;
    emit(body);
    emit_step(FunctionOp::finish, 0, register_of(body.result));
    program_.registers = static_cast<std::uint32_t>(next_);
    program_.callees = graph_.callees;
    return std::move(program_);
  }

private:
  // ---- Which values are needed ----

  /// Returns the value that has the registers of `value`: the call to which a component belongs, otherwise
  /// `value` itself.
  FunctionValue holder(FunctionValue value) const {
    const FunctionNode& node = graph_.nodes[value];
    return node.kind == Kind::component ? node.a : value;
  }
  void use(FunctionValue value) {
    if (uses_[holder(value)]++ == 0) waiting_.push_back(holder(value));
  }
  void find_uses() {
    use(graph_.blocks[graph_.body].result);
    while (!waiting_.empty()) {
      const FunctionNode& node = graph_.nodes[waiting_.back()];
      waiting_.pop_back();
      switch (node.kind) {
      case Kind::operation: {
        const FunctionValue operands[] = {node.a, node.b, node.c};
        for (unsigned i = 0; i < operand_count(node.op); ++i)
          use(operands[i]);
        break;
      }
      case Kind::call:
        for (const FunctionValue argument : arguments_of(node))
          use(argument);
        break;
      case Kind::select: {
        use(node.a);
        const FunctionBranches& branches = graph_.branches[node.b];
        for (unsigned i = 0; i < branches.count; ++i)
          use(graph_.blocks[branches.blocks[i]].result);
        break;
      }
      case Kind::loop:
        use(node.a);
        use(node.b);
        use(graph_.blocks[node.c].start);
        use(graph_.blocks[node.c].result);
        break;
      default:
        break;
      }
    }
  }
  std::vector<FunctionValue> arguments_of(const FunctionNode& call) const {
    std::vector<FunctionValue> arguments;
    for (FunctionValue at = call.b; at != kNoValue; at = graph_.nodes[at].b)
      arguments.push_back(graph_.nodes[at].a);
    std::reverse(arguments.begin(), arguments.end());
    return arguments;
  }

  // ---- Which operations become one step ----

  enum Inner : std::uint8_t {
    left = 1,     ///< the left operand is computed in this value's step
    right = 2,    ///< the right operand is computed in this value's step
    absorbed = 4, ///< the value is computed in another value's step
    placed = 8    ///< the value shares the register of the select that has it as a result
  };

  bool is_step(FunctionValue value) const { return uses_[value] > 0 && (inner_[value] & absorbed) == 0; }
  /// Returns whether a value of a block can be computed in the step that reads it.
  bool is_absorbable(FunctionValue value, std::uint32_t block) const {
    const FunctionNode& node = graph_.nodes[value];
    return node.kind == Kind::operation && is_fusible(node.op) && uses_[value] == 1 && inner_[value] == 0 &&
           home_[value] == block;
  }
  bool is_product(FunctionValue value) const { return graph_.nodes[value].op == FunctionOp::multiply; }

  void fuse(std::uint32_t number) {
    const FunctionBlock& block = graph_.blocks[number];
    for (const FunctionValue value : block.values) {
      const FunctionNode& node = graph_.nodes[value];
      home_[value] = number + 1; // values that are in no block keep 0
      if (node.kind == Kind::operation && is_fusible(node.op))
        fuse(value, node, number + 1);
      else if (node.kind == Kind::select)
        for (unsigned i = 0; i < graph_.branches[node.b].count; ++i)
          fuse(graph_.branches[node.b].blocks[i]);
      else if (node.kind == Kind::loop)
        fuse_loop(node);
    }
  }
  void fuse(FunctionValue value, const FunctionNode& node, std::uint32_t block) {
    if (uses_[value] == 0) return;
    const bool may_left = is_absorbable(node.a, block), may_right = is_absorbable(node.b, block);
    const bool both =
        may_left && may_right && node.op != FunctionOp::multiply && is_product(node.a) && is_product(node.b);
    if (may_left) absorb(value, node.a, left);
    if (may_right && (both || !may_left)) absorb(value, node.b, right);
  }
  void fuse_loop(const FunctionNode& loop) {
    fuse(loop.c);
    const FunctionValue result = graph_.blocks[loop.c].result;
    if (is_absorbable(result, loop.c + 1)) inner_[result] |= absorbed;
  }
  void absorb(FunctionValue value, FunctionValue operand, Inner side) {
    inner_[value] |= side;
    inner_[operand] |= absorbed;
  }

  Plan plan_of(FunctionValue value) const {
    const FunctionNode& node = graph_.nodes[value];
    if ((inner_[value] & (left | right)) == (left | right)) {
      const FunctionNode &a = graph_.nodes[node.a], &b = graph_.nodes[node.b];
      return {node.op == FunctionOp::add ? FunctionOp::sum_of_products : FunctionOp::difference_of_products,
              4,
              {a.a, a.b, b.a, b.b}};
    }
    if ((inner_[value] & left) != 0) return fused_plan(node.a, node.op, node.b, false);
    if ((inner_[value] & right) != 0) return fused_plan(node.b, node.op, node.a, true);
    return {node.op, operand_count(node.op), {node.a, node.b, node.c}};
  }
  Plan fused_plan(FunctionValue inner, FunctionOp op, FunctionValue other, bool is_right) const {
    const FunctionNode& node = graph_.nodes[inner];
    return {fused(node.op, op, is_right), 3, {node.a, node.b, other}};
  }
  /// Returns the step that combines the result of a loop's body with the loop's own value.
  Plan plan_of_sum(FunctionValue loop) const {
    const FunctionNode& node = graph_.nodes[loop];
    const FunctionValue result = graph_.blocks[node.c].result;
    if ((inner_[result] & absorbed) != 0) return fused_plan(result, node.op, loop, true);
    return {node.op, 2, {loop, result}};
  }

  // ---- How long values are needed ----

  /// A loop whose steps are being numbered.
  struct Loop {
    std::uint32_t start;
    std::vector<FunctionValue> used;
  };

  void touch(FunctionValue value) {
    const FunctionValue held = holder(value);
    last_use_[held] = position_;
    if (!loops_.empty()) loops_.back().used.push_back(held);
  }
  void touch(const Plan& plan) {
    for (unsigned i = 0; i < plan.count; ++i)
      touch(plan.operands[i]);
  }
  /// Gives each step of a block a position, in the order of emit().
  void number(const FunctionBlock& block) {
    for (const FunctionValue value : block.values) {
      if (!is_step(value)) continue;
      const FunctionNode& node = graph_.nodes[value];
      switch (node.kind) {
      case Kind::operation:
        touch(plan_of(value));
        born_[value] = position_++;
        break;
      case Kind::call:
        for (const FunctionValue argument : arguments_of(node))
          touch(argument);
        born_[value] = position_++;
        break;
      case Kind::select:
        born_[value] = position_;
        number_select(node);
        break;
      default:
        born_[value] = position_;
        number_loop(value, node);
        break;
      }
    }
  }
  void number_select(const FunctionNode& node) {
    const FunctionBranches& branches = graph_.branches[node.b];
    for (unsigned i = 0; i < branches.count; ++i) {
      if (i + 1 < branches.count) touch(node.a);
      ++position_;
      const FunctionBlock& block = graph_.blocks[branches.blocks[i]];
      number(block);
      touch(block.result);
      ++position_;
    }
  }
  void number_loop(FunctionValue value, const FunctionNode& node) {
    const FunctionBlock& block = graph_.blocks[node.c];
    touch(node.a);
    touch(block.start);
    loops_.push_back({position_, {}});
    born_[block.counter] = position_++;
    number(block);
    touch(plan_of_sum(value));
    touch(node.b);
    touch(block.counter);
    // Values that the body reads from outside of the loop are needed until the last iteration.
    Loop loop = std::move(loops_.back());
    loops_.pop_back();
    for (const FunctionValue used : loop.used)
      if (born_[used] <= loop.start) last_use_[used] = position_;
    if (!loops_.empty())
      loops_.back().used.insert(loops_.back().used.end(), loop.used.begin(), loop.used.end());
    ++position_;
  }

  // ---- Registers ----

  void place_constants() {
    program_.parameters = graph_.parameters;
    for (std::uint32_t i = 0; i < graph_.parameters; ++i)
      register_[i] = take_register();
    for (FunctionValue value = graph_.parameters; value < graph_.nodes.size(); ++value) {
      if (uses_[value] == 0 || graph_.nodes[value].kind != Kind::constant) continue;
      register_[value] = take_register();
      program_.constants.push_back(graph_.constants[graph_.nodes[value].a]);
    }
  }
  /// Sorts the values that need registers for some time by their last use.
  void find_expiries() {
    for (FunctionValue value = 0; value < graph_.nodes.size(); ++value) {
      const Kind kind = graph_.nodes[value].kind;
      if (is_step(value) && kind != Kind::parameter && kind != Kind::constant) expiries_.push_back(value);
    }
    std::stable_sort(expiries_.begin(), expiries_.end(),
                     [this](FunctionValue a, FunctionValue b) { return last_use_[a] < last_use_[b]; });
  }
  Register take_register() { return take(free_, 1); }
  Register take(std::vector<Register>& free, std::size_t count) {
    if (!free.empty()) {
      const Register taken = free.back();
      free.pop_back();
      return taken;
    }
    if (next_ + count > kMostRegisters) throw FunctionFault{"this function needs too many numbers at a time"};
    next_ += count;
    return static_cast<Register>(next_ - count);
  }
  /// Returns the register of a value; takes a new register unless the value shares that of a select.
  Register new_register(FunctionValue value) {
    if ((inner_[value] & placed) == 0) register_[value] = take_register();
    return register_[value];
  }
  Register register_of(FunctionValue value) const {
    const FunctionNode& node = graph_.nodes[value];
    if (node.kind == Kind::component) return static_cast<Register>(register_[node.a] + node.b);
    return register_[value];
  }
  /// Ends a position, and frees the registers of values whose last use was there.
  void advance() {
    for (; expired_ < expiries_.size() && last_use_[expiries_[expired_]] <= position_; ++expired_) {
      const FunctionValue value = expiries_[expired_];
      if ((inner_[value] & placed) != 0) continue; // the register belongs to the select
      (results_of(value) > 1 ? free_groups_ : free_).push_back(register_[value]);
    }
    ++position_;
  }
  std::size_t results_of(FunctionValue value) const {
    const FunctionNode& node = graph_.nodes[value];
    if (node.kind != Kind::call) return 1;
    const auto* native = std::get_if<std::shared_ptr<const NativeFunction>>(&graph_.callees[node.a]);
    return native != nullptr && (*native)->results() > 1 ? NativeFunction::kMostResults : 1;
  }

  // ---- Steps ----

  std::uint32_t here() const { return static_cast<std::uint32_t>(program_.steps.size()); }
  std::uint32_t emit_step(FunctionOp op, Register result, Register a = 0, Register b = 0) {
    program_.steps.push_back({op, result, a, b});
    return here() - 1;
  }
  void emit_copy(FunctionValue from, Register to) {
    if (register_of(from) != to) emit_step(FunctionOp::copy, to, register_of(from));
  }
  void emit_plan(const Plan& plan, Register result) {
    Register a[4] = {};
    for (unsigned i = 0; i < plan.count; ++i)
      a[i] = register_of(plan.operands[i]);
    program_.steps.push_back({plan.op, result, a[0], a[1], a[2], a[3]});
  }

  void emit(const FunctionBlock& block) {
    for (const FunctionValue value : block.values) {
      if (!is_step(value)) continue;
      const FunctionNode& node = graph_.nodes[value];
      switch (node.kind) {
      case Kind::operation: {
        const Plan plan = plan_of(value);
        advance(); // a step reads before it writes
        emit_plan(plan, new_register(value));
        break;
      }
      case Kind::call:
        emit_call(value, node);
        break;
      case Kind::select:
        emit_select(new_register(value), node);
        break;
      default:
        emit_loop(value, node);
        break;
      }
    }
  }

  void emit_call(FunctionValue value, const FunctionNode& node) {
    const auto operands = static_cast<std::uint32_t>(program_.operands.size());
    for (const FunctionValue argument : arguments_of(node))
      program_.operands.push_back(register_of(argument));
    advance();
    if (results_of(value) > 1)
      register_[value] = take(free_groups_, NativeFunction::kMostResults);
    else
      new_register(value);
    const bool is_native = graph_.callees[node.a].index() == 1;
    if (node.a > kMostRegisters) throw FunctionFault{"this function calls too many others"};
    const std::uint32_t step = emit_step(is_native ? FunctionOp::call_native : FunctionOp::call_code,
                                         register_[value], static_cast<Register>(node.a));
    program_.steps[step].set_target(operands);
  }

  /// Makes a branch compute its result directly in the select's register.
  void place_result(FunctionValue value, std::uint32_t block, Register result) {
    if (home_[value] != block + 1 || !is_step(value) || results_of(value) > 1) return;
    register_[value] = result;
    inner_[value] |= placed;
  }

  void emit_select(Register result, const FunctionNode& node) {
    const FunctionBranches& branches = graph_.branches[node.b];
    const Register chooser = register_of(node.a);
    std::uint32_t ends[2] = {};
    for (unsigned i = 0; i < branches.count; ++i) {
      const bool is_last = i + 1 == branches.count;
      const FunctionBlock& block = graph_.blocks[branches.blocks[i]];
      const FunctionOp test = i == 0 ? FunctionOp::jump_unless_negative : FunctionOp::jump_unless_zero;
      const std::uint32_t branch = is_last ? 0 : emit_step(test, 0, chooser);
      advance();
      place_result(block.result, branches.blocks[i], result);
      emit(block);
      emit_copy(block.result, result);
      advance();
      if (is_last) continue;
      ends[i] = emit_step(FunctionOp::jump, 0);
      program_.steps[branch].set_target(here());
    }
    for (unsigned i = 0; i + 1 < branches.count; ++i)
      program_.steps[ends[i]].set_target(here());
  }

  void emit_loop(FunctionValue value, const FunctionNode& node) {
    const FunctionBlock& block = graph_.blocks[node.c];
    const Register result = new_register(value), counter = new_register(block.counter);
    const Register last = register_of(node.b);
    emit_copy(node.a, counter);
    emit_copy(block.start, result);
    advance();
    const std::uint32_t exit = emit_step(FunctionOp::enter_loop, 0, counter, last), start = here();
    emit(block);
    emit_plan(plan_of_sum(value), result);
    advance();
    program_.steps[emit_step(FunctionOp::repeat, 0, counter, last)].set_target(start);
    program_.steps[exit].set_target(here());
  }

  const FunctionGraph& graph_;
  FunctionProgram program_;
  // By value:
  std::vector<std::uint32_t> uses_, home_; ///< home: 1 + number of the value's block
  std::vector<std::uint8_t> inner_;        ///< bits of Inner
  std::vector<std::uint32_t> born_, last_use_;
  std::vector<Register> register_;

  std::vector<FunctionValue> waiting_;
  std::vector<Loop> loops_;
  std::vector<FunctionValue> expiries_;
  std::vector<Register> free_, free_groups_;
  std::size_t expired_ = 0, next_ = 0;
  std::uint32_t position_ = 0;
};

} // namespace

FunctionProgram compile(const FunctionGraph& graph) {
  return Compiler(graph).compile();
}

} // namespace celltrace
