#include "pov/names.hpp"

#include "pov/reserved_words.hpp"

namespace celltrace::pov {

bool opens_block(Directive directive) {
  switch (directive) {
  case Directive::if_:
  case Directive::ifdef:
  case Directive::ifndef:
  case Directive::switch_:
  case Directive::while_:
  case Directive::for_:
  case Directive::macro:
    return true;
  default:
    return false;
  }
}

Names::Names() {
  const Meanings* const* meanings = reserved_meanings().data();
  for (const ReservedWord& word : reserved_words()) {
    Entry& entry = entries_[intern(word.text)];
    entry.token = word.token;
    entry.detail = word.detail;
    entry.is_unsupported = word.is_unsupported;
    entry.in_blocks = *meanings++;
  }
}

bool Names::is_reserved(std::string_view text) const {
  const auto known = numbers_.find(text);
  return known != numbers_.end() && entries_[known->second].token != 0;
}

NameId Names::intern(std::string_view text) {
  if (const auto known = numbers_.find(text); known != numbers_.end()) return known->second;
  Entry& entry = entries_.emplace_back();
  entry.text = text;
  entry.component = component_of(text);
  entry.directive = directive_of(text);
  const auto number = static_cast<NameId>(entries_.size() - 1);
  numbers_.emplace(entry.text, number);
  return number;
}

} // namespace celltrace::pov
