// Functions of numbers as graphs of values, each of which is computed once: what a function's text is read
// into, what is inlined into functions that call it, and what programs are made of.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "geometry/function_program.hpp"

namespace celltrace {

using FunctionValue = std::uint32_t; ///< the number of a node

/// A value. Fields that a kind does not name are 0.
struct FunctionNode {
  enum class Kind : std::uint16_t {
    parameter, ///< number a
    constant,  ///< constants[a]
    counter,   ///< of the loop whose body it is in
    operation, ///< op of the values a, b and c
    argument,  ///< the value a as the last argument of a call, behind b: the argument before, or kNoValue
    call,      ///< of callees[a], b being the last argument
    component, ///< number b of what call a gives
    select,    ///< the result of one of branches[b], as the value a says
    loop       ///< op of all results of block c, while its counter goes from a to b
  };
  Kind kind = Kind::constant;
  FunctionOp op = FunctionOp::add;
  std::uint32_t a = 0, b = 0, c = 0;

  bool operator==(const FunctionNode&) const = default;
};
inline constexpr FunctionValue kNoValue = ~FunctionValue{0};

/// Values that are computed together: the function's own, a branch's of a select, or the body's of a loop. A
/// block reads values of its own and of those around it.
struct FunctionBlock {
  std::vector<FunctionValue> values; ///< in the order in which they are computed
  FunctionValue result = 0;
  FunctionValue counter = kNoValue; ///< of a loop
  FunctionValue start = kNoValue;   ///< of a loop: the constant that its result begins with
};

/// Blocks of a select: the first one if its chooser is below 0, else the second one; where there are three,
/// the second one only if it is 0, and else the third one.
struct FunctionBranches {
  std::uint32_t count = 0;
  std::uint32_t blocks[3] = {};

  std::uint32_t chosen(double chooser) const {
    return blocks[chooser < 0 ? 0 : chooser == 0 ? 1 : count - 1];
  }
};

struct FunctionGraph {
  std::uint32_t parameters = 0;
  std::vector<FunctionNode> nodes;
  std::vector<double> constants;
  std::vector<FunctionBlock> blocks;
  std::vector<FunctionBranches> branches;
  std::uint32_t body = 0; ///< the function's own block
  std::vector<FunctionCallee> callees;

  std::size_t bytes() const;
};

/// Makes a graph, value by value. Equal values are one; operations of constants are folded; a loop's body
/// keeps only what its counter changes; calls of functions are replaced by their graphs as long as these and
/// the result stay small.
class FunctionBuilder {
public:
  explicit FunctionBuilder(std::uint32_t parameters);

  FunctionValue parameter(std::uint32_t number) const { return number; }
  FunctionValue constant(double number);
  FunctionValue apply(FunctionOp op, FunctionValue a, FunctionValue b = 0, FunctionValue c = 0);
  /// A call's value; of one with several results, component() gives one.
  FunctionValue call(const FunctionCallee& callee, std::span<const FunctionValue> arguments);
  FunctionValue component(FunctionValue call, std::uint32_t which);

  /// From here on values belong to a branch, until close().
  void open_branch() { open(false); }
  /// From here on values belong to the body of a loop, whose counter is returned, until close().
  FunctionValue open_loop();
  /// The number of the block that ends here.
  std::uint32_t close(FunctionValue result);
  FunctionValue select(FunctionValue chooser, const FunctionBranches& branches);
  /// The sum or product (`op`) of a loop's block.
  FunctionValue loop(FunctionOp op, FunctionValue first, FunctionValue last, std::uint32_t block);

  /// Whether there are more values than a program may have.
  bool is_too_large() const { return graph_.nodes.size() > kMostValues; }
  FunctionGraph finish(FunctionValue result);

private:
  static constexpr std::size_t kMostValues = 1'000'000;

  struct Hash {
    std::size_t operator()(const FunctionNode& node) const;
  };
  struct OpenBlock {
    FunctionBlock block;
    bool is_loop = false;
    std::vector<FunctionNode> added; ///< to the table
  };
  class Inliner;

  void open(bool is_loop);
  std::size_t level() const { return open_.size() - 1; }
  FunctionValue add(const FunctionNode& node, std::size_t level);
  /// Gives the value that there is already, or adds it, in the outermost loop's surroundings where it does
  /// not change.
  FunctionValue find_or_add(const FunctionNode& node, std::size_t level);
  std::size_t outermost_level(std::size_t least) const;
  std::size_t level_of_arguments(FunctionValue last) const;
  bool is_constant(FunctionValue value) const {
    return graph_.nodes[value].kind == FunctionNode::Kind::constant;
  }
  double number(FunctionValue value) const { return graph_.constants[graph_.nodes[value].a]; }
  bool is_cheap(const FunctionBlock& block) const;
  /// Moves a closed block's values to where values are added now.
  FunctionValue unfold(std::uint32_t block);
  std::uint32_t callee_number(const FunctionCallee& callee);

  FunctionGraph graph_;
  std::vector<OpenBlock> open_;
  std::vector<std::uint16_t> levels_; ///< by node: how many blocks are around the one it belongs to
  std::unordered_map<FunctionNode, FunctionValue, Hash> table_;
};

/// The program that computes a graph's result. Throws FunctionFault if it needs too many registers.
FunctionProgram compile(const FunctionGraph& graph);

} // namespace celltrace
