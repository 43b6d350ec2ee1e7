#include "viewer/object_names.hpp"

namespace celltrace::viewer {

std::uint32_t ObjectNames::number_of(std::string_view text) {
  const auto [known, is_new] =
      numbers_.try_emplace(std::string(text), static_cast<std::uint32_t>(texts_.size()));
  if (is_new) texts_.emplace_back(text);
  return known->second;
}

void ObjectNames::add(Index object, const ObjectOrigin& origin) {
  if (object != entries_.size()) return; // objects out of order get no name
  entries_.push_back({origin.kind.data(), number_of(origin.name), number_of(origin.file), origin.line,
                      number_of(origin.placed_file), origin.placed_line});
}

ObjectNames::Place ObjectNames::written(Index object) const {
  const std::string_view file = texts_[entries_[object].file];
  return {file.substr(file.rfind('/') + 1), entries_[object].line};
}

ObjectNames::Place ObjectNames::placed(Index object) const {
  const std::string_view file = texts_[entries_[object].placed_file];
  return {file.substr(file.rfind('/') + 1), entries_[object].placed_line};
}

std::string ObjectNames::describe(Index object) const {
  if (!contains(object)) return "object " + std::to_string(object);
  const auto text_of = [](const Place& place) {
    return std::string(place.file) + ':' + std::to_string(place.line);
  };
  std::string text = kind(object);
  if (!name(object).empty()) text += " '" + name(object) + "'";
  const std::string where = text_of(written(object)), by = text_of(placed(object));
  text += " at " + where;
  if (by != where) text += ", placed at " + by;
  return text;
}

} // namespace celltrace::viewer
