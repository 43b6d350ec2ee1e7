// TokenStream: files that a scene reads and writes itself with #fopen, #read, #write and #fclose.
#include "pov/data_files.hpp"

#include <algorithm>

#include "celltrace/error.hpp"
#include "pov/session.hpp"
#include "pov/token_stream.hpp"

namespace celltrace::pov {

// ---- Reading ----

DataFile::DataFile(Session& session, const Location& opened_at, std::string text, const std::string& name)
    : session_(session), opened_at_(opened_at), name_(name),
      scanner_(std::make_unique<Scanner>(
          std::move(text), session.sources.number_of(name), session.names,
          [&session](const Location& where, const std::string& what) { session.fail(where, what); })) {
}

DataFile::DataFile(Session& session, const Location& opened_at, const std::filesystem::path& path,
                   const std::string& name, bool append)
    : session_(session), opened_at_(opened_at), name_(name),
      writer_(std::make_unique<TextWriter>(path, append)) {
}

Token DataFile::next() {
  if (put_back_.empty()) return scanner_->next();
  const Token token = put_back_.back();
  put_back_.pop_back();
  return token;
}

/// Values stand between commas. POV-Ray skips whatever stands in place of a comma.
bool DataFile::pass_over_comma() {
  const Token token = next();
  if (token.kind == Token::Kind::vector) {
    // Only the < of a vector stands there; its other tokens are still to be read.
    Token part = token;
    part.kind = Token::Kind::punctuation;
    for (int i = 2; i >= 0; --i) {
      part.symbol = i == 2 ? '>' : ',';
      put_back_.push_back(part);
      Token number = token;
      number.kind = Token::Kind::number;
      number.number[0] = token.number[i];
      put_back_.push_back(number);
    }
  }
  return token.kind != Token::Kind::end;
}

std::optional<double> DataFile::signed_number(const Token& first) {
  double sign = 1;
  Token token = first;
  if (token.is('-') || token.is('+')) {
    if (token.is('-')) sign = -1;
    token = next();
  }
  if (token.kind != Token::Kind::number) return std::nullopt;
  return sign * token.number[0];
}

Quantity DataFile::rest_of_vector(const Location& where) {
  Quantity vector;
  for (vector.count = 0; vector.count < 5;) {
    Token token = next();
    if (token.is('>')) break;
    const std::optional<double> number = signed_number(token);
    if (!number) session_.fail(token.where, "expected a number");
    vector.v[static_cast<std::size_t>(vector.count++)] = *number;
    token = next();
    if (!token.is(',')) put_back_.push_back(token);
  }
  if (vector.count == 5 && !next().is('>')) session_.fail(where, "a vector has at most five components");
  if (vector.count < 2) session_.fail(where, "a vector has at least two components");
  return vector;
}

std::optional<Value> DataFile::read() {
  const Token token = next();
  if (token.kind == Token::Kind::end) return std::nullopt;
  if (token.kind == Token::Kind::string) return session_.tokens.text_of(token);
  if (token.kind == Token::Kind::vector)
    return Quantity::vector({token.number[0], token.number[1], token.number[2]});
  if (token.is('<')) return rest_of_vector(token.where);
  if (const std::optional<double> number = signed_number(token)) return Quantity(*number);
  session_.fail(token.where, "expected a number, a vector or a string");
}

// ---- The directives ----

void TokenStream::open_data_file() {
  const Token name = expect_name("for a file");
  const std::shared_ptr<Slot> known = session_.symbols.find(name.name);
  if (known && !std::holds_alternative<std::monostate>(known->value))
    session_.fail(name.where,
                  "'" + session_.names.text(name.name) + "' is " + kind_name(known->value) + " already");
  Location where;
  const std::string wanted = read_file_name(where);
  const Token mode = read();
  const std::string& access = mode.kind == Token::Kind::word ? session_.names.text(mode.name) : std::string();
  if (access != "read" && access != "write" && access != "append")
    session_.fail(mode.where, "expected 'read', 'write' or 'append'");
  if (session_.data_files.size() >= session_.options.limits.open_files)
    session_.exceed(where, &ParseLimits::open_files, "#fopen keeps", "files open");
  std::shared_ptr<DataFile> file;
  if (access == "read") {
    auto [path, text] = read_file("file", wanted, where);
    file = std::make_shared<DataFile>(session_, where, std::move(text), path.lexically_normal().string());
  } else {
    try {
      file = std::make_shared<DataFile>(session_, where, session_.sources.writable_file(wanted), wanted,
                                        access == "append");
    } catch (const InputError& error) {
      session_.fail(where, "file " + quoted_name(wanted) + ": " + error.what());
    }
  }
  session_.data_files.push_back(file);
  session_.symbols.declare(name.name, std::move(file));
}

std::shared_ptr<DataFile> TokenStream::expect_data_file(Token& name) {
  name = expect_name("of a file");
  const std::shared_ptr<Slot> slot = session_.symbols.find(name.name);
  const auto* file = slot ? std::get_if<std::shared_ptr<DataFile>>(&slot->value) : nullptr;
  if (!file)
    session_.fail(name.where, "'" + session_.names.text(name.name) + "' is no file that #fopen has opened");
  return *file;
}

void TokenStream::forget_data_file(const std::shared_ptr<DataFile>& file, NameId name) {
  auto& open = session_.data_files;
  open.erase(std::remove(open.begin(), open.end(), file), open.end());
  session_.symbols.declare(name, std::monostate());
}

/// Closes a file. As in POV-Ray, a file that is not open is ignored, since reading to the end closes a file.
void TokenStream::close_data_file() {
  const Token name = expect_name("of a file");
  const std::shared_ptr<Slot> slot = session_.symbols.find(name.name);
  if (!slot || std::holds_alternative<std::monostate>(slot->value)) return;
  const auto* held = std::get_if<std::shared_ptr<DataFile>>(&slot->value);
  if (!held)
    session_.fail(name.where, "'" + session_.names.text(name.name) + "' is no file that #fopen has opened");
  const std::shared_ptr<DataFile> file = *held;
  forget_data_file(file, name.name);
  file->close(name.where);
}

/// Reads values into names. At the end of the file, the file's name becomes undeclared, and the remaining
/// names stay as they are.
void TokenStream::read_data() {
  expect('(', "after #read");
  Token name;
  const std::shared_ptr<DataFile> file = expect_data_file(name);
  if (!file->is_read())
    session_.fail(name.where,
                  "'" + session_.names.text(name.name) + "' is open for writing, not for reading");
  bool at_end = false;
  for (Token token = read(); !token.is(')'); token = read()) {
    if (token.is(',')) continue;
    session_.input.unread(token);
    const Token target = expect_name("to read into");
    const std::vector<std::size_t> subscripts = read_subscripts();
    if (at_end) continue;
    std::optional<Value> value = file->read();
    at_end = !value || !file->pass_over_comma();
    if (at_end) forget_data_file(file, name.name);
    if (!value) continue;
    if (const auto* text = std::get_if<std::string>(&*value)) session_.count_text(text->size(), target.where);
    const std::shared_ptr<Slot> slot = session_.symbols.find(target.name);
    if (!slot) {
      if (!subscripts.empty())
        session_.fail(target.where, "'" + session_.names.text(target.name) + "' is not declared");
      session_.symbols.declare(target.name, std::move(*value));
      continue;
    }
    Value& old = element(slot->value, subscripts, target.where);
    if (!std::holds_alternative<std::monostate>(old) && !std::holds_alternative<Quantity>(old) &&
        !std::holds_alternative<std::string>(old))
      session_.fail(target.where, "'" + session_.names.text(target.name) + "' is " + kind_name(old) +
                                      ": #read gives numbers, vectors and strings");
    old = std::move(*value);
  }
}

std::string TokenStream::data_text(const Value& value, const Location& where) const {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  const auto* quantity = std::get_if<Quantity>(&value);
  if (!quantity)
    session_.fail(where, std::string("#write takes numbers, vectors and strings, not ") + kind_name(value));
  if (!quantity->is_finite()) session_.fail(where, "this number is not finite");
  if (quantity->is_float()) return short_text(quantity->v[0]);
  std::string text;
  for (int i = 0; i < quantity->count; ++i) {
    text += i == 0 ? '<' : ',';
    text += short_text(quantity->v[static_cast<std::size_t>(i)]);
  }
  text += "> ";
  return text;
}

void TokenStream::write_data() {
  expect('(', "after #write");
  Token name;
  const std::shared_ptr<DataFile> file = expect_data_file(name);
  if (file->is_read())
    session_.fail(name.where,
                  "'" + session_.names.text(name.name) + "' is open for reading, not for writing");
  for (Token token = read(); !token.is(')'); token = read()) {
    if (token.is(',')) continue;
    session_.input.unread(token);
    const std::string text = data_text(evaluate(Start::value), token.where);
    session_.written_bytes += text.size();
    if (session_.written_bytes > session_.options.limits.written_bytes)
      session_.exceed(token.where, &ParseLimits::written_bytes, "the scene writes", "bytes to files");
    session_.count_text(0, token.where);
    file->write(text, token.where);
  }
}

void TokenStream::close_data_files() {
  while (!session_.data_files.empty()) {
    const std::shared_ptr<DataFile> file = session_.data_files.back();
    session_.data_files.pop_back();
    file->close(file->opened_at());
  }
}

void DataFile::write(std::string_view text, const Location& where) {
  try {
    writer_->write(text);
  } catch (const InputError& error) {
    session_.fail(where, "file " + quoted_name(name_) + ": " + error.what());
  }
}

void DataFile::close(const Location& where) {
  if (!writer_) return;
  try {
    writer_->close();
  } catch (const InputError& error) {
    session_.fail(where, "file " + quoted_name(name_) + ": " + error.what());
  }
}

} // namespace celltrace::pov
