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

/// The material of a sphere with these modifiers, after what stands `before` it.
inline Material material(const std::string& modifiers, const std::string& before = "") {
  const Scene scene = parse(before + "sphere { 0, 1 " + modifiers + " }");
  return scene.materials.at(scene.objects.at(0).material);
}

inline std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i)
    all += text;
  return all;
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
