#include "cli/environment_options.hpp"

#include "celltrace/error.hpp"
#include "cli/blanks.hpp"
#include "cli/pov_switches.hpp"

#include <cstdlib>

namespace celltrace::cli {

namespace {

/// Reads words from the front of a text.
class Splitter {
public:
  explicit Splitter(std::string_view text) : rest_(text) {}

  std::vector<std::string> words() {
    std::vector<std::string> words;
    while (skip_blanks())
      words.push_back(word());
    return words;
  }

private:
  /// Skips blanks; returns false at the end of the text.
  bool skip_blanks() {
    while (!rest_.empty() && is_blank(rest_[0]))
      rest_.remove_prefix(1);
    return !rest_.empty();
  }

  char take() {
    const char c = rest_[0];
    rest_.remove_prefix(1);
    return c;
  }

  std::string word() {
    std::string word;
    while (!rest_.empty() && !is_blank(rest_[0])) {
      const char c = take();
      if (c == '\'' || c == '"')
        quoted(c, word);
      else if (c == '\\')
        word += escaped();
      else
        word += c;
    }
    return word;
  }

  char escaped() {
    if (rest_.empty()) throw InputError("nothing follows the backslash at the end");
    return take();
  }

  void quoted(char quote, std::string& word) {
    while (!rest_.empty() && rest_[0] != quote) {
      char c = take();
      if (c == '\\' && quote == '"' && !rest_.empty() &&
          std::string_view("\"\\$`").find(rest_[0]) != rest_.npos)
        c = take();
      word += c;
    }
    if (rest_.empty()) throw InputError("a quote is not closed");
    take();
  }

  std::string_view rest_;
};

void check_end(const std::vector<std::string>& words) {
  bool is_value = false;
  for (const std::string& word : words) {
    if (!is_value && word == "--") throw InputError("-- cannot stand here");
    is_value = !is_value && takes_the_next_argument(word);
  }
  if (is_value) throw InputError(words.back() + ": its value is missing, or there is no such option");
}

} // namespace

std::vector<std::string> split_words(std::string_view text) {
  return Splitter(text).words();
}

std::vector<std::string> environment_options() {
  const char* const text = std::getenv(kOptionsVariable);
  if (text == nullptr) return {};
  try {
    std::vector<std::string> words = split_words(text);
    check_end(words);
    return words;
  } catch (const InputError& error) {
    throw InputError(std::string(kOptionsVariable) + ": " + error.what());
  }
}

} // namespace celltrace::cli
