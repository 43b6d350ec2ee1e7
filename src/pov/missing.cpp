// Features that this program lacks.
#include "pov/actions.hpp"

namespace celltrace::pov {

std::string quoted(Session& session, NameId name) {
  return '\'' + session.names.text(name) + '\'';
}

std::string quoted_pattern(int pattern) {
  return '\'' + std::string(pattern_words()[static_cast<std::size_t>(pattern)].word) + '\'';
}

UnsupportedPtr make_unsupported(const std::string& what, const Location& where) {
  return std::make_shared<Unsupported>(Unsupported{what, where});
}

UnsupportedPtr unsupported_feature(Session& session, const std::string& what, const Location& where) {
  session.tokens.skip_arguments();
  return make_unsupported(what, where);
}

bool renders_media(const Session& session) {
  return session.options.quality >= 9;
}

UnsupportedPtr unsupported_block(Session& session, NameId word, const Location& where) {
  if (session.names.text(word) == "media" && !renders_media(session)) return nullptr;
  return make_unsupported(quoted(session, word), where);
}

UnsupportedPtr unless_zero(const std::string& what, double value, const Location& where) {
  return value == 0 ? nullptr : make_unsupported(what, where);
}

ObjectPtr unsupported_object(const std::string& what, const Location& where) {
  auto object = std::make_shared<ObjectDefinition>();
  object->missing = make_unsupported(what, where);
  return object;
}

} // namespace celltrace::pov
