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
  /// To be read: `text` is what is in it.
  DataFile(Session& session, const Location& opened_at, std::string text, const std::string& name);
  /// To be written. Throws InputError if it cannot be.
  DataFile(Session& session, const Location& opened_at, const std::filesystem::path& path,
           const std::string& name, bool append);

  const Location& opened_at() const { return opened_at_; }
  bool is_read() const { return scanner_ != nullptr; }

  /// The next number, vector or string; nothing at the end.
  std::optional<Value> read();
  /// Behind a value. False at the end.
  bool pass_over_comma();

  // Faults are the scene's, at `where`.
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
  std::vector<Token> put_back_; ///< the next one last
  std::unique_ptr<TextWriter> writer_;
};

} // namespace celltrace::pov
