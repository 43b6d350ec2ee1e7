#include "viewer/controls.hpp"

namespace celltrace::viewer {

const std::vector<Control>& controls() {
  static const std::vector<Control> all = {
      {Action::left, {SDLK_LEFT, SDLK_a}, "Left, A", "move to the left; radial: around the middle"},
      {Action::right, {SDLK_RIGHT, SDLK_d}, "Right, D", "move to the right"},
      {Action::forward, {SDLK_UP, SDLK_w}, "Up, W", "move forward; radial: over the middle"},
      {Action::back, {SDLK_DOWN, SDLK_s}, "Down, S", "move back"},
      {Action::rise, {SDLK_PAGEUP, SDLK_r}, "Page up, R", "rise; radial: away from the middle"},
      {Action::sink, {SDLK_PAGEDOWN, SDLK_v}, "Page down, V", "sink; radial: towards the middle"},
      {Action::switch_mode, {SDLK_m, 0}, "M", "keys move in the plane, or around the middle"},
      {Action::zoom_in, {SDLK_PLUS, SDLK_KP_PLUS}, "+, wheel", "zoom in"},
      {Action::zoom_out, {SDLK_MINUS, SDLK_KP_MINUS}, "-, wheel", "zoom out"},
      {Action::reset, {SDLK_HOME, SDLK_0}, "Home, 0", "back to where the view began"},
      {Action::next_view, {SDLK_c, 0}, "C", "next camera: the scene's own, then from each side"},
      {Action::information, {SDLK_i, 0}, "I", "information"},
      {Action::strips, {SDLK_l, 0}, "L", "which SPE rendered what"},
      {Action::costs, {SDLK_k, 0}, "K", "what took how long"},
      {Action::next_backend, {SDLK_b, 0}, "B", "next backend"},
      {Action::next_model, {SDLK_n, 0}, "N", "next programming model"},
      {Action::antialiasing, {SDLK_x, 0}, "X", "antialiasing at rest"},
      {Action::screenshot, {SDLK_p, SDLK_F12}, "P, F12", "save the picture"},
      {Action::copy_camera, {SDLK_t, 0}, "T", "copy the camera as POV-Ray's text"},
      {Action::pause, {SDLK_SPACE, 0}, "Space", "pause"},
      {Action::help, {SDLK_h, SDLK_F1}, "H, F1", "this help"},
      {Action::full_screen, {SDLK_f, SDLK_F11}, "F, F11", "full screen"},
      {Action::quit, {SDLK_q, SDLK_ESCAPE}, "Q, Esc", "quit"},
  };
  return all;
}

const Control* control_of(SDL_Keycode key) {
  if (key == SDLK_EQUALS) key = SDLK_PLUS; // the same key without shift
  for (const Control& control : controls())
    if (control.keys[0] == key || (control.keys[1] != 0 && control.keys[1] == key)) return &control;
  return nullptr;
}

} // namespace celltrace::viewer
