// How a fault of the scene is reported.
#pragma once

#include <string>

#include "pov/input.hpp"
#include "pov/names.hpp"
#include "pov/sources.hpp"
#include "pov/texture.hpp"

namespace celltrace::pov {

class Diagnostics {
public:
  Diagnostics(const Sources& sources, const Names& names, const Input& input)
      : sources_(sources), names_(names), input_(input) {}

  /// "file:line:column"
  std::string place(const Location& where) const;

  /// Throws SceneError: the place, the text and how it was reached.
  [[noreturn]] void fail(const Location& where, const std::string& what) const;

  /// Throws SceneError if `unsupported` is not null: something at `used_at` needs it.
  void require_supported(const UnsupportedPtr& unsupported, const Location& used_at) const;

private:
  std::string stack() const;

  const Sources& sources_;
  const Names& names_;
  const Input& input_;
};

} // namespace celltrace::pov
