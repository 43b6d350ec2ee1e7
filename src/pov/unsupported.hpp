// Constructs of POV-Ray that this program lacks: they may be declared, and are an error where an object uses
// them, or left out (ParseOptions::lenient).
#pragma once

#include <memory>
#include <string>

#include "pov/location.hpp"

namespace celltrace::pov {

struct Unsupported;
using UnsupportedPtr = std::shared_ptr<const Unsupported>;

/// A construct this program does not support, and where it stands; with others that belong to the same thing.
struct Unsupported {
  std::string what;
  Location where;
  UnsupportedPtr others = nullptr; ///< from the last to the first
};

/// Adds what is not mentioned yet. A scene does not have many different ones.
inline void mark(UnsupportedPtr& mark, const UnsupportedPtr& unsupported) {
  if (!mark) {
    mark = unsupported;
    return;
  }
  const auto mentions = [](const UnsupportedPtr& all, const std::string& what) {
    const Unsupported* one = all.get();
    while (one && one->what != what)
      one = one->others.get();
    return one != nullptr;
  };
  for (const Unsupported* one = unsupported.get(); one; one = one->others.get())
    if (!mentions(mark, one->what))
      mark = std::make_shared<const Unsupported>(Unsupported{one->what, one->where, mark});
}

} // namespace celltrace::pov
