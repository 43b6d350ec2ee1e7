#include "cli/declares.hpp"

#include "celltrace/error.hpp"
#include "cli/pov_numbers.hpp"

#include <cmath>

namespace celltrace::cli {

std::pair<std::string, std::string> parse_declare(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == text.npos) throw InputError("--declare: '" + text + "' is not NAME=VALUE");
  std::pair<std::string, std::string> declare(text.substr(0, equals), text.substr(equals + 1));
  const auto value = declared_value(declare.second);
  if (const double* number = std::get_if<double>(&value); number && !std::isfinite(*number))
    throw InputError("--declare: the number of '" + declare.first + "' is too large");
  return declare;
}

std::variant<double, std::string> declared_value(const std::string& text) {
  if (text.size() >= 2 && text.back() == text.front() && (text.front() == '"' || text.front() == '\''))
    return text.substr(1, text.size() - 2);
  const auto number = read_real(text);
  if (number && number->rest.empty()) return number->value;
  return text;
}

} // namespace celltrace::cli
