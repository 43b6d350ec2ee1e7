#include "scene_image/function_code.hpp"

#include "celltrace/error.hpp"
#include "geometry/function_graph.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

namespace celltrace {

using namespace kernel;

namespace {

constexpr std::size_t kMostSteps = 4096;
constexpr std::size_t kMostNodes = 8192;
constexpr int kDeepestCall = 32;

[[noreturn]] void fail(const std::string& what) {
  throw InputError("a function in a texture or shape " + what);
}

/// A step whose registers are numbers of values, each written once.
struct ValueStep {
  FunctionOperation operation;
  std::uint32_t result, a = 0, b = 0, c = 0;
  float constant = 0;
};

FunctionOperation operation_of(FunctionOp op) {
  switch (op) {
#define CELLTRACE_CASE(name)                                                                                 \
  case FunctionOp::name:                                                                                     \
    return FunctionOperation::name;
    CELLTRACE_UNARY_OPERATIONS(CELLTRACE_CASE)
    CELLTRACE_BINARY_OPERATIONS(CELLTRACE_CASE)
    CELLTRACE_TERNARY_OPERATIONS(CELLTRACE_CASE)
#undef CELLTRACE_CASE
  default:
    fail("has an operation that is only for programs");
  }
}

/// Writes the values that a graph's result needs, each after those that it is computed from: branches one after
/// another, as all lanes compute all of them, and loops as often as they run. The order follows from the graph's
/// structure alone, as nodes may be numbered in any order.
class Writer {
public:
  std::vector<ValueStep> steps;
  std::uint32_t values = 3; ///< the first three are the point

  std::uint32_t write(const FunctionGraph& graph, const std::vector<std::uint32_t>& arguments, int depth) {
    if (depth > kDeepestCall) fail("nests too deeply");
    if (graph.parameters != arguments.size()) fail("takes other arguments than x, y and z");
    if (graph.nodes.size() > kMostNodes) fail("is too long"); // the walk recurses
    Frame frame{graph, arguments, std::vector<std::uint32_t>(graph.nodes.size(), kNone), depth};
    return write(frame, graph.blocks[graph.body]);
  }

private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  struct Frame {
    const FunctionGraph& graph;
    const std::vector<std::uint32_t>& arguments;
    std::vector<std::uint32_t> value_of; ///< index: node; the number of its value
    int depth;
  };

  std::uint32_t add(ValueStep step) {
    if (steps.size() == kMostSteps) fail("is too long");
    step.result = values++;
    steps.push_back(step);
    return step.result;
  }
  std::uint32_t constant(double number) {
    return add({FunctionOperation::constant, 0, 0, 0, 0, static_cast<float>(number)});
  }

  std::uint32_t value(Frame& frame, FunctionValue node) {
    if (frame.value_of[node] == kNone) frame.value_of[node] = compute(frame, node);
    return frame.value_of[node];
  }
  std::uint32_t write(Frame& frame, const FunctionBlock& block) {
    // A loop computes its body's values anew each time.
    for (const FunctionValue node : block.values)
      if (frame.graph.nodes[node].kind != FunctionNode::Kind::counter) frame.value_of[node] = kNone;
    return value(frame, block.result);
  }

  std::uint32_t compute(Frame& frame, FunctionValue node) {
    const FunctionNode& n = frame.graph.nodes[node];
    using Kind = FunctionNode::Kind;
    switch (n.kind) {
    case Kind::parameter:
      return frame.arguments[n.a];
    case Kind::constant:
      return constant(frame.graph.constants[n.a]);
    case Kind::operation: {
      const unsigned operands = operand_count_of(n.op);
      ValueStep step{operation_of(n.op), 0};
      step.a = value(frame, n.a);
      if (operands > 1) step.b = value(frame, n.b);
      if (operands > 2) step.c = value(frame, n.c);
      return add(step);
    }
    case Kind::select:
      return select(frame, n);
    case Kind::loop:
      return loop(frame, n);
    case Kind::call:
      return call(frame, n);
    default:
      fail("has a value that is not supported yet");
    }
  }
  static unsigned operand_count_of(FunctionOp op) {
    if (op < FunctionOp::add) return 1;
    return op < FunctionOp::pick_negative ? 2 : 3;
  }

  std::uint32_t select(Frame& frame, const FunctionNode& n) {
    const FunctionBranches& branches = frame.graph.branches[n.b];
    const std::uint32_t chooser = value(frame, n.a);
    std::uint32_t results[3] = {};
    for (std::uint32_t i = 0; i < branches.count; ++i)
      results[i] = write(frame, frame.graph.blocks[branches.blocks[i]]);
    std::uint32_t rest = results[branches.count - 1];
    if (branches.count == 3) rest = add({FunctionOperation::pick_zero, 0, chooser, results[1], rest});
    return add({FunctionOperation::pick_negative, 0, chooser, results[0], rest});
  }

  std::uint32_t loop(Frame& frame, const FunctionNode& n) {
    const FunctionGraph& graph = frame.graph;
    const auto is_constant = [&](FunctionValue v) { return graph.nodes[v].kind == FunctionNode::Kind::constant; };
    if (!is_constant(n.a) || !is_constant(n.b)) fail("has a loop whose bounds depend on the point, which is not supported yet");
    const FunctionBlock& body = graph.blocks[n.c];
    std::uint32_t sum = value(frame, body.start);
    const double last = graph.constants[graph.nodes[n.b].a];
    for (double i = graph.constants[graph.nodes[n.a].a]; i <= last; ++i) {
      frame.value_of[body.counter] = constant(i);
      const std::uint32_t result = write(frame, body);
      sum = add({operation_of(n.op), 0, sum, result});
    }
    return sum;
  }

  std::uint32_t call(Frame& frame, const FunctionNode& n) {
    const auto* const code = std::get_if<std::shared_ptr<const FunctionCode>>(&frame.graph.callees[n.a]);
    if (code == nullptr)
      fail("calls a function of POV-Ray's own, a pigment, a pattern or a spline, which is not supported yet");
    std::vector<std::uint32_t> arguments;
    for (FunctionValue at = n.b; at != kNoValue; at = frame.graph.nodes[at].b)
      arguments.push_back(value(frame, frame.graph.nodes[at].a));
    std::reverse(arguments.begin(), arguments.end());
    return write((*code)->graph(), arguments, frame.depth + 1);
  }
};

/// Gives values registers, which are used again after a value's last use.
std::vector<FunctionStepRecord> with_registers(const std::vector<ValueStep>& steps, std::uint32_t values) {
  std::vector<std::size_t> last_use(values, 0);
  const auto uses = [](const ValueStep& step, const auto& visit) {
    if (step.operation == FunctionOperation::constant) return;
    visit(step.a);
    if (step.operation >= FunctionOperation::add) visit(step.b);
    if (step.operation >= FunctionOperation::pick_negative) visit(step.c);
  };
  for (std::size_t i = 0; i < steps.size(); ++i)
    uses(steps[i], [&](std::uint32_t value) { last_use[value] = i; });
  std::vector<std::uint32_t> free;
  for (std::uint32_t r = kFunctionRegisters; r-- > 3;)
    free.push_back(r);
  std::vector<std::uint32_t> register_of(values, 0);
  for (std::uint32_t i = 0; i < 3; ++i)
    register_of[i] = i;
  std::vector<FunctionStepRecord> code;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const ValueStep& step = steps[i];
    const std::uint32_t a = register_of[step.a], b = register_of[step.b], c = register_of[step.c];
    std::vector<std::uint32_t> ended;
    uses(step, [&](std::uint32_t value) {
      if (last_use[value] == i && std::find(ended.begin(), ended.end(), value) == ended.end()) ended.push_back(value);
    });
    for (const std::uint32_t value : ended)
      if (value >= 3) free.push_back(register_of[value]);
    if (free.empty()) fail("has too many values at a time");
    const std::uint32_t result = free.back();
    free.pop_back();
    register_of[step.result] = result;
    // A value that nothing reads gives its register back at once, but for the last one.
    if (last_use[step.result] == 0 && i + 1 < steps.size()) free.push_back(result);
    code.push_back({static_cast<std::uint32_t>(step.operation) | result << 16, a | b << 16, c, step.constant});
  }
  return code;
}

} // namespace

std::vector<FunctionStepRecord> function_code(const FunctionCode& function) {
  Writer writer;
  const std::uint32_t result = writer.write(function.graph(), {0, 1, 2}, 0);
  // The last step has the result.
  if (writer.steps.empty() || writer.steps.back().result != result)
    writer.steps.push_back({FunctionOperation::maximum, writer.values++, result, result});
  return with_registers(writer.steps, writer.values);
}

} // namespace celltrace
