// Constructs of POV-Ray that this program lacks: they may be declared, and are an error where an object uses
// them.
#pragma once

#include <memory>
#include <string>

#include "pov/location.hpp"

namespace celltrace::pov {

/// A construct this program does not support, and where it stands.
struct Unsupported {
  std::string what;
  Location where;
};
using UnsupportedPtr = std::shared_ptr<const Unsupported>;

/// Keeps the first of several.
inline void mark(UnsupportedPtr& mark, const UnsupportedPtr& unsupported) {
  if (!mark) mark = unsupported;
}

} // namespace celltrace::pov
