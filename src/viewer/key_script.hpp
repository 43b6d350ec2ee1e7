// Keys that a program presses by itself.
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
    SDL_KeyboardEvent key{}; ///< of a key
    int x = 0, y = 0;        ///< pixels; of a wheel y steps
  };

  /// Throws InputError for what is neither the name of a key nor one of the others.
  explicit KeyScript(const std::vector<std::string>& words);

  /// Nothing when there are no more.
  std::optional<Step> next();

private:
  static Step step_of(const std::string& word);

  std::vector<Step> steps_;
  std::size_t next_ = 0;
};

} // namespace celltrace::viewer
