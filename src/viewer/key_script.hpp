// A script of key presses and mouse movements.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <SDL_events.h>

namespace celltrace::viewer {

class KeyScript {
public:
  enum class Kind { key, size, drag, look, wheel, click };
  struct Step {
    Kind kind = Kind::key;
    SDL_KeyboardEvent key{}; ///< for Kind::key
    int x = 0, y = 0;        ///< pixels; for a wheel, y is in steps
  };

  /// Parses the words. Throws InputError for a word that is neither a key's name nor another step.
  explicit KeyScript(const std::vector<std::string>& words);

  /// Returns the next step; nothing at the end.
  std::optional<Step> next();

private:
  static Step step_of(const std::string& word);

  std::vector<Step> steps_;
  std::size_t next_ = 0;
};

} // namespace celltrace::viewer
