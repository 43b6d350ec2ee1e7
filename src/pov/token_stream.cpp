#include "pov/token_stream.hpp"

#include <algorithm>
#include <charconv>
#include <ctime>

#include "celltrace/error.hpp"
#include "memory/huge_pages.hpp"
#include "pov/blocks.hpp"
#include "pov/characters.hpp"
#include "pov/constants.hpp"
#include "pov/grammar.hpp"
#include "pov/session.hpp"

namespace celltrace::pov {

namespace {

using tokens = Parser::token;

/// The deepest nesting of directives that enter the grammar: each entry takes a part of the thread's stack.
constexpr std::size_t kMostLevels = 200;

constexpr std::uint64_t kTokensBetweenChecks = 1u << 13;
constexpr std::size_t kLiteralsAtOnce = 1u << 16;

int number_of(const Token& punctuation) {
  switch (punctuation.symbol) {
  case Token::kLessEqual:
    return tokens::T_LESS_EQUAL;
  case Token::kGreaterEqual:
    return tokens::T_GREATER_EQUAL;
  case Token::kNotEqual:
    return tokens::T_NOT_EQUAL;
  default:
    return punctuation.symbol;
  }
}

/// Returns whether a value can be complete after a terminal, so that a name next to it starts something new.
bool ends_operand(int terminal) {
  switch (terminal) {
  case tokens::T_QUANTITY:
  case tokens::T_TEXT:
  case tokens::T_NAMED:
  case tokens::T_PIGMENT_MAP_ID:
  case tokens::T_NORMAL_MAP_ID:
  case tokens::T_TEXTURE_MAP_ID:
  case tokens::T_SLOPE_MAP_ID:
  case tokens::T_TEXTURE_ID:
  case tokens::T_OBJECT_ID:
  case tokens::T_TRANSFORM_ID:
  case tokens::T_ARRAY_ID:
  case tokens::T_FUNCTION_ID:
  case tokens::T_SPLINE_ID:
  case tokens::T_UNSUPPORTED_ID:
  case tokens::T_COMPONENT:
  case ')':
  case ']':
  case '>':
  case '}':
    return true;
  default:
    return false;
  }
}

/// Returns whether a terminal, other than brackets, can be part of the arguments of a keyword.
bool is_argument(int terminal) {
  switch (terminal) {
  case tokens::T_QUANTITY:
  case tokens::T_TEXT:
  case tokens::T_COMPONENT:
  case tokens::T_FUNCTION:
  case tokens::T_TEXT_FUNCTION:
  case tokens::T_DIMENSIONS:
  case tokens::T_DIMENSION_SIZE:
  case tokens::T_COLOUR:
  case tokens::T_COLOUR_MODEL:
  case tokens::T_SRGB:
  case tokens::T_SRGB_MODEL:
  case tokens::T_CHANNEL:
  case tokens::T_LESS_EQUAL:
  case tokens::T_GREATER_EQUAL:
  case tokens::T_NOT_EQUAL:
  case tokens::T_UNSUPPORTED_ARGUMENT:
    return true;
  default:
    return terminal > 0 && terminal < 256; // single characters
  }
}

/// Returns the processor time of this thread in seconds, from an arbitrary start.
double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::string describe_character(unsigned code) {
  static constexpr char kDigits[] = "0123456789ABCDEF";
  if (code > 32 && code < 127) return std::string("character '") + static_cast<char>(code) + "'";
  return std::string("character 0x") + kDigits[code / 16 % 16] + kDigits[code % 16];
}

bool opens(const Token& token) {
  return token.is('(') || token.is('{') || token.is('[');
}
bool closes(const Token& token) {
  return token.is(')') || token.is('}') || token.is(']');
}

constexpr std::size_t kCodeDigits = 4; // after \u

/// Returns the character code written in hexadecimal; nothing if there are too few digits.
std::optional<unsigned> code_at(const std::string& text, std::size_t begin) {
  unsigned code = 0;
  if (text.size() < begin + kCodeDigits) return std::nullopt;
  const char* const first = text.data() + begin;
  const auto [end, error] = std::from_chars(first, first + kCodeDigits, code, 16);
  return error == std::errc() && end == first + kCodeDigits ? std::optional(code) : std::nullopt;
}

std::string without_escapes(const std::string& quoted) {
  std::string text;
  for (std::size_t i = 0; i < quoted.size(); ++i) {
    if (quoted[i] != '\\' || i + 1 == quoted.size()) {
      text += quoted[i];
      continue;
    }
    const char escaped = quoted[++i];
    if (const std::optional<unsigned> code = escaped == 'u' ? code_at(quoted, i + 1) : std::nullopt) {
      text += character(*code);
      i += kCodeDigits;
      continue;
    }
    static constexpr char kLetters[] = "abfnrtv";
    static constexpr char kMeanings[] = "\a\b\f\n\r\t\v";
    const char* letter = std::find(kLetters, kLetters + 7, escaped);
    text += letter != kLetters + 7 ? kMeanings[letter - kLetters] : escaped;
  }
  return text;
}

struct TokenOf {
  int operator()(std::monostate) const { return tokens::T_UNDECLARED_ID; }
  int operator()(const Quantity&) const { return tokens::T_QUANTITY; }
  int operator()(const std::string&) const { return tokens::T_TEXT; }
  int operator()(const PigmentPtr&) const { return tokens::T_NAMED; }
  int operator()(const NormalPtr&) const { return tokens::T_NAMED; }
  int operator()(const PigmentMapPtr&) const { return tokens::T_PIGMENT_MAP_ID; }
  int operator()(const NormalMapPtr&) const { return tokens::T_NORMAL_MAP_ID; }
  int operator()(const TextureMapPtr&) const { return tokens::T_TEXTURE_MAP_ID; }
  int operator()(const SlopeMapPtr&) const { return tokens::T_SLOPE_MAP_ID; }
  int operator()(const SkySpherePtr&) const { return tokens::T_NAMED; }
  int operator()(const FogPtr&) const { return tokens::T_NAMED; }
  int operator()(const RainbowPtr&) const { return tokens::T_NAMED; }
  int operator()(const FinishPtr&) const { return tokens::T_NAMED; }
  int operator()(const TexturePtr&) const { return tokens::T_TEXTURE_ID; }
  int operator()(const InteriorPtr&) const { return tokens::T_NAMED; }
  int operator()(const std::shared_ptr<const MaterialDefinition>&) const { return tokens::T_NAMED; }
  int operator()(const std::shared_ptr<const CameraDefinition>&) const { return tokens::T_NAMED; }
  int operator()(const ObjectPtr&) const { return tokens::T_OBJECT_ID; }
  int operator()(const Transform&) const { return tokens::T_TRANSFORM_ID; }
  int operator()(const std::shared_ptr<Array>&) const { return tokens::T_ARRAY_ID; }
  int operator()(const std::shared_ptr<const Macro>&) const { return tokens::T_UNDECLARED_ID; }
  int operator()(const std::shared_ptr<DataFile>&) const { return tokens::T_UNDECLARED_ID; }
  int operator()(const UnsupportedPtr&) const { return tokens::T_UNSUPPORTED_ID; }
  int operator()(const FunctionPtr&) const { return tokens::T_FUNCTION_ID; }
  int operator()(const SplinePtr&) const { return tokens::T_SPLINE_ID; }
};

} // namespace

TokenStream::TokenStream(Session& session) : session_(session), started_(processor_seconds()) {
}

void TokenStream::open(std::string text, const std::string& name, std::filesystem::path folder) {
  const std::uint32_t file = session_.sources.number_of(name);
  Frame frame;
  frame.opened_at.file = file;
  frame.folder = std::move(folder);
  frame.scanner = std::make_unique<Scanner>(
      std::move(text), file, session_.names,
      [this](const Location& where, const std::string& what) { session_.fail(where, what); });
  session_.input.push(std::move(frame));
}

const std::filesystem::path& TokenStream::current_folder() const {
  const auto& frames = session_.input.frames();
  const auto file =
      std::find_if(frames.rbegin(), frames.rend(), [](const Frame& f) { return f.scanner != nullptr; });
  return file->folder;
}

Value TokenStream::evaluate(Start start) {
  if (const std::optional<Quantity> value = replay_value(start)) return *value;
  if (levels_.size() >= kMostLevels) session_.fail(here(), "macros and directives are nested too deeply");
  Level& level = levels_.emplace_back();
  level.start = start;
  level.base_depth = start == Start::scene ? 1 : session_.input.depth(); // a header lies on top of the scene
  run_grammar(session_, levels_.size() - 1);
  Level finished = std::move(levels_.back());
  levels_.pop_back();
  if (finished.hands_back && !finished.at_end) session_.input.unread(finished.last_token);
  leave_finished_macros(finished.base_depth);
  return std::move(finished.result);
}

/// Leaves macros that end with a value: only directives can follow there, such as the other branches of an
/// #if, and the tokens after the call continue where the value began.
void TokenStream::leave_finished_macros(std::size_t depth) {
  while (session_.input.depth() > depth) {
    const Token token = read();
    if (token.kind == Token::Kind::directive) {
      obey(token);
    } else if (token.kind != Token::Kind::end) {
      return session_.input.unread(token);
    } else if (!leave_frame_at_end()) {
      return;
    }
  }
}

void TokenStream::finish(Value value, bool has_lookahead) {
  levels_.back().result = std::move(value);
  levels_.back().hands_back = has_lookahead;
}

bool TokenStream::is_inside_value() const {
  const Level& level = levels_.back();
  return level.start != Start::scene && level.any_delivered && level.enclosing.empty() && level.nesting == 0;
}

Token TokenStream::read() {
  if (++tokens_read_ + work_ > next_check_) check_limits();
  Token token = session_.input.read();
  if (token.kind == Token::Kind::directive && is_plain_word(token)) token.kind = Token::Kind::word;
  return token;
}

/// Returns whether a word behind a # has a meaning, but not as a directive: people write #object{...}.
bool TokenStream::is_plain_word(const Token& directive) const {
  const Names::Entry& name = session_.names[directive.name];
  return name.directive == Directive::none && (name.token != 0 || session_.symbols.find(directive.name));
}

/// Returns the current place in the text, for errors that belong to no single token.
const Location& TokenStream::here() const {
  const Frame& frame = session_.input.top();
  return frame.scanner ? last_place() : frame.opened_at;
}

std::pair<std::size_t, std::size_t> TokenStream::read_and_left() const {
  const Scanner& scene = *session_.input.frames().front().scanner;
  return {scene.offset(), scene.size() - scene.offset()};
}

/// Checks limits and progress; called once in a while.
void TokenStream::check_limits() {
  const ParseLimits& limits = session_.options.limits;
  if (tokens_read_ > limits.tokens)
    session_.exceed(here(), &ParseLimits::tokens, "the scene has", "tokens, with those that are repeated");
  if (processor_seconds() - started_ > static_cast<double>(limits.seconds))
    session_.exceed(here(), &ParseLimits::seconds, "reading the scene takes", "seconds");
  next_check_ = std::min(tokens_read_ + kTokensBetweenChecks, limits.tokens) + work_;
  const Scanner& scene = *session_.input.frames().front().scanner;
  const auto& progress = session_.options.progress;
  if (progress && !progress(scene.offset(), scene.size())) throw Cancelled();
}

void TokenStream::next(Terminal& terminal) {
  if (std::optional<Terminal>& put_back = levels_.back().put_back) {
    terminal = std::move(*put_back);
    put_back.reset();
    return;
  }
  for (;;) {
    Token token = read();
    if (token.is('<') && !levels_.back().after_operand) replay_vector(token);
    switch (token.kind) {
    case Token::Kind::end:
      if (!leave_frame_at_end()) {
        check_semicolon();
        return end_at(token, terminal);
      }
      if (skips_semicolon_ && skip_semicolon()) lacks_semicolon_.reset();
      if (!skips_semicolon_) check_semicolon();
      continue;
    case Token::Kind::directive:
      // A directive ends a value if the value can be complete, as in POV-Ray.
      if (is_inside_value() && levels_.back().after_operand) {
        session_.input.unread(token);
        return end_at(token, terminal);
      }
      obey(token);
      continue;
    case Token::Kind::word:
      if (is_inside_value() && levels_.back().after_operand && session_.names[token.name].token == 0) {
        session_.input.unread(token);
        return end_at(token, terminal);
      }
      if (look_up(token, terminal)) return deliver(token, terminal);
      continue;
    default:
      interpret(token, terminal);
      return deliver(token, terminal);
    }
  }
}

void TokenStream::end_at(const Token& token, Terminal& terminal) {
  levels_.back().at_end = true;
  levels_.back().last_token = token;
  terminal.where = token.where;
}

void TokenStream::deliver(const Token& token, Terminal& terminal) {
  if (token.kind == Token::Kind::punctuation) count_brackets(token);
  Level& level = levels_.back();
  level.any_delivered = true;
  level.after_operand = ends_operand(terminal.token);
  level.last_token = token;
  level.last_terminal = terminal.token;
  terminal.where = token.where;
}

/// Returns the block whose items can stand here.
Block TokenStream::block() const {
  const Level& level = levels_.back();
  if (!level.enclosing.empty()) return level.enclosing.back().block;
  return level.start == Start::scene ? Block::scene : Block::none;
}

/// < and ? count until the bracket around them closes, because they may or may not have a partner.
void TokenStream::count_brackets(const Token& token) {
  Level& level = levels_.back();
  if (opens(token)) {
    // An entry of a map is like what the map is for.
    const Block inside = token.is('{') ? block_behind(level.last_terminal) : Block::none;
    level.enclosing.push_back({level.nesting, token.is('('), token.is('[') ? block() : inside});
    ++level.nesting;
  } else if (token.is('<') || token.is('?')) {
    ++level.nesting;
  } else if (token.is('>')) {
    const unsigned least = level.enclosing.empty() ? 0 : level.enclosing.back().outside + 1;
    if (level.nesting > least) --level.nesting;
  } else if (closes(token) && !level.enclosing.empty()) {
    level.nesting = level.enclosing.back().outside;
    level.enclosing.pop_back();
  }
  if (level.nesting > session_.options.limits.nesting)
    session_.exceed(token.where, &ParseLimits::nesting, "brackets are nested", "deep");
}

/// Returns whether a sign behind a value belongs to the next value, as before version 1.5: <0 1 -5> are three
/// numbers.
bool TokenStream::is_old_sign(const Token& token) const {
  if (!session_.builder.has_old_signs() || (!token.is('-') && !token.is('+'))) return false;
  const Level& level = levels_.back();
  if (!level.after_operand) return false;
  if (!level.enclosing.empty()) return !level.enclosing.back().is_parenthesis;
  return level.start == Start::scene || level.nesting > 0;
}

/// Sets the terminal of a token that needs no look-up.
void TokenStream::interpret(const Token& token, Terminal& terminal) const {
  switch (token.kind) {
  case Token::Kind::number:
    terminal.token = tokens::T_QUANTITY;
    terminal.value = literal_of(token);
    break;
  case Token::Kind::vector:
    terminal.token = tokens::T_QUANTITY;
    terminal.value = literal_of(token);
    break;
  case Token::Kind::string:
    terminal.token = tokens::T_TEXT;
    terminal.value = text_of(token);
    break;
  case Token::Kind::punctuation:
    if (is_old_sign(token))
      terminal.token = token.is('-') ? tokens::T_OLD_MINUS : tokens::T_OLD_PLUS;
    else
      terminal.token = number_of(token);
    break;
  case Token::Kind::component: {
    const Names::Entry& name = session_.names[token.name];
    if (name.component < 0)
      session_.fail(token.where, "'." + name.text + "' is no component of a vector or colour");
    terminal.token = tokens::T_COMPONENT;
    terminal.detail = name.component;
    break;
  }
  default:
    terminal.token = tokens::T_BAD_CHARACTER;
    break;
  }
}

/// Looks up a word. Returns false if the word was a macro, or a directive without its #, which has been
/// handled.
bool TokenStream::look_up(const Token& word, Terminal& terminal) {
  const Names::Entry& name = session_.names[word.name];
  if (name.token != 0) {
    const Names::Meaning& meaning = name.in(block());
    terminal.token = meaning.token;
    terminal.detail = meaning.detail;
    if (meaning.token == tokens::T_CONSTANT) {
      terminal.value = value_of(static_cast<Constant>(name.detail), session_);
      terminal.token = std::visit(TokenOf{}, terminal.value);
    } else if (meaning.token == tokens::T_DEFINED) {
      terminal.value = Quantity(is_defined() ? 1 : 0);
      terminal.token = tokens::T_QUANTITY;
    } else if (meaning.token == tokens::T_TEXTURE && session_.builder.has_old_textures()) {
      terminal.token = tokens::T_OLD_TEXTURE;
    } else if (name.is_unsupported || terminal.token == tokens::T_UNSUPPORTED) {
      terminal.detail = static_cast<int>(word.name);
    }
    return true;
  }
  const std::shared_ptr<Slot> slot = session_.symbols.find(word.name);
  if (!slot && (name.directive == Directive::declare || name.directive == Directive::include ||
                name.directive == Directive::default_)) {
    obey(word);
    return false;
  }
  if (slot && std::holds_alternative<std::shared_ptr<const Macro>>(slot->value)) {
    call(word, std::get<std::shared_ptr<const Macro>>(slot->value));
    return false;
  }
  if (slot) terminal.value = slot->value;
  if (std::holds_alternative<std::shared_ptr<Array>>(terminal.value)) {
    const std::vector<std::size_t> subscripts = read_subscripts();
    if (!subscripts.empty()) {
      const Value found = element(terminal.value, subscripts, word.where);
      if (std::holds_alternative<std::monostate>(found))
        session_.fail(word.where, "this element of '" + name.text + "' has no value yet");
      terminal.value = found;
    }
  }
  terminal.token = std::visit(TokenOf{}, terminal.value);
  if (terminal.token == tokens::T_NAMED && !takes(block(), terminal.value))
    terminal.token = tokens::T_MISPLACED;
  return true;
}

/// Reserves room for a long list, which begins with the number of its entries, so that it is not moved
/// repeatedly as it grows. The list has at most as many entries as the file has room for.
void TokenStream::make_room(std::vector<ListEntry>& list, const Scanner& scanner) {
  constexpr std::size_t kShortestEntry = 8; // <0,0,0>,
  const std::size_t most = (scanner.size() - scanner.offset()) / kShortestEntry;
  const double announced = list.front().is_float ? list.front().v.x : 0;
  if (!(announced > 0)) return;
  list.reserve(list.size() + static_cast<std::size_t>(std::min(announced, double(most))));
  use_huge_pages(list.data(), list.capacity() * sizeof(ListEntry));
}

void TokenStream::take_literals(std::vector<ListEntry>& list) {
  if (!session_.input.reads_file()) return;
  Scanner& scanner = *session_.input.top().scanner;
  const std::uint64_t limit = session_.options.limits.list_entries;
  for (std::size_t before = 0; scanner.take_literals(list, std::min(before + kLiteralsAtOnce, limit));
       before = list.size()) {
    tokens_read_ += 2 * (list.size() - before); // entries with their commas
    if (before == 0) make_room(list, scanner);
    check_limits();
  }
}

void TokenStream::take_arguments(std::vector<ShapeArgument>& arguments) {
  constexpr std::size_t kMostOfUsualShapes = 4;
  arguments.reserve(kMostOfUsualShapes);
  if (session_.input.reads_file()) {
    const std::uint64_t limit = session_.options.limits.list_entries;
    const std::uint64_t most = std::min<std::uint64_t>(limit, kLiteralsAtOnce); // so that it can be cancelled
    session_.input.top().scanner->take_arguments(arguments, most);
    tokens_read_ += 2 * arguments.size(); // arguments with their commas
  } else {
    replay_arguments(arguments);
  }
  if (arguments.empty()) return;
  Terminal taken;
  taken.token = tokens::T_ARGUMENTS;
  taken.where = arguments.front().where;
  levels_.back().put_back = std::move(taken);
}

void TokenStream::skip_to_depth(std::size_t depth) {
  const Location opened = last_place();
  while (levels_.back().enclosing.size() > depth) {
    Terminal terminal;
    next(terminal);
    if (terminal.token == 0) session_.fail(opened, "the block that starts here is never closed");
  }
}

void TokenStream::skip_arguments() {
  const std::size_t depth = levels_.back().enclosing.size();
  const Bracket bracket = levels_.back().enclosing.back();
  for (;;) {
    Terminal terminal;
    next(terminal);
    Level& level = levels_.back();
    if (level.enclosing.size() > depth) {
      skip_to_depth(depth);
    } else if (level.enclosing.size() < depth) {
      // Puts the closing brace back for the grammar.
      session_.input.unread(level.last_token);
      level.enclosing.push_back(bracket);
      level.nesting = bracket.outside + 1;
      return;
    } else if (!is_argument(terminal.token)) {
      level.put_back = std::move(terminal);
      return;
    }
  }
}

void TokenStream::skip_group() {
  const std::size_t depth = levels_.back().enclosing.size();
  const std::string keyword = describe_last();
  Terminal terminal;
  next(terminal);
  if (terminal.token == '(') {
    skip_to_depth(depth);
    terminal = {};
    next(terminal);
  }
  if (terminal.token != '{') session_.fail(terminal.where, "expected '{' after " + keyword);
  skip_to_depth(depth);
}

std::string TokenStream::text_of(const Token& string) const {
  return without_escapes(session_.names.text(string.name));
}

void TokenStream::unread_last() {
  session_.input.unread(last_token());
}

std::string TokenStream::describe_last() const {
  const Token& token = levels_.back().last_token;
  switch (token.kind) {
  case Token::Kind::end:
    return levels_.back().start == Start::scene ? "end of the scene" : "end of the text";
  case Token::Kind::directive:
    return "'#" + session_.names.text(token.name) + "'";
  case Token::Kind::word:
  case Token::Kind::component:
    return "'" + session_.names.text(token.name) + "'";
  case Token::Kind::string:
    return "string";
  case Token::Kind::number:
    return "number";
  case Token::Kind::vector:
    return "vector";
  case Token::Kind::bad_character:
    return describe_character(token.symbol);
  case Token::Kind::punctuation:
    break;
  }
  switch (token.symbol) {
  case Token::kLessEqual:
    return "'<='";
  case Token::kGreaterEqual:
    return "'>='";
  case Token::kNotEqual:
    return "'!='";
  default:
    return std::string("'") + static_cast<char>(token.symbol) + "'";
  }
}

} // namespace celltrace::pov
