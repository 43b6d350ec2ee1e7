#include "pov/arithmetic.hpp"

#include <cmath>
#include <vector>

#include "pov/actions.hpp"
#include "pov/constants.hpp"
#include "pov/functions.hpp"
#include "pov/grammar.hpp"
#include "pov/session.hpp"

namespace celltrace::pov {

namespace {

using Number = Parser::token;

constexpr unsigned kDeepestNesting = 64;
constexpr std::size_t kMostStreams = 64; ///< limit on streams that are worth saving

/// Reads an expression by the rules of the grammar; after something that it does not understand, it reads
/// nothing more.
class Expression {
public:
  Expression(Session& session, const TokenSpan& tokens)
      : session_(session), at_(tokens.begin), end_(tokens.end) {}

  Quantity sum() {
    Quantity result = product();
    for (;;) {
      if (take('+'))
        result = result + product();
      else if (take('-'))
        result = result - product();
      else
        return result;
    }
  }

  Quantity in_brackets() {
    const Quantity condition = logic();
    if (!take('?')) return condition;
    if (++depth_ > kDeepestNesting) return give_up();
    const double chooser = number(condition);
    const Quantity chosen = in_brackets();
    if (!take(':')) return give_up();
    const Quantity other = in_brackets();
    return is_true(chooser) ? chosen : other;
  }

  /// Reads a vector after its <.
  Quantity vector() {
    Quantity result;
    result.count = 0;
    do {
      const Quantity component = sum();
      if (result.count == 5 || !component.is_float()) return give_up();
      result.v[static_cast<std::size_t>(result.count++)] = component.v[0];
    } while (take(','));
    return take('>') && result.count > 1 ? result : give_up();
  }

  bool take(char punctuation) {
    if (!next().is(punctuation)) return false;
    ++at_;
    return true;
  }
  /// Returns the next token; kEnd if there is none.
  const Token& next() const { return at_ != end_ ? *at_ : kEnd; }

  /// Returns the result if everything was understood and the tokens that follow cannot belong to the
  /// expression.
  std::optional<Quantity> finish(const Quantity& result, TokenSpan& tokens, bool is_complete) {
    if (is_complete && understands_) {
      tokens.begin = at_;
      return result;
    }
    // Restores the streams, since the grammar evaluates the expression again.
    if (streams_) session_.random_streams = std::move(*streams_);
    return std::nullopt;
  }

private:
  Quantity product() {
    Quantity result = operand();
    for (;;) {
      const Location& where = next().where;
      if (take('*')) {
        result = result * operand();
      } else if (take('/')) {
        const Quantity divisor = operand();
        if (understands_) result = divided(session_, result, divisor, where); // which may warn
      } else {
        return result;
      }
    }
  }

  Quantity operand() {
    const Token& first = next();
    if (!first.is('-') && !first.is('+') && !first.is('!')) return unsigned_operand();
    Signs signs;
    for (; next().is('-') || next().is('+') || next().is('!'); ++at_)
      signs.add(static_cast<char>(next().symbol));
    return signs.apply(unsigned_operand());
  }
  Quantity unsigned_operand() {
    if (++depth_ > kDeepestNesting) return give_up();
    Quantity result = value();
    while (next().kind == Token::Kind::component) {
      const int which = session_.names[next().name].component;
      if (which < 0 || !has_component(result, which)) return give_up();
      result = component(session_, result, which, next().where);
      ++at_;
    }
    --depth_;
    return result;
  }

  Quantity value() {
    const Token& token = next();
    switch (token.kind) {
    case Token::Kind::number:
    case Token::Kind::vector:
      ++at_;
      return literal_of(token);
    case Token::Kind::word:
      ++at_;
      return session_.names[token.name].token != 0 ? reserved(token) : declared(token);
    case Token::Kind::punctuation:
      if (take('<')) return vector();
      if (take('(')) {
        const Quantity result = in_brackets();
        return take(')') ? result : give_up();
      }
      return give_up();
    default:
      return give_up();
    }
  }

  Quantity reserved(const Token& word) {
    const Names::Entry& name = session_.names[word.name];
    if (name.token == Number::T_CONSTANT) {
      const Value constant = value_of(static_cast<Constant>(name.detail), session_);
      const auto* quantity = std::get_if<Quantity>(&constant);
      return quantity ? *quantity : give_up();
    }
    if (name.token != Number::T_FUNCTION || !take_arguments()) return give_up();
    if (!is_pure(name.detail)) save_streams();
    return understands_ ? call_numeric(session_, name.detail, arguments_, word.where) : give_up();
  }

  Quantity declared(const Token& word) {
    const Value* value = session_.symbols.value_of(word.name);
    while (value != nullptr) {
      const auto* const array = std::get_if<std::shared_ptr<Array>>(value);
      if (array == nullptr) break;
      value = take('[') ? element(**array) : nullptr;
    }
    if (value == nullptr) return give_up();
    if (const auto* quantity = std::get_if<Quantity>(value)) return *quantity;
    const auto* function = std::get_if<FunctionPtr>(value);
    return function != nullptr ? called(**function, word.where) : give_up();
  }
  /// Calls a function of the scene; its arguments need no memory on the heap.
  Quantity called(const UserFunction& function, const Location& where) {
    double arguments[kMostParameters];
    std::size_t count = 0;
    if (!take('(')) return give_up();
    do {
      const Quantity argument = in_brackets();
      if (!argument.is_float() || count == function.parameters) return give_up();
      arguments[count++] = argument.v[0];
    } while (take(','));
    if (!take(')') || !understands_ || count != function.parameters) return give_up();
    return call_function(session_, function, arguments, count, where);
  }
  /// Returns an array's element, after its [.
  const Value* element(const Array& array) {
    const double subscript = number(sum());
    if (!take(']') || !(subscript > -1) || !(subscript < static_cast<double>(array.elements.size())))
      return nullptr;
    return &array.elements[static_cast<std::size_t>(subscript)];
  }

  /// Reads ( numbers and vectors )
  bool take_arguments() {
    std::vector<Value> arguments;
    if (!take('(')) return false;
    if (!next().is(')')) do {
        arguments.emplace_back(in_brackets());
      } while (take(','));
    arguments_ = std::move(arguments);
    return take(')');
  }

  Quantity logic() {
    Quantity result = comparison();
    for (;;) {
      const bool is_and = next().is('&');
      if (!is_and && !next().is('|')) return result;
      ++at_;
      const bool left = is_true(number(result)), right = is_true(number(comparison()));
      result = double(is_and ? left && right : left || right);
    }
  }
  Quantity comparison() {
    Quantity result = sum();
    while (const std::optional<Relation> relation = relation_of(next())) {
      ++at_;
      result = compare(*relation, result, sum());
    }
    return result;
  }
  static std::optional<Relation> relation_of(const Token& token) {
    if (token.kind != Token::Kind::punctuation) return std::nullopt;
    switch (token.symbol) {
    case '<':
      return Relation::less;
    case Token::kLessEqual:
      return Relation::less_equal;
    case '=':
      return Relation::equal;
    case Token::kNotEqual:
      return Relation::not_equal;
    case Token::kGreaterEqual:
      return Relation::greater_equal;
    case '>':
      return Relation::greater;
    default:
      return std::nullopt;
    }
  }

  double number(const Quantity& quantity) {
    if (!quantity.is_float() || !std::isfinite(quantity.v[0])) give_up();
    return quantity.v[0];
  }

  Quantity give_up() {
    understands_ = false;
    at_ = end_;
    return {};
  }

  /// Saves the state that a call of rand() or seed() changes.
  void save_streams() {
    if (streams_) return;
    if (session_.random_streams.size() > kMostStreams)
      give_up();
    else
      streams_ = session_.random_streams;
  }

  static const Token kEnd;

  Session& session_;
  const Token* at_;
  const Token* end_;
  unsigned depth_ = 0;
  bool understands_ = true;
  std::vector<Value> arguments_; ///< arguments of the next call
  std::optional<std::vector<std::uint32_t>> streams_;
};

const Token Expression::kEnd;

} // namespace

std::optional<Quantity> take_quantity(Session& session, TokenSpan& tokens) {
  Expression expression(session, tokens);
  const Quantity result = expression.sum();
  const Token& next = expression.next();
  return expression.finish(result, tokens, next.is(';') || next.is(',') || next.is(')') || next.is(']'));
}

std::optional<Quantity> take_condition(Session& session, TokenSpan& tokens) {
  Expression expression(session, tokens);
  if (!expression.take('(')) return std::nullopt;
  const Quantity result = expression.in_brackets();
  return expression.finish(result, tokens, expression.take(')'));
}

std::optional<Quantity> take_vector(Session& session, TokenSpan& tokens) {
  Expression expression(session, tokens);
  const Quantity result = expression.vector();
  return expression.finish(result, tokens, result.count <= 4);
}

std::optional<Quantity> take_argument(Session& session, TokenSpan& tokens) {
  Expression expression(session, tokens);
  const Quantity result = expression.sum();
  const Token& next = expression.next();
  const bool is_reserved = next.kind == Token::Kind::word && session.names[next.name].token != 0;
  return expression.finish(result, tokens, next.is(',') || next.is('}') || is_reserved);
}

std::optional<Quantity> take_next_argument(Session& session, TokenSpan& tokens) {
  if (tokens.begin == tokens.end || !tokens.begin->is(',')) return std::nullopt;
  TokenSpan behind{tokens.begin + 1, tokens.end};
  const std::optional<Quantity> argument = take_argument(session, behind);
  if (argument) tokens = behind;
  return argument;
}

} // namespace celltrace::pov
