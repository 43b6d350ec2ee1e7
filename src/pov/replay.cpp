// TokenStream: macros and loops, which are recorded once and replayed.
#include <algorithm>
#include <cmath>

#include "pov/arithmetic.hpp"
#include "pov/endless_loops.hpp"
#include "pov/session.hpp"
#include "pov/token_stream.hpp"

namespace celltrace::pov {

/// Returns all tokens up to the #end that closes `opening`, without that #end. Tokens that are being replayed
/// are not recorded again.
TokenRange TokenStream::take_block(const Token& opening) {
  Frame& frame = session_.input.top();
  const bool is_replay = frame.scanner == nullptr;
  auto recorded = std::make_shared<std::vector<Token>>();
  const std::size_t begin = frame.position;
  for (unsigned depth = 1;;) {
    const Token token = read();
    if (token.kind == Token::Kind::end) session_.fail(opening.where, "#end is missing for what starts here");
    if (token.kind == Token::Kind::directive) {
      const Directive kind = session_.names[token.name].directive;
      if (opens_block(kind)) ++depth;
      if (kind == Directive::end && --depth == 0) break;
    }
    if (is_replay) continue;
    if (++tokens_recorded_ > session_.options.limits.recorded_tokens)
      session_.exceed(opening.where, &ParseLimits::recorded_tokens, "the macros and loops of the scene have",
                      "tokens");
    recorded->push_back(token);
  }
  if (is_replay) return {frame.range.tokens, begin, frame.position - 1};
  const std::size_t count = recorded->size();
  return {std::move(recorded), 0, count};
}

/// Evaluates recorded tokens by one of arithmetic.hpp's functions; nothing if they are not recorded, or not
/// understood.
std::optional<Quantity> TokenStream::replay(std::optional<Quantity> (*take)(Session&, TokenSpan&)) {
  if (!session_.input.reads_record() || session_.builder.has_old_signs()) return std::nullopt;
  Frame& frame = session_.input.top();
  const Token* const first = frame.range.tokens->data();
  TokenSpan rest{first + frame.position, first + frame.range.end};
  const std::optional<Quantity> taken = take(session_, rest);
  if (!taken) return std::nullopt;
  const auto position = static_cast<std::size_t>(rest.begin - first);
  tokens_read_ += position - frame.position;
  frame.position = position;
  if (tokens_read_ + work_ > next_check_) check_limits();
  return taken;
}

std::optional<Quantity> TokenStream::replay_value(Start start) {
  switch (start) {
  case Start::condition:
    return replay(take_condition);
  case Start::expression:
  case Start::value:
    return replay(take_quantity);
  default:
    return std::nullopt;
  }
}

/// Replaces the bracket by a single token if it begins a vector of numbers.
void TokenStream::replay_vector(Token& bracket) {
  const std::optional<Quantity> vector = replay(take_vector);
  if (!vector) return;
  bracket.kind = Token::Kind::vector;
  bracket.symbol = static_cast<std::uint16_t>(vector->count);
  std::copy_n(vector->v.begin(), vector->count, bracket.number);
}

void TokenStream::replay_arguments(std::vector<ShapeArgument>& arguments) {
  if (!session_.input.reads_record()) return;
  const Frame& frame = session_.input.top();
  for (;;) {
    const bool is_first = arguments.empty();
    const std::size_t place = frame.position + (is_first ? 0 : 1);
    const std::optional<Quantity> argument = replay(is_first ? take_argument : take_next_argument);
    if (!argument) return;
    arguments.push_back({*argument, (*frame.range.tokens)[place].where});
  }
}

namespace {

bool is_same(const Value& a, const Value& b) {
  if (a.index() != b.index()) return false;
  return std::visit(
      [&b](const auto& value) {
        using T = std::decay_t<decltype(value)>;
        const T& other = std::get<T>(b);
        if constexpr (std::is_same_v<T, Quantity>)
          return value.count == other.count && value.is_colour == other.is_colour && value.v == other.v;
        else if constexpr (std::is_same_v<T, Transform>)
          return std::equal(std::begin(value.rows), std::end(value.rows), std::begin(other.rows));
        else
          return value == other;
      },
      a);
}

} // namespace

void TokenStream::leave_frame() {
  const Frame& frame = session_.input.top();
  for (const ElementReference& reference : frame.references)
    if (reference.index < reference.array->elements.size() &&
        !is_same(reference.slot->value, reference.value))
      reference.array->elements[reference.index] = reference.slot->value;
  if (frame.kind != Frame::Kind::loop) session_.symbols.leave_scope();
  if (frame.kind == Frame::Kind::macro) --macro_calls_;
  session_.input.pop();
}

/// Leaves the top frame at its end; false if the innermost entry of the grammar has no more to read.
bool TokenStream::leave_frame_at_end() {
  const Frame& frame = session_.input.top();
  const bool is_last = session_.input.depth() <= levels_.back().base_depth;
  if (is_last && levels_.back().start != Start::scene) return false;
  if (!frame.conditionals.empty())
    session_.fail(frame.conditionals.back().where, "#end is missing for what starts here");
  if (is_last) return false;
  if (frame.kind == Frame::Kind::loop)
    start_iteration(false);
  else
    leave_frame();
  return true;
}

// ---- Macros ----

void TokenStream::define_macro(const Token& directive) {
  auto macro = std::make_shared<Macro>();
  const Token name = expect_name("for a macro");
  macro->name = name.name;
  expect('(', "after a macro's name");
  Token token = read();
  while (!token.is(')')) {
    if (token.kind != Token::Kind::word || session_.names[token.name].token != 0)
      session_.fail(token.where, "expected the name of a macro parameter");
    macro->parameters.push_back(token.name);
    token = read();
    if (token.is(',')) token = read();
  }
  macro->body = take_block(directive);
  session_.symbols.declare(name.name, std::shared_ptr<const Macro>(std::move(macro)));
}

void TokenStream::call(const Token& name, const std::shared_ptr<const Macro>& macro) {
  const std::string call = "macro '" + session_.names.text(name.name) + "'";
  const Token parenthesis = read();
  if (!parenthesis.is('(')) session_.fail(name.where, "expected '(' after " + call);
  std::vector<std::shared_ptr<Slot>> arguments;
  Frame frame;
  Token token = read();
  while (!token.is(')')) {
    if (token.kind == Token::Kind::end)
      session_.fail(name.where, "the arguments of " + call + " are never closed");
    if (arguments.size() == macro->parameters.size())
      session_.fail(name.where,
                    call + " takes only " + std::to_string(macro->parameters.size()) + " arguments");
    session_.input.unread(token);
    arguments.push_back(read_argument(call, frame.references));
    token = read();
    if (token.is(',')) token = read();
  }
  if (arguments.size() != macro->parameters.size())
    session_.fail(name.where, call + " takes " + std::to_string(macro->parameters.size()) +
                                  " arguments, not " + std::to_string(arguments.size()));
  if (++macro_calls_ > session_.options.limits.macro_depth)
    session_.exceed(name.where, &ParseLimits::macro_depth, "macros call one another", "deep");

  session_.symbols.enter_scope();
  for (std::size_t i = 0; i < arguments.size(); ++i)
    session_.symbols.bind(macro->parameters[i], std::move(arguments[i]));
  frame.kind = Frame::Kind::macro;
  frame.opened_at = name.where;
  frame.macro_name = macro->name;
  frame.range = macro->body;
  frame.position = macro->body.begin;
  session_.input.push(std::move(frame));
}

/// Returns, behind the name of an array, whether the subscripts are all that follows in an argument. Puts the
/// subscripts back.
bool TokenStream::is_lone_element() {
  std::vector<Token> passed;
  unsigned depth = 0;
  bool is_lone = false;
  for (;;) {
    const Token token = read();
    if (token.kind == Token::Kind::end || token.kind == Token::Kind::directive) {
      if (token.kind == Token::Kind::directive) passed.push_back(token);
      break;
    }
    passed.push_back(token);
    is_lone = depth == 0 && passed.size() > 1 && (token.is(',') || token.is(')'));
    if (token.is('['))
      ++depth;
    else if (depth == 0)
      break;
    else if (token.is(']'))
      --depth;
  }
  for (; !passed.empty(); passed.pop_back())
    session_.input.unread(passed.back());
  return is_lone;
}

/// Reads a token and executes directives on the way: an #if can choose an argument.
Token TokenStream::read_past_directives() {
  Token token = read();
  for (; token.kind == Token::Kind::directive; token = read())
    obey(token);
  return token;
}

/// Reads an argument: a name or an array's element alone is passed by reference; anything else is evaluated
/// once.
std::shared_ptr<Slot> TokenStream::read_argument(const std::string& call,
                                                 std::vector<ElementReference>& references) {
  const Token first = read_past_directives();
  if (first.kind == Token::Kind::word && session_.names[first.name].token == 0) {
    const Token second = read_past_directives();
    if (second.kind != Token::Kind::end) session_.input.unread(second);
    const std::shared_ptr<Slot> slot = session_.symbols.find(first.name);
    if ((second.is(',') || second.is(')')) && !slot)
      session_.fail(first.where,
                    "'" + session_.names.text(first.name) + "' is not declared, " + call + " cannot take it");
    if (second.is(',') || second.is(')')) return slot;
    if (second.is('[') && slot && std::holds_alternative<std::shared_ptr<Array>>(slot->value) &&
        is_lone_element()) {
      std::vector<std::size_t> subscripts = read_subscripts();
      const std::size_t last = subscripts.back();
      subscripts.pop_back();
      Value& of = element(slot->value, subscripts, first.where);
      const Value& value = element(of, {last}, first.where);
      references.push_back(
          {std::get<std::shared_ptr<Array>>(of), last, std::make_shared<Slot>(Slot{value}), value});
      return references.back().slot;
    }
  }
  // Most arguments are single tokens, which need no grammar.
  if (first.kind == Token::Kind::number || first.kind == Token::Kind::vector) {
    const Token second = read_past_directives();
    if (second.kind != Token::Kind::end) session_.input.unread(second);
    if (second.is(',') || second.is(')')) return std::make_shared<Slot>(Slot{literal_of(first)});
  }
  session_.input.unread(first);
  return std::make_shared<Slot>(Slot{evaluate(Start::value)});
}

// ---- Loops ----

void TokenStream::start_while(const Token& directive) {
  Frame frame;
  frame.kind = Frame::Kind::loop;
  frame.opened_at = directive.where;
  frame.range = take_block(directive);
  session_.input.push(std::move(frame));
  start_iteration(true);
}

void TokenStream::start_for(const Token& directive) {
  expect('(', "after #for");
  const Token name = expect_name("to count with");
  expect(',', "after the name to count with");
  const std::vector<double> numbers = read_numbers(directive.where);
  if (numbers.size() != 2 && numbers.size() != 3)
    session_.fail(directive.where, "#for takes a start, an end and a step");
  Counter counter;
  counter.last = numbers[1];
  counter.step = numbers.size() == 3 ? numbers[2] : 1;
  if (counter.step == 0) session_.fail(directive.where, "the step of a #for must not be 0");

  Frame frame;
  frame.kind = Frame::Kind::loop;
  frame.opened_at = directive.where;
  frame.range = take_block(directive);
  session_.symbols.declare_local(name.name, Quantity(numbers[0]));
  counter.slot = session_.symbols.find(name.name);
  frame.counter = counter;
  session_.input.push(std::move(frame));
  start_iteration(true);
}

namespace {

/// Advances a #for, unless this is the first time, and returns whether the loop goes on.
bool advance(Counter& counter, bool is_first) {
  auto* value = std::get_if<Quantity>(&counter.slot->value);
  if (!value || !value->is_float()) return false;
  if (!is_first) *value = *value + counter.step;
  const double rest = (counter.last - value->v[0]) * (counter.step > 0 ? 1 : -1);
  return rest > -kComparisonTolerance;
}

} // namespace

void TokenStream::start_iteration(bool is_first) {
  constexpr std::uint64_t kIterationsBeforeCheck = 1000;
  Frame& frame = session_.input.top();
  const double least = ++frame.iterations == kIterationsBeforeCheck ? least_iterations(session_, frame) : 0;
  if (std::isinf(least))
    session_.fail(frame.opened_at, "this loop never ends: nothing in it changes what that depends on");
  const std::uint64_t most = session_.options.limits.loop_iterations;
  if (++iterations_ > most || least > static_cast<double>(most - iterations_))
    session_.exceed(frame.opened_at, &ParseLimits::loop_iterations, "the loops of the scene run", "times");
  frame.position = frame.range.begin;
  const bool goes_on = frame.counter ? advance(*frame.counter, is_first) : condition(frame.opened_at);
  if (!goes_on) leave_frame();
}

std::vector<double> TokenStream::read_numbers(const Location& where) {
  const Value list = evaluate(Start::list);
  std::vector<double> numbers;
  for (const Value& element : std::get<std::shared_ptr<Array>>(list)->elements)
    numbers.push_back(session_.any_number(std::get<Quantity>(element), where));
  return numbers;
}

} // namespace celltrace::pov
