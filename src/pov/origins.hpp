// Tells an application where in the text the objects of a scene come from.
#pragma once

#include "celltrace/pov.hpp"
#include "pov/location.hpp"
#include "pov/names.hpp"

#include <memory>

namespace celltrace::pov {

class Sources;
struct ObjectDefinition;

class Origins {
public:
  Origins(const ParseOptions& options, const Names& names, const Sources& sources)
      : options_(options), names_(names), sources_(sources) {}

  bool are_wanted() const { return static_cast<bool>(options_.places_object); }
  /// Calls the application's function. `around` is the name of the innermost named object around the object,
  /// and `placed` the place where the scene places it.
  void tell(Index index, const ObjectDefinition& object, NameId around, const Location& placed) const;

private:
  const ParseOptions& options_;
  const Names& names_;
  const Sources& sources_;
};

/// Returns a copy of the object that has the name under which it is declared.
std::shared_ptr<const ObjectDefinition> named(const std::shared_ptr<const ObjectDefinition>& object,
                                              NameId name);

} // namespace celltrace::pov
