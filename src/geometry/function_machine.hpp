// The machine that runs programs of functions, and the state that it keeps for each function.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/function_graph.hpp"
#include "geometry/function_program.hpp"

namespace celltrace {

/// A function that other functions can inline or call, and that a machine can run. Its program is compiled
/// when it is first run. Belongs to one thread.
class FunctionCode {
public:
  explicit FunctionCode(FunctionGraph graph);
  ~FunctionCode();

  const FunctionGraph& graph() const { return graph_; }
  std::size_t parameters() const { return graph_.parameters; }

private:
  friend class FunctionMachine;
  /// The function's program, registers and memo.
  struct State;
  State& state() const;

  FunctionGraph graph_;
  mutable std::unique_ptr<State> state_;
};

/// Runs one program at a time, without recursion: functions call only functions that were declared before
/// them, so that each function needs one set of registers. Remembers the results of functions that are
/// called, for recent arguments.
class FunctionMachine {
public:
  FunctionMachine();
  ~FunctionMachine();

  /// Returns the function's value. Throws FunctionFault.
  double run(const FunctionCode& function, const double* arguments, const FunctionContext& context);

private:
  struct Return;
  class Memo;
  friend class FunctionCode;

  double run(FunctionCode::State& function);

  FunctionContext context_;
  std::uint64_t epoch_ = 0; ///< counts changes of the context
  std::uint64_t memo_bytes_ = 0;
  std::vector<Return> returns_;
};

} // namespace celltrace
