// Graphs of functions of numbers. Each value in a graph is computed once. The parser builds graphs, functions
// inline the graphs of other functions, and programs are compiled from graphs.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "geometry/function_program.hpp"

namespace celltrace {

using FunctionValue = std::uint32_t; ///< index of a node

/// The node of a value. Fields that a kind of value does not use are 0.
struct FunctionNode {
  enum class Kind : std::uint16_t {
    parameter, ///< parameter of number a
    constant,  ///< constants[a]
    counter,   ///< counter of the loop whose body the value is in
    operation, ///< op applied to the values a, b and c
    argument,  ///< the value a as the last argument of a call; b is the argument before it, or kNoValue
    call,      ///< call of callees[a]; b is the last argument
    component, ///< number b of the results of call a
    select,    ///< the result of one of branches[b], chosen by the value a
    loop       ///< op over all results of block c, while its counter goes from a to b
  };
  Kind kind = Kind::constant;
  FunctionOp op = FunctionOp::add;
  std::uint32_t a = 0, b = 0, c = 0;

  bool operator==(const FunctionNode&) const = default;
};
inline constexpr FunctionValue kNoValue = ~FunctionValue{0};

/// Values that are computed together: the values of the function itself, of a branch of a select, or of a
/// loop's body. A block reads its own values and the values of enclosing blocks.
struct FunctionBlock {
  std::vector<FunctionValue> values; ///< values in the order in which they are computed
  FunctionValue result = 0;
  FunctionValue counter = kNoValue; ///< loops only
  FunctionValue start = kNoValue;   ///< loops only: the constant that the result begins with
};

/// The blocks of a select. The first block is chosen for a number below 0. If there are two blocks, the
/// second is chosen otherwise; if there are three, the second is chosen for 0 and the third for greater
/// numbers and NaN.
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
  std::uint32_t body = 0; ///< index of the function's own block
  std::vector<FunctionCallee> callees;

  std::size_t bytes() const;
};

/// Builds a graph, value by value. Equal values become one value, operations on constants are folded, a
/// loop's body keeps only values that its counter changes, and calls of functions are replaced by the
/// functions' graphs as long as these and the result are small.
class FunctionBuilder {
public:
  explicit FunctionBuilder(std::uint32_t parameters);

  FunctionValue parameter(std::uint32_t number) const { return number; }
  FunctionValue constant(double number);
  FunctionValue apply(FunctionOp op, FunctionValue a, FunctionValue b = 0, FunctionValue c = 0);
  /// Returns the value of a call; if it has several results, component() returns one of them.
  FunctionValue call(const FunctionCallee& callee, std::span<const FunctionValue> arguments);
  FunctionValue component(FunctionValue call, std::uint32_t which);

  /// Begins a branch: values belong to it until close().
  void open_branch() { open(false); }
  /// Begins the body of a loop: values belong to it until close(). Returns the loop's counter.
  FunctionValue open_loop();
  /// Ends the current block and returns its number.
  std::uint32_t close(FunctionValue result);
  FunctionValue select(FunctionValue chooser, const FunctionBranches& branches);
  /// Returns the sum or product (`op`) of the results of a loop's block.
  FunctionValue loop(FunctionOp op, FunctionValue first, FunctionValue last, std::uint32_t block);

  /// Returns whether there are more values than a program may have.
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
    std::vector<FunctionNode> added; ///< nodes that this block has added to table_
  };
  class Inliner;

  void open(bool is_loop);
  std::size_t level() const { return open_.size() - 1; }
  FunctionValue add(const FunctionNode& node, std::size_t level);
  /// Returns an equal value or, if there is none, adds the value outside of all loops in which it does not
  /// change.
  FunctionValue find_or_add(const FunctionNode& node, std::size_t level);
  std::size_t outermost_level(std::size_t least) const;
  std::size_t level_of_arguments(FunctionValue last) const;
  bool is_constant(FunctionValue value) const {
    return graph_.nodes[value].kind == FunctionNode::Kind::constant;
  }
  double number(FunctionValue value) const { return graph_.constants[graph_.nodes[value].a]; }
  bool is_cheap(const FunctionBlock& block) const;
  /// Moves the values of a closed block to the current block. Returns the closed block's result.
  FunctionValue unfold(std::uint32_t block);
  std::uint32_t callee_number(const FunctionCallee& callee);

  FunctionGraph graph_;
  std::vector<OpenBlock> open_;
  std::vector<std::uint16_t> levels_; ///< number of blocks around a node's own block; index: node
  std::unordered_map<FunctionNode, FunctionValue, Hash> table_;
};

/// Returns the program that computes a graph's result. Throws FunctionFault if the program needs too many
/// registers.
FunctionProgram compile(const FunctionGraph& graph);

} // namespace celltrace
