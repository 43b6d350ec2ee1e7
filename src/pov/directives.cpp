// TokenStream: directives that define names, include files and print messages.
#include <algorithm>
#include <cmath>

#include "celltrace/error.hpp"
#include "pov/actions.hpp"
#include "pov/session.hpp"
#include "pov/standard_includes.hpp"
#include "pov/token_stream.hpp"

namespace celltrace::pov {

namespace {

/// Returns whether the name of a file ends as the scene has spelled it; case counts, the kind of slashes does
/// not.
bool is_spelled(const std::string& path, const std::string& wanted) {
  return path.ends_with(portable_path(wanted).filename().string());
}

} // namespace

void TokenStream::obey(const Token& directive) {
  const Directive kind = session_.names[directive.name].directive;
  switch (kind) {
  case Directive::declare:
  case Directive::local:
    return declare(kind == Directive::local);
  case Directive::undef:
    return undefine();
  case Directive::version:
    return set_version(directive);
  case Directive::include:
    return include(directive);
  case Directive::default_:
    evaluate(Start::defaults);
    return;
  case Directive::debug:
  case Directive::render:
  case Directive::statistics:
  case Directive::warning:
  case Directive::error:
    return show(directive, kind);
  case Directive::if_:
    return obey_if(directive, condition(directive.where));
  case Directive::ifdef:
    return obey_if(directive, is_defined());
  case Directive::ifndef:
    return obey_if(directive, !is_defined());
  case Directive::switch_:
    return obey_switch(directive);
  case Directive::else_:
  case Directive::elseif:
    return obey_else(directive, kind);
  case Directive::case_:
  case Directive::range:
    return obey_case(directive);
  case Directive::end:
    return obey_end(directive);
  case Directive::break_:
    return obey_break(directive);
  case Directive::macro:
    return define_macro(directive);
  case Directive::while_:
    return start_while(directive);
  case Directive::for_:
    return start_for(directive);
  case Directive::fopen_:
    return open_data_file();
  case Directive::fclose_:
    return close_data_file();
  case Directive::read_:
    return read_data();
  case Directive::write_:
    return write_data();
  case Directive::unsupported:
    session_.fail(directive.where, "'#" + session_.names.text(directive.name) + "' is not supported yet");
  case Directive::none:
    session_.fail(directive.where, "there is no directive '#" + session_.names.text(directive.name) + "'");
  }
}

Token TokenStream::expect_name(const char* purpose) {
  const Token token = read();
  if (token.kind != Token::Kind::word) session_.fail(token.where, std::string("expected a name ") + purpose);
  if (session_.names[token.name].token != 0)
    session_.fail(token.where,
                  "'" + session_.names.text(token.name) + "' is a reserved word, not a name " + purpose);
  return token;
}

void TokenStream::expect(char punctuation, const char* purpose) {
  const Token token = read();
  if (!token.is(punctuation))
    session_.fail(token.where, std::string("expected '") + punctuation + "' " + purpose);
}

/// Skips a semicolon if there is one, and returns whether there was. The semicolon of a file's last
/// declaration may also stand behind the #include: people write #include "file.inc";
bool TokenStream::skip_semicolon() {
  const Token token = read();
  skips_semicolon_ = token.kind == Token::Kind::end;
  if (!skips_semicolon_ && !token.is(';')) session_.input.unread(token);
  return token.is(';');
}

/// Fails without a semicolon, which a declared number, vector or colour needs from version 3.5 on.
void TokenStream::expect_semicolon(const Token& declared) {
  if (skip_semicolon() || session_.builder.is_before(3.5)) return;
  lacks_semicolon_ = declared;
  if (!skips_semicolon_) check_semicolon();
}

void TokenStream::check_semicolon() const {
  if (lacks_semicolon_)
    session_.fail(lacks_semicolon_->where,
                  "'" + session_.names.text(lacks_semicolon_->name) +
                      "' needs a ';' behind its value, unless a #version below 3.5 comes first");
}

std::vector<std::size_t> TokenStream::read_subscripts() {
  std::vector<std::size_t> subscripts;
  for (;;) {
    const Token token = read();
    if (!token.is('[')) {
      if (token.kind != Token::Kind::end) session_.input.unread(token);
      return subscripts;
    }
    const double subscript = session_.number(std::get<Quantity>(evaluate(Start::expression)), token.where);
    if (!(subscript > -1 && subscript < 1e15)) session_.fail(token.where, "this subscript is out of range");
    subscripts.push_back(static_cast<std::size_t>(subscript));
    expect(']', "after a subscript");
  }
}

Value& TokenStream::element(Value& array, const std::vector<std::size_t>& subscripts, const Location& where) {
  Value* found = &array;
  for (const std::size_t subscript : subscripts) {
    auto* level = std::get_if<std::shared_ptr<Array>>(found);
    if (!level) session_.fail(where, "this is not an array with so many dimensions");
    if (subscript >= (*level)->elements.size())
      session_.fail(where, "subscript " + std::to_string(subscript) + " is out of range, the array has " +
                               std::to_string((*level)->elements.size()) + " elements");
    found = &(*level)->elements[subscript];
  }
  return *found;
}

/// Skips `deprecated once "message"` in front of a name.
void TokenStream::skip_deprecation() {
  const auto is_word = [this](const Token& token, std::string_view text) {
    return token.kind == Token::Kind::word && session_.names.text(token.name) == text;
  };
  Token token = read();
  if (is_word(token, "deprecated")) {
    token = read();
    if (is_word(token, "once")) token = read();
    if (token.kind == Token::Kind::string) token = read();
  }
  session_.input.unread(token);
}

void TokenStream::declare(bool is_local) {
  skip_deprecation();
  const Token name = expect_name("to declare");
  const std::vector<std::size_t> subscripts = read_subscripts();
  expect('=', "after the name to declare");
  const std::size_t depth = session_.input.depth();
  Value value = evaluate(Start::value);
  const bool has_semicolon = skip_semicolon();
  leave_finished_macros(depth); // a macro may end with the semicolon
  if (std::holds_alternative<Quantity>(value)) {
    if (has_semicolon)
      skip_semicolon(); // POV-Ray accepts two behind numbers
    else
      expect_semicolon(name);
  }
  if (const auto* text = std::get_if<std::string>(&value)) session_.count_text(text->size(), name.where);
  if (session_.origins.are_wanted())
    if (auto* object = std::get_if<ObjectPtr>(&value)) *object = named(*object, name.name);
  if (!subscripts.empty()) {
    const std::shared_ptr<Slot> slot = session_.symbols.find(name.name);
    if (!slot) session_.fail(name.where, "'" + session_.names.text(name.name) + "' is not declared");
    element(slot->value, subscripts, name.where) = std::move(value);
  } else if (is_local) {
    session_.symbols.declare_local(name.name, std::move(value));
  } else {
    session_.symbols.declare(name.name, std::move(value));
  }
}

/// Handles #undef of a name, or of an array's element, which then has no value.
void TokenStream::undefine() {
  const Token name = expect_name("to forget");
  const std::shared_ptr<Slot> slot = session_.symbols.find(name.name);
  if (slot && std::holds_alternative<std::shared_ptr<Array>>(slot->value)) {
    const std::vector<std::size_t> subscripts = read_subscripts();
    if (!subscripts.empty()) {
      Value& forgotten = element(slot->value, subscripts, name.where);
      if (std::holds_alternative<std::monostate>(forgotten))
        session_.fail(name.where,
                      "this element of '" + session_.names.text(name.name) + "' has no value to forget");
      forgotten = Value();
      return;
    }
  }
  session_.symbols.undefine(name.name);
}

/// Reads ( name ) with subscripts, for #ifdef and defined().
bool TokenStream::is_defined() {
  expect('(', "before a name");
  const Token name = read();
  if (name.kind != Token::Kind::word) session_.fail(name.where, "expected a name");
  const std::vector<std::size_t> subscripts = read_subscripts();
  expect(')', "after a name");
  if (session_.names[name.name].token != 0)
    return false; // as in POV-Ray, reserved words do not count as declared
  const std::shared_ptr<Slot> slot = session_.symbols.find(name.name);
  return slot && !std::holds_alternative<std::monostate>(element(slot->value, subscripts, name.where));
}

/// Handles #version; the number may follow `unofficial`, which patched versions of POV-Ray had.
void TokenStream::set_version(const Token& directive) {
  const Token first = read();
  if (first.kind != Token::Kind::word || session_.names.text(first.name) != "unofficial")
    session_.input.unread(first);
  const Location& where = directive.where;
  const double version = session_.number(std::get<Quantity>(evaluate(Start::expression)), where);
  skip_semicolon();
  constexpr double kNewest = 3.7;
  if (std::floor(version * 100 + 0.5) > kNewest * 100) {
    session_.fail(where,
                  "this scene needs version " + short_text(version) + " of POV-Ray's language, not 3.7");
  }
  session_.builder.set_version(version);
}

/// Reads the string behind a directive.
std::string TokenStream::read_file_name(Location& where) {
  const Token name = read();
  where = name.where;
  if (name.kind == Token::Kind::string)
    return session_.names.text(name.name); // backslashes of Windows paths are not escapes
  session_.input.unread(name);
  return std::get<std::string>(evaluate(Start::text));
}

void TokenStream::fail_to_find(const std::string& what, const std::string& wanted,
                               const Location& where) const {
  const std::filesystem::path name = portable_path(wanted);
  std::vector<std::string> details;
  if (name.is_relative())
    details.push_back("looked for in " + session_.sources.folders_searched(current_folder()) +
                      "; -L FOLDER adds a folder");
  if (is_standard_include(name.filename().string()))
    details.push_back(std::string("it comes with POV-Ray; on Debian it is in the package '") +
                      kStandardIncludesPackage + "'");
  session_.diagnostics.fail(where, "cannot find the " + what + ' ' + quoted_name(wanted), details);
}

/// Returns the path and the text of the file that the scene calls `wanted`.
std::pair<std::filesystem::path, std::string>
TokenStream::read_file(const std::string& what, const std::string& wanted, const Location& where) {
  if (session_.options.file) {
    const std::filesystem::path name = portable_path(wanted);
    if (std::optional<std::string> text = session_.options.file(name.string())) {
      if (text->size() > session_.options.limits.file_bytes)
        session_.fail(where, what + ' ' + quoted_name(wanted) + ": this file is larger than " +
                                 std::to_string(session_.options.limits.file_bytes) + " bytes");
      return {name, std::move(*text)};
    }
  }
  const auto file = session_.sources.find_file(wanted, current_folder());
  if (!file) fail_to_find(what, wanted, where);
  if (!file->may_be_read)
    session_.fail(where, what + ' ' + quoted_name(wanted) +
                             " lies outside of the scene's folder and the library path: --allow DIR lets the "
                             "scene read what is in a folder");
  if (session_.options.reads_file) session_.options.reads_file(file->path);
  try {
    return {file->path,
            read_text(file->path, session_.options.limits.file_bytes, [this] { check_limits(); })};
  } catch (const InputError& error) {
    session_.fail(where, what + ' ' + quoted_name(wanted) + ": " + error.what());
  }
}

std::string TokenStream::read_picture(const std::string& name, const Location& where) {
  if (portable_path(name).has_extension() || session_.sources.find_file(name, current_folder()))
    return read_file("picture", name, where).second;
  for (const char* extension : {".png", ".jpg", ".jpeg", ".tga", ".bmp", ".ppm"})
    if (session_.sources.find_file(name + extension, current_folder()))
      return read_file("picture", name + extension, where).second;
  return read_file("picture", name, where).second;
}

std::string TokenStream::read_font(const std::string& name, const Location& where) {
  const bool has_suffix = portable_path(name).has_extension() || session_.sources.find_file(name, current_folder());
  return read_file("font", has_suffix ? name : name + ".ttf", where).second;
}

void TokenStream::include(const Token& directive) {
  Location where;
  const std::string wanted = read_file_name(where);
  const auto& frames = session_.input.frames();
  const auto open_files =
      std::count_if(frames.begin(), frames.end(), [](const Frame& f) { return f.scanner != nullptr; });
  if (static_cast<std::uint64_t>(open_files) >= session_.options.limits.include_depth)
    session_.exceed(where, &ParseLimits::include_depth,
                    "does " + quoted_name(wanted) + " include itself? Files are included", "deep");
  auto [path, text] = read_file("include file", wanted, where);
  if (!is_spelled(path.string(), wanted))
    session_.diagnostics.note(where, "'" + wanted + "' is found as '" + path.string() + "'");
  session_.symbols.enter_scope();
  open(std::move(text), path.lexically_normal().string(), path.parent_path());
  session_.input.top().opened_at = directive.where;
}

void TokenStream::show(const Token& directive, Directive kind) {
  const std::string text = std::get<std::string>(evaluate(Start::text));
  if (kind == Directive::error) session_.fail(directive.where, text);
  const auto& message = session_.options.message;
  if (kind == Directive::warning) return session_.diagnostics.warn(directive.where, text);
  if (message) message(text);
}

} // namespace celltrace::pov
