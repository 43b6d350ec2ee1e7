#include "geometry/function_graph.hpp"

#include <algorithm>
#include <bit>

#include "geometry/function_machine.hpp"
#include "geometry/function_operations.hpp"

namespace celltrace {

namespace {

using Kind = FunctionNode::Kind;

/// Functions of more values are called instead of inlined; a function of more values than the second limit
/// calls all functions.
constexpr std::size_t kMostInlinedValues = 128;
constexpr std::size_t kMostValuesWithInlined = 2048;
/// Limit on values of a branch that takes less time than a mispredicted jump.
constexpr std::size_t kMostCheapValues = 3;

bool is_cheap(FunctionOp op) {
  switch (op) {
  case FunctionOp::negate:
  case FunctionOp::invert:
  case FunctionOp::absolute:
  case FunctionOp::add:
  case FunctionOp::subtract:
  case FunctionOp::multiply:
  case FunctionOp::less:
  case FunctionOp::less_equal:
  case FunctionOp::equal:
  case FunctionOp::not_equal:
  case FunctionOp::greater_equal:
  case FunctionOp::greater:
  case FunctionOp::both:
  case FunctionOp::either:
  case FunctionOp::maximum:
  case FunctionOp::minimum:
  case FunctionOp::pick_negative:
  case FunctionOp::pick_zero:
    return true;
  default:
    return false;
  }
}

} // namespace

std::size_t FunctionGraph::bytes() const {
  std::size_t values = 0;
  for (const FunctionBlock& block : blocks)
    values += block.values.size();
  return sizeof *this + nodes.size() * sizeof(FunctionNode) + constants.size() * sizeof(double) +
         values * sizeof(FunctionValue) + branches.size() * sizeof(FunctionBranches) +
         blocks.size() * sizeof(FunctionBlock) + callees.size() * sizeof(FunctionCallee);
}

std::size_t FunctionBuilder::Hash::operator()(const FunctionNode& node) const {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15u;
  std::uint64_t hash = static_cast<std::uint64_t>(node.kind) << 16 | static_cast<std::uint64_t>(node.op);
  for (const std::uint32_t field : {node.a, node.b, node.c})
    hash = std::rotl(hash * kOdd, 29) ^ field;
  hash *= kOdd;
  return static_cast<std::size_t>(hash ^ hash >> 32);
}

FunctionBuilder::FunctionBuilder(std::uint32_t parameters) {
  graph_.parameters = parameters;
  open_.emplace_back();
  for (std::uint32_t i = 0; i < parameters; ++i) {
    graph_.nodes.push_back({Kind::parameter, FunctionOp::add, i});
    levels_.push_back(0);
  }
}

FunctionValue FunctionBuilder::constant(double number) {
  // Constants are equal if they have the same bits: 0 and -0 differ.
  const auto bits = std::bit_cast<std::uint64_t>(number);
  const FunctionNode key{Kind::constant, FunctionOp::add, static_cast<std::uint32_t>(bits),
                         static_cast<std::uint32_t>(bits >> 32), 1};
  const auto found = table_.find(key);
  if (found != table_.end()) return found->second;
  graph_.constants.push_back(number);
  const FunctionValue value =
      add({Kind::constant, FunctionOp::add, static_cast<std::uint32_t>(graph_.constants.size() - 1)}, 0);
  table_.emplace(key, value);
  return value;
}

FunctionValue FunctionBuilder::add(const FunctionNode& node, std::size_t level) {
  const auto value = static_cast<FunctionValue>(graph_.nodes.size());
  graph_.nodes.push_back(node);
  levels_.push_back(static_cast<std::uint16_t>(level));
  switch (node.kind) {
  case Kind::operation:
  case Kind::call:
  case Kind::select:
  case Kind::loop:
    open_[level].block.values.push_back(value);
    break;
  default: // other kinds take no step
    break;
  }
  return value;
}

FunctionValue FunctionBuilder::find_or_add(const FunctionNode& node, std::size_t level) {
  const auto found = table_.find(node);
  if (found != table_.end()) return found->second;
  const FunctionValue value = add(node, level);
  table_.emplace(node, value);
  open_[level].added.push_back(node);
  return value;
}

/// Returns the level of the block for a value whose operands have at most level `least`: outside of all loops
/// in which the value does not change.
std::size_t FunctionBuilder::outermost_level(std::size_t least) const {
  std::size_t result = level();
  while (open_[result].is_loop && least < result)
    --result;
  return result;
}

FunctionValue FunctionBuilder::apply(FunctionOp op, FunctionValue a, FunctionValue b, FunctionValue c) {
  const FunctionValue operands[] = {a, b, c};
  const std::span<const FunctionValue> used(operands, operand_count(op));
  if (std::all_of(used.begin(), used.end(), [this](FunctionValue value) { return is_constant(value); })) {
    double numbers[3] = {};
    std::transform(used.begin(), used.end(), numbers, [this](FunctionValue v) { return number(v); });
    return constant(result_of(op, numbers[0], numbers[1], numbers[2]));
  }
  std::size_t least = 0;
  for (const FunctionValue value : used)
    least = std::max<std::size_t>(least, levels_[value]);
  return find_or_add({Kind::operation, op, a, b, c}, outermost_level(least));
}

std::uint32_t FunctionBuilder::callee_number(const FunctionCallee& callee) {
  const auto found = std::find(graph_.callees.begin(), graph_.callees.end(), callee);
  const auto number = static_cast<std::uint32_t>(found - graph_.callees.begin());
  if (found == graph_.callees.end()) graph_.callees.push_back(callee);
  return number;
}

FunctionValue FunctionBuilder::component(FunctionValue call, std::uint32_t which) {
  return find_or_add({Kind::component, FunctionOp::add, call, which}, levels_[call]);
}

void FunctionBuilder::open(bool is_loop) {
  open_.emplace_back();
  open_.back().is_loop = is_loop;
}

FunctionValue FunctionBuilder::open_loop() {
  open(true);
  return open_.back().block.counter = add({Kind::counter}, level());
}

std::uint32_t FunctionBuilder::close(FunctionValue result) {
  OpenBlock closed = std::move(open_.back());
  open_.pop_back();
  for (const FunctionNode& node : closed.added)
    table_.erase(node);
  closed.block.result = result;
  graph_.blocks.push_back(std::move(closed.block));
  return static_cast<std::uint32_t>(graph_.blocks.size() - 1);
}

bool FunctionBuilder::is_cheap(const FunctionBlock& block) const {
  return block.values.size() <= kMostCheapValues &&
         std::all_of(block.values.begin(), block.values.end(), [this](FunctionValue value) {
           const FunctionNode& node = graph_.nodes[value];
           return node.kind == Kind::operation && celltrace::is_cheap(node.op);
         });
}

FunctionValue FunctionBuilder::unfold(std::uint32_t number) {
  FunctionBlock& block = graph_.blocks[number];
  OpenBlock& around = open_.back();
  for (const FunctionValue value : block.values) {
    levels_[value] = static_cast<std::uint16_t>(level());
    around.block.values.push_back(value);
    if (table_.emplace(graph_.nodes[value], value).second) around.added.push_back(graph_.nodes[value]);
  }
  block.values.clear();
  return block.result;
}

FunctionValue FunctionBuilder::select(FunctionValue chooser, const FunctionBranches& branches) {
  if (is_constant(chooser)) return unfold(branches.chosen(number(chooser)));
  const std::span<const std::uint32_t> blocks(branches.blocks, branches.count);
  if (!std::all_of(blocks.begin(), blocks.end(),
                   [this](auto block) { return is_cheap(graph_.blocks[block]); })) {
    graph_.branches.push_back(branches);
    const auto last = static_cast<std::uint32_t>(graph_.branches.size() - 1);
    return add({Kind::select, FunctionOp::add, chooser, last}, level());
  }
  FunctionValue results[3] = {};
  std::transform(blocks.begin(), blocks.end(), results,
                 [this](std::uint32_t block) { return unfold(block); });
  const FunctionValue rest =
      branches.count == 3 ? apply(FunctionOp::pick_zero, chooser, results[1], results[2]) : results[1];
  return apply(FunctionOp::pick_negative, chooser, results[0], rest);
}

FunctionValue FunctionBuilder::loop(FunctionOp op, FunctionValue first, FunctionValue last,
                                    std::uint32_t block) {
  graph_.blocks[block].start = constant(op == FunctionOp::add ? 0 : 1);
  return add({Kind::loop, op, first, last, block}, level());
}

FunctionGraph FunctionBuilder::finish(FunctionValue result) {
  graph_.body = close(result);
  return std::move(graph_);
}

/// Adds the graph of a function to the builder's graph.
class FunctionBuilder::Inliner {
public:
  Inliner(FunctionBuilder& builder, const FunctionGraph& graph, std::span<const FunctionValue> arguments)
      : builder_(builder), graph_(graph), copies_(graph.nodes.size(), kNoValue) {
    std::copy(arguments.begin(), arguments.end(), copies_.begin());
  }

  FunctionValue copy(const FunctionBlock& block) {
    for (const FunctionValue value : block.values)
      copies_[value] = copy(graph_.nodes[value]);
    return copy_of(block.result);
  }

private:
  FunctionValue copy_of(FunctionValue value) {
    FunctionValue& copy = copies_[value];
    if (copy != kNoValue) return copy;
    const FunctionNode& node = graph_.nodes[value];
    return copy = node.kind == Kind::constant ? builder_.constant(graph_.constants[node.a])
                                              : builder_.component(copy_of(node.a), node.b);
  }

  FunctionValue copy(const FunctionNode& node) {
    switch (node.kind) {
    case Kind::operation: {
      const unsigned count = operand_count(node.op);
      return builder_.apply(node.op, copy_of(node.a), count > 1 ? copy_of(node.b) : 0,
                            count > 2 ? copy_of(node.c) : 0);
    }
    case Kind::call: {
      std::vector<FunctionValue> arguments;
      for (FunctionValue at = node.b; at != kNoValue; at = graph_.nodes[at].b)
        arguments.push_back(copy_of(graph_.nodes[at].a));
      std::reverse(arguments.begin(), arguments.end());
      return builder_.call(graph_.callees[node.a], arguments);
    }
    case Kind::select:
      return copy_select(node);
    default: // loop
      return copy_loop(node);
    }
  }

  FunctionValue copy_select(const FunctionNode& node) {
    const FunctionValue chooser = copy_of(node.a);
    const FunctionBranches& branches = graph_.branches[node.b];
    if (builder_.is_constant(chooser)) return copy(graph_.blocks[branches.chosen(builder_.number(chooser))]);
    FunctionBranches copied;
    while (copied.count < branches.count) {
      builder_.open_branch();
      const FunctionValue result = copy(graph_.blocks[branches.blocks[copied.count]]);
      copied.blocks[copied.count++] = builder_.close(result);
    }
    return builder_.select(chooser, copied);
  }

  FunctionValue copy_loop(const FunctionNode& node) {
    const FunctionBlock& block = graph_.blocks[node.c];
    const FunctionValue first = copy_of(node.a), last = copy_of(node.b);
    copies_[block.counter] = builder_.open_loop();
    const std::uint32_t body = builder_.close(copy(block));
    return builder_.loop(node.op, first, last, body);
  }

  FunctionBuilder& builder_;
  const FunctionGraph& graph_;
  std::vector<FunctionValue> copies_; ///< index: value of the function's graph
};

FunctionValue FunctionBuilder::call(const FunctionCallee& callee, std::span<const FunctionValue> arguments) {
  FunctionNode node{Kind::call, FunctionOp::add, callee_number(callee), kNoValue};
  std::size_t least = 0;
  for (const FunctionValue argument : arguments) {
    least = std::max<std::size_t>(least, levels_[argument]);
    node.b = find_or_add({Kind::argument, FunctionOp::add, argument, node.b}, least);
  }
  const auto known = table_.find(node);
  if (known != table_.end()) return known->second;
  const auto* const code = std::get_if<std::shared_ptr<const FunctionCode>>(&callee);
  if (code != nullptr) {
    const FunctionGraph& graph = (*code)->graph();
    if (graph.nodes.size() <= kMostInlinedValues &&
        graph_.nodes.size() + graph.nodes.size() <= kMostValuesWithInlined) {
      const FunctionValue result = Inliner(*this, graph, arguments).copy(graph.blocks[graph.body]);
      table_.emplace(node, result);
      open_.back().added.push_back(node);
      return result;
    }
  }
  return find_or_add(node, outermost_level(least));
}

} // namespace celltrace
