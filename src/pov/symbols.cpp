#include "pov/symbols.hpp"

namespace celltrace::pov {

std::vector<Symbols::Binding>& Symbols::bindings(NameId name) {
  if (name >= bindings_.size()) bindings_.resize(name + 1);
  return bindings_[name];
}

std::shared_ptr<Slot> Symbols::find(NameId name) const {
  if (name >= bindings_.size() || bindings_[name].empty()) return nullptr;
  return bindings_[name].back().slot;
}

const Value* Symbols::value_of(NameId name) const {
  if (name >= bindings_.size() || bindings_[name].empty()) return nullptr;
  return &bindings_[name].back().slot->value;
}

void Symbols::declare(NameId name, Value value) {
  auto& visible = bindings(name);
  if (visible.empty())
    visible.push_back({0, std::make_shared<Slot>(Slot{std::move(value)})});
  else
    visible.back().slot->value = std::move(value);
}

void Symbols::declare_local(NameId name, Value value) {
  auto& visible = bindings(name);
  if (!visible.empty() && visible.back().level == scopes_.size() - 1)
    visible.back().slot->value = std::move(value);
  else
    bind(name, std::make_shared<Slot>(Slot{std::move(value)}));
}

void Symbols::bind(NameId name, std::shared_ptr<Slot> slot) {
  bindings(name).push_back({scopes_.size() - 1, std::move(slot)});
  scopes_.back().push_back(name);
}

void Symbols::undefine(NameId name) {
  auto& visible = bindings(name);
  if (!visible.empty()) visible.pop_back();
}

void Symbols::leave_scope() {
  const std::size_t level = scopes_.size() - 1;
  for (const NameId name : scopes_.back()) {
    auto& visible = bindings(name);
    if (!visible.empty() && visible.back().level == level) visible.pop_back();
  }
  scopes_.pop_back();
}

} // namespace celltrace::pov
