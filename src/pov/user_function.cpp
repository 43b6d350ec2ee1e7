// What functions of the scene come to.
#include "pov/user_function.hpp"

#include <cmath>

#include "pov/functions.hpp"
#include "pov/session.hpp"

namespace celltrace::pov {

namespace {

/// Of one evaluation.
constexpr std::uint64_t kMostSteps = 1'000'000'000;

class Machine {
public:
  explicit Machine(Session& session) : session_(session) {}

  Quantity value(const UserFunction& function, const double* arguments, const Location& where);

private:
  double run(const FunctionProgram& program, std::size_t parameters, const double* arguments);
  double take() {
    const double value = stack_.back();
    stack_.pop_back();
    return value;
  }
  void call_builtin(const FunctionStep& step);
  void call(const FunctionProgram& program, const FunctionStep& step);

  Session& session_;
  std::vector<double> stack_;
  std::uint64_t steps_ = 0;
};

Quantity Machine::value(const UserFunction& function, const double* arguments, const Location& where) {
  if (const auto* program = std::get_if<FunctionProgram>(&function.body))
    return run(*program, function.parameters, arguments);
  if (const auto* internal = std::get_if<InternalFunction>(&function.body))
    return internal_value(session_, internal->number, arguments, where);
  if (const auto* spline = std::get_if<SplinePtr>(&function.body)) return (*spline)->value(arguments[0]);
  if (const auto* transform = std::get_if<Transform>(&function.body))
    return Quantity::vector(transform->point({arguments[0], arguments[1], arguments[2]}));
  session_.fail(where, std::get<UnsupportedPtr>(function.body)->what + " is not supported yet");
}

void Machine::call_builtin(const FunctionStep& step) {
  const std::size_t first = stack_.size() - step.b;
  const std::vector<Value> arguments(stack_.begin() + static_cast<std::ptrdiff_t>(first), stack_.end());
  stack_.resize(first);
  for (std::size_t i = 0; i < arguments.size(); ++i)
    session_.number(std::get<Quantity>(arguments[i]), step.where);
  stack_.push_back(call_numeric(session_, static_cast<int>(step.a), arguments, step.where).v[0]);
}

void Machine::call(const FunctionProgram& program, const FunctionStep& step) {
  const std::vector<double> arguments(stack_.end() - step.c, stack_.end());
  stack_.resize(stack_.size() - step.c);
  const Quantity result = value(*program.callees[step.a], arguments.data(), step.where);
  stack_.push_back(step.b == kGreyComponent ? result.grey() : result.v[step.b]);
}

double Machine::run(const FunctionProgram& program, std::size_t parameters, const double* arguments) {
  std::vector<double> variables(arguments, arguments + parameters);
  variables.resize(program.variables);
  using Kind = FunctionStep::Kind;
  for (std::size_t at = 0; at < program.steps.size(); ++at) {
    const FunctionStep& step = program.steps[at];
    if (++steps_ > kMostSteps) session_.fail(step.where, "this function takes too long");
    switch (step.kind) {
    case Kind::constant:
      stack_.push_back(step.value);
      break;
    case Kind::load:
      stack_.push_back(variables[step.a]);
      break;
    case Kind::store:
      variables[step.a] = take();
      break;
    case Kind::negate:
      stack_.back() = -stack_.back();
      break;
    case Kind::invert:
      stack_.back() = stack_.back() == 0 ? 1 : 0;
      break;
    case Kind::builtin:
      call_builtin(step);
      break;
    case Kind::call:
      call(program, step);
      break;
    case Kind::choose: {
      const double chooser = take();
      at = (chooser < 0 ? step.a : chooser == 0 ? step.b : step.c) - 1;
      break;
    }
    case Kind::jump:
      at = step.a - 1;
      break;
    default: {
      const double right = take(), left = take();
      switch (step.kind) {
      case Kind::add:
        stack_.push_back(left + right);
        break;
      case Kind::subtract:
        stack_.push_back(left - right);
        break;
      case Kind::multiply:
        stack_.push_back(left * right);
        break;
      case Kind::divide:
        stack_.push_back(left / right);
        break;
      case Kind::compare:
        stack_.push_back(compare(Relation(step.a), left, right).v[0]);
        break;
      case Kind::both:
        stack_.push_back(left != 0 && right != 0 ? 1 : 0);
        break;
      case Kind::either:
        stack_.push_back(left != 0 || right != 0 ? 1 : 0);
        break;
      default: // jump_past
        if (left > right) at = step.a - 1;
        break;
      }
      break;
    }
    }
  }
  return take();
}

} // namespace

Quantity call_function(Session& session, const UserFunction& function, const std::vector<double>& arguments,
                       const Location& where) {
  if (arguments.size() != function.parameters)
    session.fail(where, "this function takes " + std::to_string(function.parameters) +
                            (function.parameters == 1 ? " argument" : " arguments") + ", not " +
                            std::to_string(arguments.size()));
  return Machine(session).value(function, arguments.data(), where);
}

} // namespace celltrace::pov
