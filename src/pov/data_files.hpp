// A file that a scene has opened with #fopen.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pov/scanner.hpp"
#include "pov/sources.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

struct Session;

class DataFile {
public:
  /// Opens a file for reading; `text` is its contents.
  DataFile(Session& session, const Location& opened_at, std::string text, const std::string& name);
  /// Opens a file for writing. Throws InputError if that fails.
  DataFile(Session& session, const Location& opened_at, const std::filesystem::path& path,
           const std::string& name, bool append);

  const Location& opened_at() const { return opened_at_; }
  bool is_read() const { return scanner_ != nullptr; }

  /// Reads the next number, vector or string; nothing at the end.
  std::optional<Value> read();
  /// Skips a comma behind a value. Returns false at the end.
  bool pass_over_comma();

  // Writes text; errors are reported as the scene's, at `where`.
  void write(std::string_view text, const Location& where);
  void close(const Location& where);

private:
  Token next();
  std::optional<double> signed_number(const Token& first);
  Quantity rest_of_vector(const Location& where);

  Session& session_;
  Location opened_at_;
  std::string name_;
  std::unique_ptr<Scanner> scanner_;
  std::vector<Token> put_back_; ///< tokens to be read next, in reverse order
  std::unique_ptr<TextWriter> writer_;
};

} // namespace celltrace::pov
