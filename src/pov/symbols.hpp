// The names a scene declares, with dynamic scope: a macro sees its callers' locals.
#pragma once

#include <memory>
#include <vector>

#include "pov/value.hpp"

namespace celltrace::pov {

class Symbols {
public:
  /// Returns the slot of a name; null if the name is not declared.
  std::shared_ptr<Slot> find(NameId name) const;

  /// Returns the value of a name without sharing its slot: valid until something is declared.
  const Value* value_of(NameId name) const;

  /// Writes to the innermost visible binding, or makes a global one.
  void declare(NameId name, Value value);
  /// Writes to the binding in the current scope, or makes one there.
  void declare_local(NameId name, Value value);
  /// Makes `name` in the current scope another name of `slot`.
  void bind(NameId name, std::shared_ptr<Slot> slot);
  /// Removes the innermost binding, if any.
  void undefine(NameId name);

  void enter_scope() { scopes_.emplace_back(); }
  void leave_scope();

private:
  struct Binding {
    std::size_t level;
    std::shared_ptr<Slot> slot;
  };
  std::vector<Binding>& bindings(NameId name);

  std::vector<std::vector<Binding>> bindings_; // by name
  std::vector<std::vector<NameId>> scopes_{1}; // the names each scope has bound; the first is the global one
};

} // namespace celltrace::pov
