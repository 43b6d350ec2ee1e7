#include "viewer/key_script.hpp"

#include "celltrace/error.hpp"
#include "viewer/sdl.hpp"

#include <cstdio>

namespace celltrace::viewer {

KeyScript::KeyScript(const std::vector<std::string>& words) {
  for (const std::string& word : words)
    steps_.push_back(step_of(word));
}

KeyScript::Step KeyScript::step_of(const std::string& word) {
  Step step;
  int end = 0;
  const auto is_all = [&] { return static_cast<std::size_t>(end) == word.size(); };
  if (std::sscanf(word.c_str(), "drag:%d,%d%n", &step.x, &step.y, &end) == 2 && is_all()) {
    step.kind = Kind::drag;
    return step;
  }
  if (std::sscanf(word.c_str(), "look:%d,%d%n", &step.x, &step.y, &end) == 2 && is_all()) {
    step.kind = Kind::look;
    return step;
  }
  if (std::sscanf(word.c_str(), "click:%d,%d%n", &step.x, &step.y, &end) == 2 && is_all()) {
    step.kind = Kind::click;
    return step;
  }
  if (std::sscanf(word.c_str(), "wheel:%d%n", &step.y, &end) == 1 && is_all()) {
    step.kind = Kind::wheel;
    return step;
  }
  if (std::sscanf(word.c_str(), "%dx%d%n", &step.x, &step.y, &end) == 2 && is_all() && step.x > 0 &&
      step.y > 0) {
    step.kind = Kind::size;
    return step;
  }
  step.key.keysym.sym = sdl().SDL_GetKeyFromName(word.c_str());
  if (step.key.keysym.sym == SDLK_UNKNOWN)
    throw InputError("--keys: '" + word +
                     "' is neither a key nor WIDTHxHEIGHT, drag:X,Y, look:X,Y, click:X,Y or wheel:N");
  return step;
}

std::optional<KeyScript::Step> KeyScript::next() {
  if (next_ == steps_.size()) return std::nullopt;
  return steps_[next_++];
}

} // namespace celltrace::viewer
