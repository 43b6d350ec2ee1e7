// The keys of the viewer and their actions.
#pragma once

#include <cstdint>
#include <vector>

#include <SDL_keycode.h>

namespace celltrace::viewer {

enum class Action : std::uint8_t {
  left,
  right,
  forward,
  back,
  rise,
  sink,
  switch_mode,
  zoom_in,
  zoom_out,
  reset,
  next_view,
  information,
  strips,
  costs,
  next_backend,
  next_model,
  antialiasing,
  screenshot,
  copy_camera,
  pause,
  help,
  full_screen,
  quit
};

struct Control {
  Action action;
  SDL_Keycode keys[2]; ///< the second key may be 0
  const char* name;    ///< name of the keys, for people
  const char* help;
};

/// Returns all controls, in the order in which help shows them.
const std::vector<Control>& controls();
/// Returns the control of a key; null for keys without one.
const Control* control_of(SDL_Keycode key);
/// Returns true for actions that go on as long as their key is down.
constexpr bool is_movement(Action action) {
  return action <= Action::sink || action == Action::zoom_in || action == Action::zoom_out;
}

} // namespace celltrace::viewer
