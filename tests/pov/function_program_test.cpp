// Programs of functions give, bit for bit, what their expressions give when these are evaluated as written.
#include "geometry/function_graph.hpp"
#include "geometry/function_machine.hpp"
#include "geometry/function_operations.hpp"

#include <catch2/catch.hpp>

#include <bit>
#include <limits>
#include <memory>
#include <random>
#include <vector>

using namespace celltrace;

namespace {

/// A native function with five results.
class Powers final : public NativeFunction {
public:
  Powers() : NativeFunction(2, 5) {}
  void evaluate(const double* arguments, const FunctionContext& context, double* results) const override {
    results[0] = arguments[0];
    results[1] = arguments[0] * arguments[1];
    results[2] = arguments[0] - arguments[1];
    results[3] = context.noise_generator;
    results[4] = arguments[1];
    ++calls;
  }
  mutable int calls = 0;
};

struct Function;

/// An expression as written.
struct Expression {
  enum class Kind { number, variable, operation, select, series, call, native };
  Kind kind = Kind::number;
  double number = 0;
  std::size_t which = 0; ///< variable, or a native's component
  FunctionOp op = FunctionOp::add;
  std::vector<Expression> parts;
  std::shared_ptr<const Function> callee;
};

struct Function {
  std::size_t parameters = 0;
  Expression body;
  std::shared_ptr<const FunctionCode> code;
};

const std::shared_ptr<const Powers> kPowers = std::make_shared<Powers>();
constexpr FunctionContext kContext{3};

double value(const Expression& e, std::vector<double>& variables) {
  using Kind = Expression::Kind;
  switch (e.kind) {
  case Kind::number:
    return e.number;
  case Kind::variable:
    return variables[e.which];
  case Kind::operation: {
    const double a = value(e.parts[0], variables);
    return result_of(e.op, a, e.parts.size() > 1 ? value(e.parts[1], variables) : 0, 0);
  }
  case Kind::select: {
    const double chooser = value(e.parts[0], variables);
    return value(e.parts[chooser < 0 ? 1 : chooser == 0 ? 2 : e.parts.size() - 1], variables);
  }
  case Kind::series: {
    const double first = value(e.parts[0], variables), last = value(e.parts[1], variables);
    double result = e.op == FunctionOp::add ? 0 : 1;
    for (double i = first; i <= last; i += 1) {
      variables.push_back(i);
      result = result_of(e.op, result, value(e.parts[2], variables), 0);
      variables.pop_back();
    }
    return result;
  }
  case Kind::call: {
    std::vector<double> arguments;
    for (const Expression& part : e.parts)
      arguments.push_back(value(part, variables));
    return value(e.callee->body, arguments);
  }
  case Kind::native: {
    const double arguments[] = {value(e.parts[0], variables), value(e.parts[1], variables)};
    double results[5];
    kPowers->evaluate(arguments, kContext, results);
    return results[e.which];
  }
  }
  return 0;
}

FunctionValue build(FunctionBuilder& builder, const Expression& e, std::vector<FunctionValue>& variables) {
  using Kind = Expression::Kind;
  const auto part = [&](std::size_t i) { return build(builder, e.parts[i], variables); };
  switch (e.kind) {
  case Kind::number:
    return builder.constant(e.number);
  case Kind::variable:
    return variables[e.which];
  case Kind::operation: {
    const FunctionValue a = part(0);
    return builder.apply(e.op, a, e.parts.size() > 1 ? part(1) : 0);
  }
  case Kind::select: {
    const FunctionValue chooser = part(0);
    FunctionBranches branches;
    for (std::size_t i = 1; i < e.parts.size(); ++i) {
      builder.open_branch();
      branches.blocks[branches.count++] = builder.close(part(i));
    }
    return builder.select(chooser, branches);
  }
  case Kind::series: {
    const FunctionValue first = part(0), last = part(1);
    variables.push_back(builder.open_loop());
    const std::uint32_t body = builder.close(part(2));
    variables.pop_back();
    return builder.loop(e.op, first, last, body);
  }
  default: {
    std::vector<FunctionValue> arguments;
    for (std::size_t i = 0; i < e.parts.size(); ++i)
      arguments.push_back(part(i));
    if (e.kind == Kind::call) return builder.call(e.callee->code, arguments);
    const FunctionValue call = builder.call(std::shared_ptr<const NativeFunction>(kPowers), arguments);
    return builder.component(call, static_cast<std::uint32_t>(e.which));
  }
  }
}

std::shared_ptr<const Function> compiled(std::size_t parameters, Expression body) {
  auto function = std::make_shared<Function>();
  function->parameters = parameters;
  function->body = std::move(body);
  FunctionBuilder builder(static_cast<std::uint32_t>(parameters));
  std::vector<FunctionValue> variables;
  for (std::uint32_t i = 0; i < parameters; ++i)
    variables.push_back(builder.parameter(i));
  const FunctionValue result = build(builder, function->body, variables);
  function->code = std::make_shared<const FunctionCode>(builder.finish(result));
  return function;
}

/// Random expressions.
class Generator {
public:
  explicit Generator(unsigned seed) : random_(seed) {}

  std::size_t below(std::size_t count) { return random_() % count; }
  double number() {
    static constexpr double kSpecial[] = {0,
                                          -0.0,
                                          1,
                                          -1,
                                          1e300,
                                          std::numeric_limits<double>::infinity(),
                                          std::numeric_limits<double>::quiet_NaN()};
    return below(8) == 0 ? kSpecial[below(7)] : (static_cast<double>(below(4001)) - 2000) / 500;
  }

  Expression expression(std::size_t variables, int depth) {
    using Kind = Expression::Kind;
    Expression e;
    const std::size_t choice = depth == 0 ? below(2) : 1 + below(14);
    if (choice == 0) {
      e.number = number();
    } else if (choice == 1) {
      e.kind = Kind::variable;
      e.which = below(variables);
    } else if (choice == 2) {
      e.kind = Kind::select;
      add_parts(e, 3 + below(2), variables, depth);
    } else if (choice == 3) {
      e.kind = Kind::series;
      e.op = below(2) == 0 ? FunctionOp::add : FunctionOp::multiply;
      e.parts.resize(2);
      e.parts[0].number = static_cast<double>(below(3));
      e.parts[1].number = static_cast<double>(below(5));
      e.parts.push_back(expression(variables + 1, depth - 1));
    } else if (choice == 4) {
      e.kind = Kind::native;
      e.which = below(5);
      add_parts(e, 2, variables, depth);
    } else if (choice <= 6 && !functions_.empty()) {
      e.kind = Kind::call;
      e.callee = functions_[below(functions_.size())];
      add_parts(e, e.callee->parameters, variables, depth);
    } else {
      static constexpr FunctionOp kOps[] = {
          FunctionOp::add,      FunctionOp::add,         FunctionOp::subtract, FunctionOp::subtract,
          FunctionOp::multiply, FunctionOp::multiply,    FunctionOp::divide,   FunctionOp::negate,
          FunctionOp::sin,      FunctionOp::maximum,     FunctionOp::minimum,  FunctionOp::less,
          FunctionOp::greater,  FunctionOp::square_root, FunctionOp::whole,    FunctionOp::floor};
      e.kind = Kind::operation;
      e.op = kOps[below(std::size(kOps))];
      add_parts(e, operand_count(e.op), variables, depth);
    }
    return e;
  }

  std::shared_ptr<const Function> function(int depth) {
    const std::size_t parameters = 1 + below(3);
    functions_.push_back(compiled(parameters, expression(parameters, depth)));
    if (functions_.size() > 6) functions_.erase(functions_.begin());
    return functions_.back();
  }

private:
  void add_parts(Expression& e, std::size_t count, std::size_t variables, int depth) {
    // Now and then the same once more, so that there are values to share.
    for (std::size_t i = 0; i < count; ++i)
      e.parts.push_back(i > 0 && below(3) == 0 ? e.parts.back() : expression(variables, depth - 1));
  }

  std::mt19937 random_;
  std::vector<std::shared_ptr<const Function>> functions_;
};

/// The same number, or none at all: processors differ in which operand's sign "not a number" has.
bool is_same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

} // namespace

TEST_CASE("random functions give what their expressions give") {
  FunctionMachine machine;
  for (unsigned seed = 0; seed < 60; ++seed) {
    Generator generator(seed);
    for (int i = 0; i < 20; ++i) {
      const auto function = generator.function(2 + static_cast<int>(seed % 3));
      for (int run = 0; run < 4; ++run) {
        std::vector<double> arguments;
        for (std::size_t p = 0; p < function->parameters; ++p)
          arguments.push_back(generator.number());
        const double got = machine.run(*function->code, arguments.data(), kContext);
        std::vector<double> variables = arguments;
        const double wanted = value(function->body, variables);
        INFO("seed " << seed << ", function " << i << ": " << got << " instead of " << wanted);
        REQUIRE(is_same(got, wanted));
      }
    }
  }
}

TEST_CASE("equal calls in nests of functions are one") {
  // Each function calls the one before four times, twice with the same arguments.
  const FunctionValue x = 0, y = 1;
  std::shared_ptr<const FunctionCode> last;
  for (int level = 0; level < 60; ++level) {
    FunctionBuilder builder(2);
    FunctionValue result = builder.apply(FunctionOp::multiply, x, y);
    if (last) {
      const FunctionValue same[] = {x, y}, turned[] = {y, x};
      const FunctionValue square =
          builder.apply(FunctionOp::multiply, builder.call(last, same), builder.call(last, same));
      const FunctionValue other =
          builder.apply(FunctionOp::multiply, builder.call(last, turned), builder.call(last, turned));
      result = builder.apply(FunctionOp::subtract, square, other);
    }
    last = std::make_shared<const FunctionCode>(builder.finish(result));
    CHECK(last->graph().nodes.size() < 3000);
  }
  const double arguments[] = {0.5, 0.25};
  CHECK(FunctionMachine().run(*last, arguments, kContext) == 0);
}

TEST_CASE("calls that only numbers show to be equal are one, too") {
  std::shared_ptr<const FunctionCode> last;
  for (int level = 0; level < 300; ++level) {
    FunctionBuilder builder(1);
    FunctionValue result = builder.parameter(0);
    if (last) {
      const FunctionValue more[] = {builder.apply(FunctionOp::add, result, builder.constant(1))};
      const FunctionValue less[] = {builder.apply(FunctionOp::subtract, result, builder.constant(1))};
      result =
          builder.apply(FunctionOp::divide,
                        builder.apply(FunctionOp::add, builder.call(last, more), builder.call(last, less)),
                        builder.constant(2));
    }
    last = std::make_shared<const FunctionCode>(builder.finish(result));
  }
  const double argument = 7;
  CHECK(FunctionMachine().run(*last, &argument, kContext) == 7);
}

TEST_CASE("a vector's components need one call") {
  FunctionBuilder builder(2);
  const FunctionValue arguments[] = {0, 1};
  const std::shared_ptr<const NativeFunction> powers = kPowers;
  FunctionValue sum = builder.constant(0);
  for (std::uint32_t which = 0; which < 3; ++which)
    sum = builder.apply(FunctionOp::add, sum, builder.component(builder.call(powers, arguments), which));
  const FunctionCode code(builder.finish(sum));
  kPowers->calls = 0;
  const double numbers[] = {3, 5};
  CHECK(FunctionMachine().run(code, numbers, kContext) == 16);
  CHECK(kPowers->calls == 1);
}

TEST_CASE("what is the same in all turns of a loop is computed once") {
  FunctionBuilder builder(2);
  const FunctionValue arguments[] = {0, 1};
  const FunctionValue first = builder.constant(1), last = builder.constant(100);
  const FunctionValue counter = builder.open_loop();
  const FunctionValue power =
      builder.component(builder.call(std::shared_ptr<const NativeFunction>(kPowers), arguments), 1);
  const std::uint32_t body = builder.close(builder.apply(FunctionOp::multiply, counter, power));
  const FunctionCode code(builder.finish(builder.loop(FunctionOp::add, first, last, body)));
  kPowers->calls = 0;
  const double numbers[] = {2, 5};
  CHECK(FunctionMachine().run(code, numbers, kContext) == 50500);
  CHECK(kPowers->calls == 1);
}

TEST_CASE("a function's values are forgotten when what it depends on changes") {
  // Too long to be inlined.
  FunctionBuilder inner(2);
  const FunctionValue arguments[] = {0, 1};
  FunctionValue result =
      inner.component(inner.call(std::shared_ptr<const NativeFunction>(kPowers), arguments), 3);
  for (int i = 0; i < 200; ++i)
    result = inner.apply(FunctionOp::divide, inner.apply(FunctionOp::multiply, result, inner.constant(3)),
                         inner.constant(3));
  const auto callee = std::make_shared<const FunctionCode>(inner.finish(result));
  FunctionBuilder outer(2);
  const FunctionValue call = outer.call(callee, arguments);
  const FunctionCode code(outer.finish(outer.apply(FunctionOp::negate, call)));
  FunctionMachine machine;
  const double numbers[] = {2, 5};
  CHECK(machine.run(code, numbers, {1}) == -1);
  CHECK(machine.run(code, numbers, {2}) == -2);
  CHECK(machine.run(code, numbers, {1}) == -1);
}

TEST_CASE("functions that take too long fail") {
  FunctionBuilder builder(1);
  const FunctionValue counter = builder.open_loop();
  const std::uint32_t body = builder.close(counter);
  const FunctionCode code(builder.finish(builder.loop(FunctionOp::add, builder.constant(1), 0, body)));
  FunctionMachine machine;
  const double few = 100, many = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(machine.run(code, &many, {}), FunctionFault);
  CHECK(machine.run(code, &few, {}) == 5050);
}
