// Constructs of POV-Ray that this program lacks: they may be declared, but are an error, or left out
// (ParseOptions::lenient), if an object uses them.
#pragma once

#include <memory>
#include <string>

#include "pov/location.hpp"

namespace celltrace::pov {

struct Unsupported;
using UnsupportedPtr = std::shared_ptr<const Unsupported>;

/// A construct that this program does not support, and its place, in a list with others that belong to the
/// same thing.
struct Unsupported {
  std::string what;
  Location where;
  UnsupportedPtr others = nullptr; ///< other constructs in the list, in reverse order
};

/// Adds the constructs that are not in the list yet. The list is short: a scene does not have many different
/// ones.
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
