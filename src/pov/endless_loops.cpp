#include "pov/endless_loops.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "pov/constants.hpp"
#include "pov/functions.hpp"
#include "pov/grammar.hpp"
#include "pov/session.hpp"

namespace celltrace::pov {

namespace {

using Number = Parser::token;

using Values = std::vector<const Value*>;

bool is_macro(const Value* value) {
  return value != nullptr && std::holds_alternative<std::shared_ptr<const Macro>>(*value);
}

/// Returns the number of tokens in the condition at the beginning of a loop; 0 if the condition does not end.
std::size_t condition_length(const TokenRange& loop) {
  unsigned depth = 0;
  for (std::size_t i = loop.begin; i < loop.end; ++i) {
    const Token& token = (*loop.tokens)[i];
    if (token.is('(')) ++depth;
    if (token.is(')') && --depth == 0) return i + 1 - loop.begin;
  }
  return 0;
}

/// Returns the values that a condition depends on; nothing if it may change by itself.
std::optional<Values> dependencies(const Session& session, const TokenRange& condition) {
  Values values;
  for (std::size_t i = condition.begin; i < condition.end; ++i) {
    const Token& token = (*condition.tokens)[i];
    if (token.kind != Token::Kind::word) continue;
    const Names::Entry& name = session.names[token.name];
    if (name.token == Number::T_CONSTANT && name.detail != static_cast<int>(Constant::now)) continue;
    if (name.token == Number::T_FUNCTION && is_pure(name.detail)) continue;
    const Value* const value = name.token == 0 ? session.symbols.value_of(token.name) : nullptr;
    if (value == nullptr || is_macro(value)) return std::nullopt;
    values.push_back(value);
  }
  return values;
}

/// Looks for tokens that may change one of some values, or leave the loop.
class Search {
public:
  Search(const Session& session, Values values) : session_(session), values_(std::move(values)) {}

  /// Searches a loop's body or, with `macro`, the body of that macro.
  bool may_end(const TokenRange& body, const Macro* macro = nullptr) {
    Directive writer = Directive::none; // applies to the next name
    for (std::size_t i = body.begin; i < body.end; ++i) {
      const Token& token = (*body.tokens)[i];
      if (token.kind == Token::Kind::directive) {
        writer = session_.names[token.name].directive;
        if (!is_known(writer)) return true;
      } else if (token.kind == Token::Kind::word) {
        const Names::Entry& name = session_.names[token.name];
        if (name.token == Number::T_TRACE) return true; // trace() writes to a name
        if (name.token != 0) continue;
        const Value* const value = session_.symbols.value_of(token.name);
        if (value == nullptr && name.directive != Directive::none) return true; // a directive without its #
        if (writes(writer) && changes(token.name, value, writer, macro)) return true;
        if (is_macro(value) && may_end_by(*std::get<std::shared_ptr<const Macro>>(*value))) return true;
        if (name.text != "deprecated") writer = Directive::none;
      }
    }
    return false;
  }

private:
  bool may_end_by(const Macro& macro) {
    if (std::find(seen_.begin(), seen_.end(), &macro) != seen_.end()) return false;
    seen_.push_back(&macro);
    return seen_.size() > kMostMacros || may_end(macro.body, &macro);
  }

  /// Returns whether a write to a name changes a value. A macro's own names differ from those outside of the
  /// macro, but its parameters may not.
  bool changes(NameId name, const Value* value, Directive writer, const Macro* macro) const {
    if (macro != nullptr) {
      const auto& parameters = macro->parameters;
      if (std::find(parameters.begin(), parameters.end(), name) != parameters.end()) return true;
      if (writer == Directive::local || writer == Directive::for_) return false;
    }
    return std::find(values_.begin(), values_.end(), value) != values_.end();
  }
  static bool writes(Directive directive) {
    return directive == Directive::declare || directive == Directive::local ||
           directive == Directive::undef || directive == Directive::for_;
  }
  /// Returns whether a directive only branches, repeats, prints, or writes to a name.
  static bool is_known(Directive directive) {
    switch (directive) {
    case Directive::if_:
    case Directive::ifdef:
    case Directive::ifndef:
    case Directive::elseif:
    case Directive::else_:
    case Directive::switch_:
    case Directive::case_:
    case Directive::range:
    case Directive::while_:
    case Directive::end:
    case Directive::debug:
    case Directive::warning:
    case Directive::write_:
      return true;
    default:
      return writes(directive);
    }
  }

  static constexpr std::size_t kMostMacros = 100;

  const Session& session_;
  const Values values_;
  std::vector<const Macro*> seen_;
};

} // namespace

double least_iterations(const Session& session, const Frame& loop) {
  if (loop.counter) {
    const Value& value = loop.counter->slot->value;
    const auto* count = std::get_if<Quantity>(&value);
    if (count == nullptr || Search(session, {&value}).may_end(loop.range)) return 0;
    return (loop.counter->last - count->v[0]) / loop.counter->step;
  }
  TokenRange condition = loop.range, body = loop.range;
  condition.end = body.begin = loop.range.begin + condition_length(loop.range);
  const std::optional<Values> values = dependencies(session, condition);
  return values && !Search(session, *values).may_end(body) ? std::numeric_limits<double>::infinity() : 0;
}

} // namespace celltrace::pov
