// Reads functions of the scene: their expressions consist of floats, and have no values yet, so that the
// grammar's rules for numbers cannot be used.
#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>

#include "geometry/function_operations.hpp"
#include "pov/internal_functions.hpp"
#include "pov/actions.hpp"
#include "pov/functions.hpp"
#include "pov/grammar.hpp"
#include "pov/session.hpp"
#include "pov/user_function.hpp"

namespace celltrace::pov {

namespace {

using tokens = Parser::token;
constexpr int kDeepestCalls = 1000;

/// A function of the language that a scene's functions may call.
struct CalledFunction {
  std::string_view name;
  FunctionOp op;
};
constexpr CalledFunction kCalledFunctions[] = {
    {"abs", FunctionOp::absolute},   {"acos", FunctionOp::acos},   {"acosh", FunctionOp::acosh},
    {"asin", FunctionOp::asin},      {"asinh", FunctionOp::asinh}, {"atan", FunctionOp::atan},
    {"atan2", FunctionOp::atan2},    {"atanh", FunctionOp::atanh}, {"ceil", FunctionOp::ceil},
    {"cos", FunctionOp::cos},        {"cosh", FunctionOp::cosh},   {"div", FunctionOp::quotient},
    {"exp", FunctionOp::exp},        {"floor", FunctionOp::floor}, {"int", FunctionOp::whole},
    {"ln", FunctionOp::ln},          {"log", FunctionOp::log},     {"max", FunctionOp::maximum},
    {"min", FunctionOp::minimum},    {"mod", FunctionOp::modulo},  {"pow", FunctionOp::power},
    {"sin", FunctionOp::sin},        {"sinh", FunctionOp::sinh},   {"sqrt", FunctionOp::square_root},
    {"tan", FunctionOp::tan},        {"tanh", FunctionOp::tanh},   {"degrees", FunctionOp::multiply},
    {"radians", FunctionOp::divide},
};

class Reader {
public:
  Reader(Session& session, const Location& where) : session_(session) { function_->where = where; }

  FunctionPtr read() {
    advance();
    read_parameters();
    require('{', "around a function's body");
    return read_body();
  }

  /// Reads a function of x, y and z whose brace has been read.
  FunctionPtr read_behind_brace() {
    add_coordinates();
    return read_body();
  }

private:
  FunctionPtr read_body() {
    // A parameter's name stands for the parameter, whatever it is declared as outside.
    session_.symbols.enter_scope();
    for (const Variable& variable : variables_)
      if (session_.names[variable.name].token == 0)
        session_.symbols.bind(variable.name, std::make_shared<Slot>());
    advance();
    if (!read_special_body()) read_expression_body();
    require('}', "behind a function's body");
    session_.symbols.leave_scope();
    return function_;
  }

  // ---- Tokens ----

  void advance() {
    terminal_ = {};
    session_.tokens.next(terminal_);
  }
  bool is(int token) const { return terminal_.token == token; }
  bool take(int token) {
    if (!is(token)) return false;
    advance();
    return true;
  }
  [[noreturn]] void fail_unexpected(const char* expected) const {
    session_.fail(terminal_.where,
                  "unexpected " + session_.tokens.describe_last() + ", expected " + expected);
  }
  void require(char punctuation, const char* purpose) const {
    if (!is(punctuation)) fail_unexpected((std::string("'") + punctuation + "' " + purpose).c_str());
  }
  void expect(char punctuation, const char* purpose) {
    require(punctuation, purpose);
    advance();
  }
  /// Returns the word from which the terminal was made.
  std::optional<NameId> word() const {
    const Token& token = session_.tokens.last_token();
    if (token.kind != Token::Kind::word) return std::nullopt;
    return token.name;
  }

  // ---- Parameters ----

  void read_parameters() {
    if (!take('(')) {
      add_coordinates();
      return;
    }
    while (!is(')')) {
      const std::optional<NameId> name = word();
      const bool is_free = name && (session_.names[*name].token == 0 || is_coordinate(*name));
      if (!is_free) fail_unexpected("the name of a parameter");
      if (variables_.size() >= kMostParameters)
        session_.fail(terminal_.where,
                      "a function has at most " + std::to_string(kMostParameters) + " parameters");
      add_parameter(variable_of(*name));
      advance();
      take(',');
    }
    advance();
    function_->parameters = variables_.size();
  }
  void add_coordinates() {
    for (const char* name : {"x", "y", "z"})
      add_parameter(session_.names.intern(name));
  }
  void add_parameter(NameId name) {
    variables_.push_back({name, static_cast<FunctionValue>(variables_.size())});
  }
  /// Returns the variable of a name: u and v are other names of x and y.
  NameId variable_of(NameId name) const {
    const std::string& text = session_.names.text(name);
    if (text == "u") return session_.names.intern("x");
    if (text == "v") return session_.names.intern("y");
    return name;
  }
  bool is_coordinate(NameId name) const {
    const std::string& text = session_.names.text(name);
    return text.size() == 1 && std::string("xyzuvt").find(text) != std::string::npos;
  }

  // ---- Bodies that are no expressions ----

  bool read_special_body() {
    const std::optional<NameId> name = word();
    if (name && session_.names.text(*name) == "internal") {
      advance();
      read_internal();
    } else if (is(tokens::T_TRANSFORM) || is(tokens::T_SPLINE)) {
      read_value();
    } else if (is(tokens::T_PIGMENT) || (name && session_.names.text(*name) == "pattern")) {
      read_texture(is(tokens::T_PIGMENT));
    } else {
      return false;
    }
    return true;
  }

  void read_internal() {
    const Location where = terminal_.where;
    expect('(', "after 'internal'");
    const auto* number = std::get_if<Quantity>(&terminal_.value);
    if (!is(tokens::T_QUANTITY) || !number) fail_unexpected("a number");
    const bool is_number = number->v[0] >= 0 && number->v[0] < 1000;
    const auto internal = is_number ? internal_function(static_cast<int>(number->v[0])) : std::nullopt;
    if (!internal) session_.fail(where, "there is no internal function of this number");
    function_->body = internal->body;
    function_->parameters = internal->parameters;
    advance();
    expect(')', "after the number");
  }

  /// Lets the grammar read a pigment, or a pattern as if it were a pigment.
  void read_texture(bool is_pigment) {
    const Location where = terminal_.where;
    Token word = session_.tokens.last_token();
    word.name = session_.names.intern("pigment");
    session_.input.unread(word);
    const Value value = session_.tokens.evaluate(Start::value);
    const PigmentDefinition& pigment = *std::get<PigmentPtr>(value);
    if (!is_pigment && !pigment.pattern.exists() && !pigment.first_unsupported())
      session_.fail(where, "there is no pattern in this function");
    function_->body = is_pigment ? pigment_function(pigment) : pattern_function(pigment);
    function_->returns_vector = function_->returns_colour = is_pigment;
    advance();
  }

  /// Lets the grammar read a transformation or spline.
  void read_value() {
    session_.tokens.unread_last();
    const Value value = session_.tokens.evaluate(Start::value);
    function_->returns_vector = true;
    if (const auto* transform = std::get_if<Transform>(&value)) {
      function_->body = *transform;
    } else {
      function_->body = spline_function(std::get<SplinePtr>(value));
      function_->parameters = 1;
    }
    advance();
  }

  // ---- Expressions ----

  struct Variable {
    NameId name;
    FunctionValue value;
  };

  void read_expression_body() {
    builder_.emplace(static_cast<std::uint32_t>(function_->parameters));
    const FunctionValue result = read_logic();
    auto code = std::make_shared<const FunctionCode>(builder_->finish(result));
    function_->memory.take(code->graph().bytes());
    function_->body = std::move(code);
  }
  auto find(NameId name) const {
    return std::find_if(variables_.rbegin(), variables_.rend(),
                        [name](const Variable& variable) { return variable.name == name; });
  }

  FunctionValue apply(FunctionOp op, FunctionValue a, FunctionValue b = 0) {
    if (builder_->is_too_large()) session_.fail(terminal_.where, "this function is too long");
    return builder_->apply(op, a, b);
  }

  /// Reads a logical expression. In functions, and nowhere else, & binds tighter than |.
  FunctionValue read_logic() {
    FunctionValue result = read_both();
    while (take('|'))
      result = apply(FunctionOp::either, result, read_both());
    return result;
  }
  FunctionValue read_both() {
    FunctionValue result = read_comparison();
    while (take('&'))
      result = apply(FunctionOp::both, result, read_comparison());
    return result;
  }

  std::optional<FunctionOp> relation() const {
    switch (terminal_.token) {
    case '<':
      return FunctionOp::less;
    case tokens::T_LESS_EQUAL:
      return FunctionOp::less_equal;
    case '=':
      return FunctionOp::equal;
    case tokens::T_NOT_EQUAL:
      return FunctionOp::not_equal;
    case tokens::T_GREATER_EQUAL:
      return FunctionOp::greater_equal;
    case '>':
      return FunctionOp::greater;
    default:
      return std::nullopt;
    }
  }

  FunctionValue read_comparison() {
    FunctionValue result = read_sum();
    while (const std::optional<FunctionOp> found = relation()) {
      advance();
      result = apply(*found, result, read_sum());
    }
    return result;
  }

  FunctionValue read_sum() {
    FunctionValue result = read_product();
    for (;;) {
      const FunctionOp op = is('+') ? FunctionOp::add : FunctionOp::subtract;
      if (!take('+') && !take('-')) return result;
      result = apply(op, result, read_product());
    }
  }

  FunctionValue read_product() {
    FunctionValue result = read_signed();
    for (;;) {
      const FunctionOp op = is('*') ? FunctionOp::multiply : FunctionOp::divide;
      if (!take('*') && !take('/')) return result;
      result = apply(op, result, read_signed());
    }
  }

  FunctionValue read_signed() {
    std::vector<FunctionOp> signs;
    for (; is('-') || is('+') || is('!'); advance())
      if (!is('+')) signs.push_back(is('-') ? FunctionOp::negate : FunctionOp::invert);
    FunctionValue result = read_operand();
    for (auto sign = signs.rbegin(); sign != signs.rend(); ++sign)
      result = apply(*sign, result);
    return result;
  }

  FunctionValue read_operand() {
    const std::optional<NameId> name = word();
    if (name) {
      const NameId variable = variable_of(*name);
      const auto found = find(variable);
      if (found != variables_.rend()) {
        advance();
        return found->value;
      }
      if (is_coordinate(variable) && session_.names.text(variable) != "t") return read_missing(*name);
    }
    switch (terminal_.token) {
    case '(': {
      advance();
      const FunctionValue result = read_logic();
      expect(')', "");
      return result;
    }
    case tokens::T_QUANTITY:
      return read_constant();
    case tokens::T_FUNCTION:
      return read_builtin(*name);
    case tokens::T_FUNCTION_ID:
      return read_call(std::get<FunctionPtr>(terminal_.value));
    case tokens::T_SPLINE_ID:
      return read_call(function_of(std::get<SplinePtr>(terminal_.value)));
    case tokens::T_UNDECLARED_ID:
      session_.fail(terminal_.where, session_.tokens.describe_last() + " is not declared");
    default:
      if (name && (session_.names.text(*name) == "sum" || session_.names.text(*name) == "prod"))
        return read_series(session_.names.text(*name) == "sum");
      fail_unexpected("a number");
    }
  }

  /// Reads a coordinate that is no parameter; outside of functions the name is a vector.
  FunctionValue read_missing(NameId name) {
    session_.diagnostics.warn_once(terminal_.where, "'" + session_.names.text(name) +
                                                        "' is no parameter of this function: it is 0 here");
    advance();
    return builder_->constant(0);
  }

  FunctionValue read_constant() {
    Quantity value = std::get<Quantity>(terminal_.value);
    const Location where = terminal_.where;
    advance();
    if (is(tokens::T_COMPONENT)) {
      value = component(session_, value, terminal_.detail, terminal_.where);
      advance();
    }
    return builder_->constant(session_.any_number(value, where));
  }

  std::vector<FunctionValue> read_arguments() {
    std::vector<FunctionValue> arguments;
    expect('(', "before the arguments of a function");
    while (!is(')')) {
      if (!arguments.empty()) expect(',', "between the arguments of a function");
      arguments.push_back(read_logic());
    }
    advance();
    return arguments;
  }

  FunctionValue read_builtin(NameId name) {
    const std::string& text = session_.names.text(name);
    if (text == "select") return read_select();
    const Location where = terminal_.where;
    const int number = terminal_.detail;
    const auto called = std::find_if(std::begin(kCalledFunctions), std::end(kCalledFunctions),
                                     [&](const CalledFunction& function) { return function.name == text; });
    advance();
    const std::vector<FunctionValue> arguments = read_arguments();
    check_numeric_call(session_, number, arguments.size(), where);
    if (called == std::end(kCalledFunctions))
      session_.fail(where, text + "() is no function that functions may call");
    if (called->op == FunctionOp::multiply || called->op == FunctionOp::divide)
      return apply(called->op, arguments[0], builder_->constant(kDegreesPerRadian));
    FunctionValue result = arguments[0];
    if (arguments.size() == 1 && (text == "max" || text == "min")) return result;
    if (arguments.size() == 1) return apply(called->op, result);
    for (std::size_t i = 1; i < arguments.size(); ++i)
      result = apply(called->op, result, arguments[i]);
    return result;
  }

  FunctionPtr function_of(const SplinePtr& spline) {
    const auto known = std::find_if(splines_.begin(), splines_.end(),
                                    [&](const auto& entry) { return entry.first == spline; });
    if (known != splines_.end()) return known->second;
    auto function = std::make_shared<UserFunction>();
    function->body = spline_function(spline);
    function->parameters = 1;
    function->returns_vector = true;
    splines_.emplace_back(spline, function);
    return function;
  }

  FunctionValue read_call(const FunctionPtr callee) { // a copy, since the terminal moves on
    const Location where = terminal_.where;
    advance();
    const std::vector<FunctionValue> arguments = read_arguments();
    check_argument_count(session_, *callee, arguments.size(), where);
    function_->depth = std::max(function_->depth, callee->depth + 1);
    if (function_->depth > kDeepestCalls) session_.fail(where, "functions call one another too deeply");
    if (builder_->is_too_large()) session_.fail(where, "this function is too long");
    if (const auto* transform = std::get_if<Transform>(&callee->body))
      return read_component([&](std::uint32_t which) { return coordinate(*transform, arguments, which); });
    const auto* code = std::get_if<std::shared_ptr<const FunctionCode>>(&callee->body);
    const FunctionCallee called =
        code ? FunctionCallee(*code) : std::get<std::shared_ptr<const NativeFunction>>(callee->body);
    const FunctionValue result = builder_->call(called, arguments);
    if (!callee->returns_vector) return result;
    return read_component([&](std::uint32_t which) { return builder_->component(result, which); });
  }

  /// Reads the component that follows a vector or colour. `component` returns the value of each by its
  /// number.
  template <class Component> FunctionValue read_component(Component component) {
    if (!is(tokens::T_COMPONENT)) fail_unexpected("one of the vector's components");
    const int which = terminal_.detail;
    advance();
    const auto weighted = [&](std::uint32_t number, double weight) {
      return apply(FunctionOp::multiply, builder_->constant(weight), component(number));
    };
    switch (which) {
    case kGreyComponent:
      return apply(FunctionOp::add, apply(FunctionOp::add, weighted(0, 0.297), weighted(1, 0.589)),
                   weighted(2, 0.114));
    case kHeightComponent: {
      const FunctionValue fine = apply(FunctionOp::divide, component(1), builder_->constant(255));
      return apply(FunctionOp::multiply, apply(FunctionOp::add, component(0), fine),
                   builder_->constant(0.996093));
    }
    default:
      return component(static_cast<std::uint32_t>(which));
    }
  }

  /// Returns a coordinate of a transformed point, by the operations of Transform::point().
  FunctionValue coordinate(const Transform& transform, const std::vector<FunctionValue>& point,
                           std::uint32_t which) {
    if (which > 2) return builder_->constant(0);
    const auto axis = static_cast<int>(which);
    const auto product = [&](int row) {
      return apply(FunctionOp::multiply, point[static_cast<std::size_t>(row)],
                   builder_->constant(transform.rows[row][axis]));
    };
    const FunctionValue turned =
        apply(FunctionOp::add, apply(FunctionOp::add, product(0), product(1)), product(2));
    return apply(FunctionOp::add, turned, builder_->constant(transform.rows[3][axis]));
  }

  /// Reads select(). Only the chosen argument is evaluated, unless evaluation is cheap.
  FunctionValue read_select() {
    const Location where = terminal_.where;
    advance();
    expect('(', "after 'select'");
    const FunctionValue chooser = read_logic();
    FunctionBranches branches;
    std::uint32_t count = 0;
    while (take(',')) {
      builder_->open_branch();
      const std::uint32_t block = builder_->close(read_logic());
      if (count++ < 3) branches.blocks[branches.count++] = block;
    }
    expect(')', "behind the arguments of 'select'");
    if (count != 2 && count != 3) session_.fail(where, "select() takes 3 or 4 arguments");
    return builder_->select(chooser, branches);
  }

  /// Reads sum(i, first, last, expression), or a product.
  FunctionValue read_series(bool is_sum) {
    advance();
    expect('(', is_sum ? "after 'sum'" : "after 'prod'");
    const std::optional<NameId> name = word();
    if (!name || (session_.names[*name].token != 0 && !is_coordinate(*name)))
      fail_unexpected("a name to count with");
    session_.symbols.enter_scope();
    if (session_.names[*name].token == 0) session_.symbols.bind(*name, std::make_shared<Slot>());
    advance();
    expect(',', "after the name to count with");
    const FunctionValue first = read_logic();
    expect(',', "after the first number");
    const FunctionValue last = read_logic();
    require(',', "after the last number");
    // As in POV-Ray, a counter named as a coordinate does not hide the parameter.
    variables_.push_back({is_coordinate(*name) ? kNoName : *name, builder_->open_loop()});
    advance();
    const std::uint32_t body = builder_->close(read_logic());
    variables_.pop_back();
    session_.symbols.leave_scope();
    expect(')', is_sum ? "behind a sum" : "behind a product");
    return builder_->loop(is_sum ? FunctionOp::add : FunctionOp::multiply, first, last, body);
  }

  static constexpr NameId kNoName = ~NameId{0};

  Session& session_;
  Terminal terminal_;
  std::shared_ptr<UserFunction> function_ = std::make_shared<UserFunction>();
  std::optional<FunctionBuilder> builder_;
  std::vector<Variable> variables_; ///< the parameters, followed by the counters of sums and products
  std::vector<std::pair<SplinePtr, FunctionPtr>> splines_; ///< functions of splines that are called by name
};

} // namespace

FunctionPtr read_function(Session& session, const Location& where) {
  return Reader(session, where).read();
}

FunctionPtr read_function_body(Session& session, const Location& where) {
  return Reader(session, where).read_behind_brace();
}

} // namespace celltrace::pov
