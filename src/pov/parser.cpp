// Connects the generated parser with the token stream and the diagnostics.
#include <algorithm>
#include <string>
#include <vector>

#include "pov/grammar.hpp"
#include "pov/nearest_word.hpp"
#include "pov/standard_includes.hpp"

namespace celltrace::pov {

namespace {

int start_token(Start start) {
  using token = Parser::token;
  switch (start) {
  case Start::scene:
    return token::T_START_SCENE;
  case Start::condition:
    return token::T_START_CONDITION;
  case Start::list:
    return token::T_START_LIST;
  case Start::expression:
    return token::T_START_EXPRESSION;
  case Start::text:
    return token::T_START_TEXT;
  case Start::value:
    return token::T_START_VALUE;
  case Start::defaults:
    return token::T_START_DEFAULTS;
  }
  return token::T_START_SCENE;
}

/// Gives the parser what a word says apart from its kind.
void deliver_word(Parser::semantic_type& target, const Terminal& terminal) {
  using token = Parser::token;
  switch (terminal.token) {
  case token::T_SPLINE_KIND:
  case token::T_FUNCTION:
  case token::T_TEXT_FUNCTION:
  case token::T_COMPONENT:
  case token::T_COLOUR_MODEL:
  case token::T_SRGB_MODEL:
  case token::T_CHANNEL:
  case token::T_SHAPE:
  case token::T_CSG:
  case token::T_CURVE_WORD:
  case token::T_PATTERN:
  case token::T_PICTURE:
  case token::T_ARGUED_PATTERN:
  case token::T_LIST_PATTERN:
  case token::T_CAMERA_KIND:
  case token::T_WORD_ITEM:
  case token::T_VALUE_ITEM:
  case token::T_OPTION_ITEM:
  case token::T_PAIR_ITEM:
  case token::T_SHARE_ITEM:
  case token::T_COLOUR_ITEM:
  case token::T_COLOUR_OR_BLACK_ITEM:
  case token::T_LIST_ITEM:
    target.emplace<int>(terminal.detail);
    break;
  case token::T_UNSUPPORTED:
  case token::T_UNSUPPORTED_ARGUMENT:
  case token::T_UNSUPPORTED_OBJECT:
  case token::T_UNSUPPORTED_BLOCK:
    target.emplace<NameId>(static_cast<NameId>(terminal.detail));
    break;
  default:
    break;
  }
}

/// Moves a terminal's value, of whatever type its token has, to the parser.
struct Deliver {
  Parser::semantic_type& target;

  void operator()(std::monostate) const {}
  void operator()(std::shared_ptr<const Macro>&) const {}
  void operator()(std::shared_ptr<DataFile>&) const {}
  template <class T> void operator()(T& value) const { target.emplace<T>(std::move(value)); }
};

bool expects(const Parser::symbol_kind_type* expected, int count, Parser::symbol_kind_type kind) {
  return std::find(expected, expected + count, kind) != expected + count;
}

} // namespace

int yylex(Parser::semantic_type* value, Location* where, Session& session) {
  if (const auto start = session.tokens.take_start()) return start_token(*start);
  Terminal terminal;
  session.tokens.next(terminal);
  *where = terminal.where;
  if (const auto* quantity = std::get_if<Quantity>(&terminal.value))
    value->emplace<Quantity>(*quantity); // the most frequent kind by far
  else if (std::holds_alternative<std::monostate>(terminal.value))
    deliver_word(*value, terminal);
  else if (auto* texture = std::get_if<TexturePtr>(&terminal.value)) // that of most objects
    value->emplace<TexturePtr>(std::move(*texture));
  else if (terminal.token == Parser::token::T_NAMED)
    value->emplace<Value>(std::move(terminal.value));
  else if (terminal.token == Parser::token::T_MISPLACED)
    return terminal.token;
  else
    std::visit(Deliver{*value}, terminal.value);
  return terminal.token;
}

namespace {

/// Returns a guess at the word that an undeclared name, in quotes, was meant to be.
std::string guess_at(const Session& session, const std::string& quoted) {
  const std::string name = quoted.substr(1, std::max<std::size_t>(quoted.size(), 2) - 2);
  if (const std::string include = include_that_declares(name); !include.empty())
    return ": #include \"" + include + "\" declares it";
  std::vector<std::string> known;
  for (NameId id = 0; id < session.names.size(); ++id)
    if (session.names[id].token != 0 || session.symbols.value_of(id) != nullptr)
      known.push_back(session.names.text(id));
  const std::string nearest = nearest_word(name, known);
  return nearest.empty() ? "" : ": '" + nearest + "' perhaps?";
}

} // namespace

void Parser::error(const Location& where, const std::string& message) {
  session.fail(where, message);
}

void Parser::report_syntax_error(const context& ctx) const {
  const Location& where = ctx.location();
  const std::string found = session.tokens.describe_last();
  switch (ctx.token()) {
  case symbol_kind::S_UNSUPPORTED:
    if (!session.names[session.tokens.last_token().name].is_unsupported) break; // but for this block
    session.fail(where, found + " is not supported yet");
  case symbol_kind::S_UNSUPPORTED_ARGUMENT:
  case symbol_kind::S_UNSUPPORTED_OBJECT:
  case symbol_kind::S_UNSUPPORTED_BLOCK:
    session.fail(where, found + " is not supported yet");
  case symbol_kind::S_UNSUPPORTED_ID:
    session.fail(where, found + " is not supported yet");
  case symbol_kind::S_UNDECLARED_ID:
    session.fail(where, found + " is not declared" + guess_at(session, found));
  default:
    break;
  }
  constexpr int kMost = 128;
  symbol_kind_type expected[kMost];
  const int count = ctx.expected_tokens(expected, kMost);
  std::string hint;
  // A quantity alone may only be there as the name of a colour.
  if (expects(expected, count, symbol_kind::S_FUNCTION))
    hint = ", expected a number";
  else if (expects(expected, count, symbol_kind::S_TEXT))
    hint = ", expected a string";
  else if (expects(expected, count, symbol_kind::S_YYEOF))
    hint = ", expected an object, the camera or a directive";
  else if (count == 1)
    hint = std::string(", expected ") + symbol_name(expected[0]);
  session.fail(where, "unexpected " + found + hint);
}

void run_grammar(Session& session, std::size_t depth) {
  // Keeps the parser for the next call, since its stack is costly to make.
  if (depth >= session.parsers.size()) session.parsers.resize(depth + 1);
  std::shared_ptr<Parser>& parser = session.parsers[depth];
  if (!parser) parser = std::make_shared<Parser>(session);
  std::shared_ptr<Parser>(parser)->parse();
}

} // namespace celltrace::pov
