#include "python/misfit.hpp"

#include <algorithm>
#include <vector>

namespace celltrace {

namespace {

/// Returns the names in "a, b=(1, 2), *, c=None", without self and the star.
std::vector<std::string> names_of(const std::string& parameters) {
  std::vector<std::string> names;
  int depth = 0;
  std::string name;
  bool is_name = true;
  for (const char c : parameters + ',') {
    if (c == '(' || c == '[' || c == '{') ++depth;
    if (c == ')' || c == ']' || c == '}') --depth;
    if (c == '=') is_name = false;
    if (c == ',' && depth == 0) {
      if (name != "*" && name.substr(0, 1) != "$") names.push_back(name);
      name.clear();
      is_name = true;
    } else if (is_name && c != ' ') {
      name += c;
    }
  }
  return names;
}

std::string type_of(py::handle value) {
  return py::type::handle_of(value).attr("__name__").cast<std::string>();
}

/// Returns the positional parameters; others can be given by name only.
std::string placed(const std::string& parameters) {
  const std::size_t star = parameters.find(", *, ");
  std::string text = star == parameters.npos ? parameters : parameters.substr(0, star) + ", ...";
  const std::string self = "$self";
  if (text.compare(0, self.size(), self) == 0) text.erase(0, text.find_first_not_of(", ", self.size()));
  return text;
}

} // namespace

void Misfit::refuse(const LastResort& first, const py::args& args, const py::kwargs& kwargs) const {
  const std::vector<std::string> names = names_of(parameters_);
  std::string given;
  const auto add = [&given](const std::string& one) { given += (given.empty() ? "" : ", ") + one; };
  if (!first.given.is(no_argument())) add(type_of(first.given));
  for (const py::handle argument : args)
    add(type_of(argument));
  for (const std::pair<py::handle, py::handle> argument : kwargs) {
    const auto name = py::cast<std::string>(argument.first);
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw py::type_error(name_ + "() has no '" + name + "'" + suggestion(name, names));
    add(name + "=" + type_of(argument.second));
  }
  throw py::type_error(name_ + "(" + placed(parameters_) + ") cannot be called with (" + given + ")");
}

} // namespace celltrace
