// What the parser's tests share.
#pragma once

#include <string>
#include <string_view>

#include "celltrace/pov.hpp"

namespace celltrace::test {

inline Scene parse(std::string_view text, const ParseOptions& options = {}) {
  return parse_string(text, options, "scene.pov");
}

/// What the scene says with #debug and the like.
inline std::string output(std::string_view text, ParseOptions options = {}) {
  std::string said;
  options.message = [&said](std::string_view message) { said += message; };
  parse(text, options);
  return said;
}

/// The value of an expression as #debug prints it, with three digits.
inline std::string value(const std::string& expression) {
  return output("#debug str(" + expression + ", 0, 3)");
}

/// The same for a vector or colour of `count` components.
inline std::string value(int count, const std::string& expression) {
  return output("#debug vstr(" + std::to_string(count) + ", " + expression + ", \" \", 0, 2)");
}

/// The error a scene is refused with, or nothing.
inline std::string error(std::string_view text, const ParseOptions& options = {}) {
  try {
    ParseOptions quiet = options;
    quiet.message = [](std::string_view) {};
    parse(text, quiet);
  } catch (const SceneError& e) {
    return e.what();
  }
  return {};
}

/// Its first line.
inline std::string error_line(std::string_view text, const ParseOptions& options = {}) {
  const std::string all = error(text, options);
  return all.substr(0, all.find('\n'));
}

} // namespace celltrace::test
