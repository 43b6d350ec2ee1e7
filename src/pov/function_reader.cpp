// Reads functions of the scene: their expressions are of floats only, and not values yet, so that the
// grammar's rules for numbers are of no use.
#include <algorithm>
#include <optional>

#include "pov/actions.hpp"
#include "pov/functions.hpp"
#include "pov/grammar.hpp"
#include "pov/session.hpp"
#include "pov/user_function.hpp"

namespace celltrace::pov {

namespace {

using tokens = Parser::token;
using Kind = FunctionStep::Kind;

constexpr int kDeepestCalls = 100;
constexpr std::size_t kMostParameters = 56; // as in POV-Ray
constexpr std::size_t kMostSteps = 1'000'000;

class Reader {
public:
  Reader(Session& session, const Location& where) : session_(session) { function_->where = where; }

  FunctionPtr read() {
    advance();
    read_parameters();
    require('{', "around a function's body");
    // Names of parameters stand for themselves, whatever they are declared as outside.
    session_.symbols.enter_scope();
    for (const NameId name : variables_)
      if (session_.names[name].token == 0) session_.symbols.bind(name, std::make_shared<Slot>());
    advance();
    if (!read_special_body()) read_expression_body();
    require('}', "behind a function's body");
    session_.symbols.leave_scope();
    return function_;
  }

private:
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
  /// The word that the terminal was made of.
  std::optional<NameId> word() const {
    const Token& token = session_.tokens.last_token();
    if (token.kind != Token::Kind::word) return std::nullopt;
    return token.name;
  }

  // ---- Parameters ----

  void read_parameters() {
    if (!take('(')) {
      for (const char* name : {"x", "y", "z"})
        variables_.push_back(session_.names.intern(name));
      return;
    }
    while (!is(')')) {
      const std::optional<NameId> name = word();
      const bool is_free = name && (session_.names[*name].token == 0 || is_coordinate(*name));
      if (!is_free) fail_unexpected("the name of a parameter");
      if (variables_.size() >= kMostParameters)
        session_.fail(terminal_.where,
                      "a function has at most " + std::to_string(kMostParameters) + " parameters");
      variables_.push_back(variable_of(*name));
      advance();
      take(',');
    }
    advance();
    function_->parameters = variables_.size();
  }
  /// u and v are other names of x and y.
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
      const Location where = terminal_.where;
      const bool is_pigment = is(tokens::T_PIGMENT);
      session_.tokens.skip_group();
      function_->body = std::make_shared<const Unsupported>(
          Unsupported{is_pigment ? "a pigment as a function" : "a pattern as a function", where});
      function_->gives_vector = is_pigment;
      advance();
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
    const int parameters =
        number->v[0] >= 0 && number->v[0] < 1000 ? internal_parameters(static_cast<int>(number->v[0])) : -1;
    if (parameters < 0) session_.fail(where, "there is no internal function of this number");
    function_->body = InternalFunction{static_cast<int>(number->v[0])};
    function_->parameters = static_cast<std::size_t>(3 + parameters);
    advance();
    expect(')', "after the number");
  }

  /// Has the grammar read a transformation or spline.
  void read_value() {
    session_.tokens.unread_last();
    const Value value = session_.tokens.evaluate(Start::value);
    function_->gives_vector = true;
    if (const auto* transform = std::get_if<Transform>(&value)) {
      function_->body = *transform;
    } else {
      function_->body = std::get<SplinePtr>(value);
      function_->parameters = 1;
    }
    advance();
  }

  // ---- Expressions ----

  void read_expression_body() {
    read_logic();
    program_.variables =
        static_cast<std::uint32_t>(most_variables_ = std::max(most_variables_, variables_.size()));
    function_->body = std::move(program_);
  }
  bool is_variable(NameId name) const {
    return std::find(variables_.begin(), variables_.end(), name) != variables_.end();
  }

  std::uint32_t emit(Kind kind, std::uint32_t a = 0, std::uint32_t b = 0, std::uint32_t c = 0) {
    if (program_.steps.size() >= kMostSteps) session_.fail(terminal_.where, "this function is too long");
    program_.steps.push_back({kind, a, b, c, 0, terminal_.where});
    return static_cast<std::uint32_t>(program_.steps.size() - 1);
  }
  void emit_constant(double value) { program_.steps[emit(Kind::constant)].value = value; }
  std::uint32_t here() const { return static_cast<std::uint32_t>(program_.steps.size()); }

  /// In functions, and there alone, & binds tighter than |.
  void read_logic() {
    read_both();
    while (take('|')) {
      read_both();
      emit(Kind::either);
    }
  }
  void read_both() {
    read_comparison();
    while (take('&')) {
      read_comparison();
      emit(Kind::both);
    }
  }

  std::optional<Relation> relation() const {
    switch (terminal_.token) {
    case '<':
      return Relation::less;
    case tokens::T_LESS_EQUAL:
      return Relation::less_equal;
    case '=':
      return Relation::equal;
    case tokens::T_NOT_EQUAL:
      return Relation::not_equal;
    case tokens::T_GREATER_EQUAL:
      return Relation::greater_equal;
    case '>':
      return Relation::greater;
    default:
      return std::nullopt;
    }
  }

  void read_comparison() {
    read_sum();
    while (const std::optional<Relation> found = relation()) {
      advance();
      read_sum();
      emit(Kind::compare, static_cast<std::uint32_t>(*found));
    }
  }

  void read_sum() {
    read_product();
    for (;;) {
      const Kind kind = is('+') ? Kind::add : Kind::subtract;
      if (!take('+') && !take('-')) return;
      read_product();
      emit(kind);
    }
  }

  void read_product() {
    read_signed();
    for (;;) {
      const Kind kind = is('*') ? Kind::multiply : Kind::divide;
      if (!take('*') && !take('/')) return;
      read_signed();
      emit(kind);
    }
  }

  void read_signed() {
    std::vector<Kind> signs;
    for (; is('-') || is('+') || is('!'); advance())
      if (!is('+')) signs.push_back(is('-') ? Kind::negate : Kind::invert);
    read_operand();
    for (auto sign = signs.rbegin(); sign != signs.rend(); ++sign)
      emit(*sign);
  }

  void read_operand() {
    const std::optional<NameId> name = word();
    if (name) {
      const NameId variable = variable_of(*name);
      if (is_variable(variable)) return read_variable(variable);
      if (is_coordinate(variable) && session_.names.text(variable) != "t") return read_missing(*name);
    }
    switch (terminal_.token) {
    case '(':
      advance();
      read_logic();
      return expect(')', "");
    case tokens::T_QUANTITY:
      return read_constant();
    case tokens::T_FUNCTION:
      return read_builtin(name);
    case tokens::T_FUNCTION_ID:
      return read_call(std::get<FunctionPtr>(terminal_.value));
    case tokens::T_SPLINE_ID: {
      auto spline = std::make_shared<UserFunction>();
      spline->body = std::get<SplinePtr>(terminal_.value);
      spline->parameters = 1;
      spline->gives_vector = true;
      return read_call(spline);
    }
    case tokens::T_UNDECLARED_ID:
      session_.fail(terminal_.where, session_.tokens.describe_last() + " is not declared");
    default:
      if (name && (session_.names.text(*name) == "sum" || session_.names.text(*name) == "prod"))
        return read_series(session_.names.text(*name) == "sum");
      fail_unexpected("a number");
    }
  }

  void read_variable(NameId name) {
    // The innermost one of that name.
    const auto found = std::find(variables_.rbegin(), variables_.rend(), name);
    emit(Kind::load, static_cast<std::uint32_t>(variables_.rend() - found - 1));
    advance();
  }

  /// A coordinate that is no parameter, in place of the vector that it is elsewhere.
  void read_missing(NameId name) {
    session_.diagnostics.warn_once(terminal_.where, "'" + session_.names.text(name) +
                                                        "' is no parameter of this function: it is 0 here");
    emit_constant(0);
    advance();
  }

  void read_constant() {
    Quantity value = std::get<Quantity>(terminal_.value);
    const Location where = terminal_.where;
    advance();
    if (is(tokens::T_COMPONENT)) {
      value = component(session_, value, terminal_.detail, terminal_.where);
      advance();
    }
    emit_constant(session_.number(value, where));
  }

  std::uint32_t read_arguments() {
    std::uint32_t count = 0;
    expect('(', "before the arguments of a function");
    while (!is(')')) {
      if (count > 0) expect(',', "between the arguments of a function");
      read_logic();
      ++count;
    }
    advance();
    return count;
  }

  void read_builtin(const std::optional<NameId>& name) {
    if (name && session_.names.text(*name) == "select") return read_select();
    const Location where = terminal_.where;
    const auto number = static_cast<std::uint32_t>(terminal_.detail);
    advance();
    const std::uint32_t count = read_arguments();
    check_numeric_call(session_, static_cast<int>(number), count, where);
    program_.steps[emit(Kind::builtin, number, count)].where = where;
  }

  void read_call(const FunctionPtr callee) { // a copy: the terminal moves on
    const Location where = terminal_.where;
    advance();
    const std::uint32_t count = read_arguments();
    if (count != callee->parameters)
      session_.fail(where, "this function takes " + std::to_string(callee->parameters) +
                               (callee->parameters == 1 ? " argument" : " arguments") + ", not " +
                               std::to_string(count));
    function_->depth = std::max(function_->depth, callee->depth + 1);
    if (function_->depth > kDeepestCalls) session_.fail(where, "functions call one another too deeply");
    std::uint32_t which = 0;
    if (callee->gives_vector) {
      if (!is(tokens::T_COMPONENT)) fail_unexpected("one of the vector's components");
      which = static_cast<std::uint32_t>(terminal_.detail);
      advance();
    }
    program_.callees.push_back(callee);
    emit(Kind::call, static_cast<std::uint32_t>(program_.callees.size() - 1), which, count);
    program_.steps.back().where = where;
  }

  /// Only what is chosen is evaluated.
  void read_select() {
    const Location where = terminal_.where;
    advance();
    expect('(', "after 'select'");
    read_logic();
    const std::uint32_t choice = emit(Kind::choose);
    std::vector<std::uint32_t> starts, jumps;
    while (take(',')) {
      starts.push_back(here());
      read_logic();
      jumps.push_back(emit(Kind::jump));
    }
    expect(')', "behind the arguments of 'select'");
    if (starts.size() != 2 && starts.size() != 3) session_.fail(where, "select() takes 3 or 4 arguments");
    FunctionStep& step = program_.steps[choice];
    step.a = starts[0];
    step.b = starts[1];
    step.c = starts.back();
    for (const std::uint32_t jump : jumps)
      program_.steps[jump].a = here();
  }

  /// sum(i, first, last, expression), and the product.
  void read_series(bool is_sum) {
    advance();
    expect('(', is_sum ? "after 'sum'" : "after 'prod'");
    const std::optional<NameId> name = word();
    if (!name || (session_.names[*name].token != 0 && !is_coordinate(*name)))
      fail_unexpected("a name to count with");
    session_.symbols.enter_scope();
    if (session_.names[*name].token == 0) session_.symbols.bind(*name, std::make_shared<Slot>());
    advance();
    expect(',', "after the name to count with");
    read_logic();
    expect(',', "after the first number");
    read_logic();
    require(',', "after the last number");
    const auto counter = static_cast<std::uint32_t>(variables_.size());
    const std::uint32_t last = counter + 1, result = counter + 2;
    // As in POV-Ray, what is named like a coordinate is still the parameter.
    variables_.push_back(is_coordinate(*name) ? kNoName : *name);
    variables_.push_back(kNoName);
    variables_.push_back(kNoName);
    most_variables_ = std::max(most_variables_, variables_.size());
    advance();
    emit(Kind::store, last);
    emit(Kind::store, counter);
    emit_constant(is_sum ? 0 : 1);
    emit(Kind::store, result);
    const std::uint32_t loop = here();
    emit(Kind::load, counter);
    emit(Kind::load, last);
    const std::uint32_t exit = emit(Kind::jump_past);
    emit(Kind::load, result);
    read_logic();
    emit(is_sum ? Kind::add : Kind::multiply);
    emit(Kind::store, result);
    emit(Kind::load, counter);
    emit_constant(1);
    emit(Kind::add);
    emit(Kind::store, counter);
    emit(Kind::jump, loop);
    program_.steps[exit].a = here();
    emit(Kind::load, result);
    variables_.resize(counter);
    session_.symbols.leave_scope();
    expect(')', is_sum ? "behind a sum" : "behind a product");
  }

  static constexpr NameId kNoName = ~NameId{0};

  Session& session_;
  Terminal terminal_;
  std::shared_ptr<UserFunction> function_ = std::make_shared<UserFunction>();
  FunctionProgram program_;
  std::vector<NameId> variables_; // the parameters, then what is counted with
  std::size_t most_variables_ = 0;
};

} // namespace

FunctionPtr read_function(Session& session, const Location& where) {
  return Reader(session, where).read();
}

} // namespace celltrace::pov
