#include "viewer/viewer.hpp"

#include "celltrace/error.hpp"
#include "celltrace/spe/machine.hpp"
#include "viewer/camera_text.hpp"
#include "viewer/controls.hpp"
#include "viewer/frame_source.hpp"
#include "viewer/information.hpp"
#include "viewer/key_script.hpp"
#include "viewer/navigator.hpp"
#include "viewer/scene_loader.hpp"
#include "viewer/sdl.hpp"
#include "viewer/state_log.hpp"
#include "viewer/text_layout.hpp"
#include "viewer/window.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <iostream>
#include <map>
#include <optional>
#include <set>

#include <glm/geometric.hpp>

namespace celltrace::viewer {

namespace {

using Clock = std::chrono::steady_clock;

/// Steps a second while a key is held down, after the step that it makes at once: a fifth of the distance.
constexpr double kStepsPerSecond = 5;
constexpr std::chrono::milliseconds kHold(200);
constexpr double kDegreesPerPixel = 0.2;
constexpr double kZoomPerStep = 1.1;
/// Pixels that the mouse may move with its button down without turning the camera.
constexpr int kClick = 2;
constexpr std::chrono::milliseconds kFileCheckInterval(250);
constexpr std::chrono::seconds kMessage(3), kLongMessage(10), kHint(5);
/// Time without input after which a picture is still.
constexpr std::chrono::milliseconds kStill(500);

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

std::vector<Backend> usable_backends(Backend first) {
  std::vector<Backend> backends = {first};
  for (const Backend backend : kBackends)
    if (backend != first) backends.push_back(backend);
  return backends;
}

class Viewer {
public:
  explicit Viewer(const ViewOptions& options)
      : options_(options), render_(options.render), antialiasing_(options.render.antialiasing),
        backends_(usable_backends(options.render.backend)), state_(options.state), script_(options.keys),
        wake_event_(sdl().SDL_RegisterEvents(1)),
        loader_(options.scene, options.parse, [event = wake_event_] { wake(event); }),
        window_("celltrace - " + options.scene.filename().string(), options.render.width,
                options.render.height, options.font),
        source_([event = wake_event_] { wake(event); }) {
    hint("H: help, left drag: go around, keys: planar");
    redraw();
  }

  /// Runs until the user quits. Returns whether there was ever a scene.
  bool run() {
    while (!quits_) {
      SDL_Event event;
      if (sdl().SDL_WaitEventTimeout(&event, held_.empty() ? 50 : 5) != 0) {
        do
          handle(event);
        while (!quits_ && sdl().SDL_PollEvent(&event) != 0);
      }
      if (quits_) break;
      move_on();
      take_scene();
      take_frame();
      take_picked();
      look_at_files();
      forget_messages();
      if (is_dirty_) redraw();
    }
    return scene_ != nullptr;
  }

private:
  static void wake(Uint32 type) {
    SDL_Event event{};
    event.type = type;
    sdl().SDL_PushEvent(&event);
  }

  // --- input ---

  void handle(const SDL_Event& event) {
    switch (event.type) {
    case SDL_QUIT:
      quits_ = true;
      return;
    case SDL_KEYDOWN:
      return key_down(event.key);
    case SDL_KEYUP:
      if (const Control* control = control_of(event.key.keysym.sym)) held_.erase(control->action);
      return;
    case SDL_MOUSEBUTTONDOWN:
      dragged_ = 0;
      if (event.button.button == SDL_BUTTON_LEFT) pick_middle();
      return;
    case SDL_MOUSEBUTTONUP:
      if (event.button.button == SDL_BUTTON_LEFT && dragged_ <= kClick) pick(event.button.x, event.button.y);
      return;
    case SDL_MOUSEMOTION:
      dragged_ += std::abs(event.motion.xrel) + std::abs(event.motion.yrel);
      return drag(event.motion.state, (sdl().SDL_GetModState() & KMOD_SHIFT) != 0, event.motion.xrel,
                  event.motion.yrel);
    case SDL_MOUSEWHEEL:
      return zoom(event.wheel.y);
    case SDL_WINDOWEVENT:
      if (event.window.event == SDL_WINDOWEVENT_SIZE_CHANGED) resize();
      if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) held_.clear();
      is_dirty_ = true;
      return;
    default:
      return;
    }
  }

  void key_down(const SDL_KeyboardEvent& key) {
    const Control* const control = control_of(key.keysym.sym);
    if (control == nullptr || key.repeat != 0) return;
    if ((key.keysym.mod & (KMOD_CTRL | KMOD_ALT | KMOD_GUI)) != 0) return;
    if (is_movement(control->action)) {
      held_[control->action] = Clock::now() + kHold;
      move(control->action, 1);
      return request_frame();
    }
    obey(control->action);
  }

  void obey(Action action) {
    switch (action) {
    case Action::quit:
      quits_ = true;
      return;
    case Action::switch_mode:
      switch_mode();
      break;
    case Action::reset:
      if (navigator_) navigator_->reset();
      return request_frame();
    case Action::next_view:
      if (navigator_) navigator_->show_view(navigator_->view() + 1);
      return request_frame();
    case Action::information:
      shows_information_ = !shows_information_;
      break;
    case Action::strips:
      shows_strips_ = !shows_strips_;
      shows_costs_ = false;
      return request_work();
    case Action::costs:
      shows_costs_ = !shows_costs_;
      shows_strips_ = false;
      return request_work();
    case Action::next_backend:
      backend_ = (backend_ + 1) % backends_.size();
      render_.backend = backends_[backend_];
      return change_machine();
    case Action::next_model:
      render_.model = render_.model == Model::offload
                          ? Model::shared
                          : static_cast<Model>(static_cast<int>(render_.model) + 1);
      return change_machine();
    case Action::antialiasing:
      antialiasing_ =
          antialiasing_ ? std::nullopt : std::optional(options_.render.antialiasing.value_or(Antialiasing()));
      return request_frame();
    case Action::screenshot:
      save_screenshot();
      break;
    case Action::copy_camera:
      copy_camera();
      break;
    case Action::pause:
      is_paused_ = !is_paused_;
      if (!is_paused_) return request_frame();
      break;
    case Action::help:
      if (++help_page_ > help_pages().size()) help_page_ = 0;
      break;
    case Action::full_screen:
      is_full_screen_ = !is_full_screen_;
      window_.set_full_screen(is_full_screen_);
      break;
    default:
      break;
    }
    is_dirty_ = true;
  }

  void switch_mode() {
    if (!navigator_) return;
    const bool is_radial = navigator_->mode() == Navigator::Mode::planar;
    navigator_->set_mode(is_radial ? Navigator::Mode::radial : Navigator::Mode::planar);
    hint(is_radial ? "keys: radial, around the middle" : "keys: planar");
    if (is_radial) pick_middle();
  }

  /// Asks for the object in the middle of the picture, which becomes the point to orbit when the answer
  /// comes.
  void pick_middle() {
    if (navigator_ && !navigator_->has_pivot()) source_.pick_middle();
  }

  void move(Action action, double steps) {
    if (!navigator_) return;
    if (navigator_->mode() == Navigator::Mode::radial) pick_middle();
    switch (action) {
    case Action::left:
      return navigator_->go(-steps, 0);
    case Action::right:
      return navigator_->go(steps, 0);
    case Action::forward:
      return navigator_->go(0, steps);
    case Action::back:
      return navigator_->go(0, -steps);
    case Action::rise:
      return navigator_->rise(steps);
    case Action::sink:
      return navigator_->rise(-steps);
    case Action::zoom_in:
      return navigator_->zoom(std::pow(kZoomPerStep, steps));
    case Action::zoom_out:
      return navigator_->zoom(std::pow(kZoomPerStep, -steps));
    default:
      return;
    }
  }

  /// Repeats the actions of keys that are held down, as soon as the last movement has been shown.
  void move_on() {
    if (held_.empty() || shown_number_ < number_) return;
    const Clock::time_point now = Clock::now();
    bool moved = false;
    for (auto& [action, last] : held_) {
      if (now <= last) continue;
      move(action, std::chrono::duration<double>(now - last).count() * kStepsPerSecond);
      last = now;
      moved = true;
    }
    if (moved) request_frame();
  }

  void drag(Uint32 buttons, bool has_shift, int x, int y) {
    if (!navigator_ || (x == 0 && y == 0) || dragged_ <= kClick) return;
    const bool is_left = (buttons & SDL_BUTTON_LMASK) != 0;
    if (is_left && !has_shift)
      navigator_->orbit(-kDegreesPerPixel * x, kDegreesPerPixel * y);
    else if (is_left || (buttons & SDL_BUTTON_RMASK) != 0)
      navigator_->turn(kDegreesPerPixel * x, -kDegreesPerPixel * y);
    else if ((buttons & SDL_BUTTON_MMASK) != 0)
      navigator_->walk(0.1 * x, -0.1 * y);
    else
      return;
    request_frame();
  }

  /// Asks for the object at a point, in pixels of the window.
  void pick(int x, int y) {
    is_picking_ = true;
    source_.pick((x + 0.5) / window_.width(), (y + 0.5) / window_.height());
  }

  void zoom(int steps) {
    if (!navigator_ || steps == 0) return;
    navigator_->zoom(std::pow(kZoomPerStep, steps));
    request_frame();
  }

  /// Plays a step as if the user had done it.
  void play(const KeyScript::Step& step) {
    switch (step.kind) {
    case KeyScript::Kind::key:
      key_down(step.key);
      if (const Control* control = control_of(step.key.keysym.sym)) held_.erase(control->action);
      return;
    case KeyScript::Kind::size:
      return window_.set_size(step.x, step.y);
    case KeyScript::Kind::click:
      return pick(step.x, step.y);
    case KeyScript::Kind::drag:
    case KeyScript::Kind::look:
      dragged_ = kClick + 1;
      return drag(SDL_BUTTON_LMASK, step.kind == KeyScript::Kind::look, step.x, step.y);
    case KeyScript::Kind::wheel:
      return zoom(step.y);
    }
  }

  // --- requests ---

  void resize() {
    const int width = window_.width(), height = window_.height();
    if (width == render_.width && height == render_.height) return;
    render_.width = width;
    render_.height = height;
    request_frame();
  }

  void change_machine() {
    ++machine_;
    request_frame();
  }
  /// Requests a frame with work records, if strips or costs are shown: frames without them have no such
  /// information.
  void request_work() {
    if (shows_strips_ || shows_costs_) return request_frame();
    is_dirty_ = true;
  }

  void request_frame() {
    is_dirty_ = true;
    if (!scene_ || is_paused_) return;
    FrameRequest request;
    request.scene = scene_;
    request.options = render_;
    request.options.ray_queries = true;
    request.options.antialiasing = render_.model == Model::shared ? antialiasing_ : std::nullopt;
    if (render_.backend != Backend::native && request.options.spes == 0 &&
        options_.render.backend == Backend::native)
      request.options.spes = 8;
    request.work_map = shows_strips_ || shows_costs_;
    request.machine = machine_;
    request.number = ++number_;
    is_final_ = false; // also for log lines before its first frame
    request.camera = navigator_ ? fitted(navigator_->camera()) : fitted(scene_->camera);
    requested_ = Clock::now();
    source_.request(request);
  }

  /// Returns a camera for a window of other proportions, which sees the same height.
  Camera fitted(const Camera& camera) const {
    const double proportion = (static_cast<double>(render_.width) / render_.height) /
                              (static_cast<double>(options_.render.width) / options_.render.height);
    Camera fitting = camera;
    if (camera.kind == Camera::Kind::perspective || camera.kind == Camera::Kind::orthographic)
      fitting.right *= proportion;
    return fitting;
  }

  // --- answers ---

  void take_scene() {
    std::optional<Loaded> loaded = loader_.take();
    if (!loaded) return;
    is_dirty_ = true;
    std::cerr << loaded->warnings << std::flush;
    if (!loaded->scene) {
      if (!loaded->error.empty()) std::cerr << loaded->error << std::endl;
      say(loaded->error, true);
      return;
    }
    const bool is_first = scene_ == nullptr;
    error_.clear();
    scene_ = loaded->scene;
    names_ = std::move(loaded->names);
    if (scene_->lights.empty())
      say("this scene has no light source: it is black but for what glows by itself", false, kLongMessage);
    if (!is_first) {
      // After an edit the same part of the scene is shown again, unless the scene's camera was edited.
      has_new_camera_ = !same(scene_->camera, scene_camera_);
    }
    scene_camera_ = scene_->camera;
    if (has_new_camera_ && !is_first) navigator_.reset();
    request_frame();
  }

  static bool same(const Camera& a, const Camera& b) {
    return a.kind == b.kind && a.location == b.location && a.direction == b.direction && a.right == b.right &&
           a.up == b.up && a.angle == b.angle && a.vertical_angle == b.vertical_angle;
  }

  void take_frame() {
    std::optional<Frame> frame = source_.take();
    if (!frame || is_paused_) return;
    is_dirty_ = true;
    if (!frame->error.empty()) {
      say(frame->error, true);
      shown_number_ = std::max(shown_number_, frame->number);
      is_final_ = frame->number == number_;
      return;
    }
    error_.clear();
    if (frame->is_complete && frame->number != shown_number_) times_.push_back(Clock::now());
    while (!times_.empty() && seconds_since(times_.front()) > 1)
      times_.pop_front();
    if (frame->number != shown_number_ && frame->number == number_) latency_ = seconds_since(requested_);
    shown_number_ = std::max(shown_number_, frame->number);
    is_final_ = frame->is_final && frame->number == number_;
    if (!navigator_ && scene_)
      navigator_.emplace(scene_->camera, frame->statistics.bounds[0], frame->statistics.bounds[1]);
    frame_ = std::move(*frame);
  }

  void take_picked() {
    const std::optional<Picked> picked = source_.take_picked();
    if (!picked) return;
    if (picked->is_middle) {
      if (navigator_ && picked->object && !navigator_->has_pivot())
        navigator_->set_pivot(glm::length(picked->point - navigator_->camera().location));
      return;
    }
    is_picking_ = false;
    picked_ = *picked;
    if (!picked->error.empty()) return say(picked->error, false);
    if (!picked->object) return say("nothing", false);
    char text[120];
    std::snprintf(text, sizeof text, ", %.4g away, at <%.4g, %.4g, %.4g>", picked->distance, picked->point.x,
                  picked->point.y, picked->point.z);
    say((picked->scene == scene_ ? names_ : ObjectNames()).describe(*picked->object) + text, false);
  }

  void look_at_files() {
    if (is_paused_ || Clock::now() < next_file_check_) return;
    next_file_check_ = Clock::now() + kFileCheckInterval;
    loader_.check_files();
  }

  // --- display ---

  void say(const std::string& text, bool is_error, std::chrono::seconds long_ = kMessage) {
    if (is_error) {
      error_ = text;
    } else {
      message_ = text;
      message_ends_ = Clock::now() + long_;
    }
    is_dirty_ = true;
  }
  /// Shows a hint for some seconds at the top right.
  void hint(const std::string& text) {
    hint_ = text;
    hint_ends_ = Clock::now() + kHint;
    is_dirty_ = true;
  }
  void forget_messages() {
    const auto forget = [&](std::string& text, Clock::time_point end) {
      if (text.empty() || Clock::now() < end) return;
      text.clear();
      is_dirty_ = true;
    };
    forget(message_, message_ends_);
    forget(hint_, hint_ends_);
    if (is_still() != was_still_) is_dirty_ = true;
  }
  bool is_still() const { return is_final_ && Clock::now() - requested_ > kStill; }

  void save_screenshot() {
    const std::string stem = options_.scene.stem().string();
    for (int number = 1; number < 10000; ++number) {
      const std::string digits = std::to_string(number);
      screenshot_ =
          stem + "-" + std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits + ".png";
      if (!std::filesystem::exists(screenshot_)) break;
    }
    try {
      save_image(screenshot_, window_.without_text(frame_.image, patches()));
      say("saved " + screenshot_, false);
    } catch (const std::exception& error) {
      say(error.what(), true);
    }
  }

  void copy_camera() {
    if (!navigator_) return;
    const std::string text = camera_text(fitted(navigator_->camera()), render_.width, render_.height);
    std::cout << text << std::flush;
    const bool is_copied = sdl().SDL_SetClipboardText(text.c_str()) == 0;
    say(is_copied ? "the camera is in the clipboard and on stdout" : "the camera is on stdout", false);
  }

  std::vector<Overlay::Patch> patches() const {
    if (shows_costs_) return costs_of(frame_);
    return shows_strips_ ? strips_of(frame_) : std::vector<Overlay::Patch>();
  }
  std::vector<std::vector<std::string>> help_pages() const {
    return pages_of(help_table(), window_.columns(), window_.rows());
  }

  Situation situation() const {
    Situation situation;
    situation.scene = options_.scene.filename().string();
    if (navigator_) {
      situation.mode = navigator_->mode() == Navigator::Mode::planar ? "planar" : "radial";
      situation.view = navigator_->views()[navigator_->view()];
    }
    situation.frames_per_second = static_cast<double>(times_.size());
    situation.is_still = is_still();
    situation.is_paused = is_paused_;
    return situation;
  }

  void redraw() {
    is_dirty_ = false;
    Overlay overlay;
    was_still_ = is_still();
    overlay.patches = patches();
    if (shows_information_) {
      overlay.lines = information_on(frame_, situation());
      overlay.bars = load_of(frame_);
    }
    if (help_page_ != 0) {
      const auto pages = help_pages();
      help_page_ = std::min(help_page_, pages.size()); // the window may have been larger
      overlay.page = pages[help_page_ - 1];
    }
    overlay.hint = hint_;
    overlay.is_error = !error_.empty();
    overlay.message = error_.empty() ? message_ : error_;
    if (!scene_ && overlay.message.empty()) overlay.message = "reading " + options_.scene.string() + " ...";
    window_.show(frame_.image, overlay);
    window_.set_title("celltrace - " + options_.scene.filename().string() +
                      (navigator_ ? " - " + situation().mode : "") + (is_paused_ ? " (paused)" : ""));
    log_state();
    if (is_picking_) return;
    if ((is_final_ || (!error_.empty() && shown_number_ >= number_)) && !is_dirty_)
      if (const auto step = script_.next()) {
        is_final_ = false;
        play(*step);
        // A step that does not change the picture ends at once.
        is_final_ = is_final_ || shown_number_ == number_;
        is_dirty_ = true;
      }
  }

  void log_state() {
    if (!state_.is_open()) return;
    State state;
    state.situation = situation();
    state.frame = &frame_;
    state.backend = name_of(render_.backend);
    state.model = render_.model;
    state.error = error_;
    state.message = message_;
    state.screenshot = screenshot_;
    state.information = shows_information_;
    state.strips = shows_strips_;
    state.costs = shows_costs_;
    state.help = help_page_ != 0;
    state.help_pages = help_pages().size();
    state.hint = hint_;
    state.full_screen = is_full_screen_;
    state.antialiasing = antialiasing_.has_value();
    state.is_final = is_final_;
    state.width = window_.width();
    state.height = window_.height();
    state.latency = latency_;
    state.seconds = seconds_since(start_);
    if (navigator_) state.camera = navigator_->camera();
    state.picked = picked_;
    if (picked_ && picked_->scene == scene_) state.names = &names_;
    state_.write(state);
  }

  const Clock::time_point start_ = Clock::now();
  const ViewOptions options_;
  RenderOptions render_; ///< options of the wanted picture
  std::optional<Antialiasing> antialiasing_;
  const std::vector<Backend> backends_;
  std::size_t backend_ = 0;
  int dragged_ = 0; ///< pixels that the mouse has moved since a button went down
  bool is_picking_ = false;
  std::optional<Picked> picked_; ///< the last answer
  StateLog state_;
  KeyScript script_;
  const Uint32 wake_event_;

  std::shared_ptr<const Scene> scene_;
  ObjectNames names_; ///< names of its objects
  Camera scene_camera_;
  bool has_new_camera_ = false;
  std::optional<Navigator> navigator_; ///< set when the scene's size is known
  Frame frame_;                        ///< the frame that is shown
  std::uint64_t machine_ = 1, number_ = 0, shown_number_ = 0;
  bool is_final_ = false;
  Clock::time_point requested_ = start_, next_file_check_ = start_, message_ends_ = start_,
                    hint_ends_ = start_;
  double latency_ = 0; ///< seconds from the last input to the first picture of what it asked for
  std::deque<Clock::time_point> times_; ///< times of the frames of the last second
  std::map<Action, Clock::time_point> held_;
  bool shows_information_ = false, shows_strips_ = false, shows_costs_ = false;
  std::size_t help_page_ = 0; ///< page that is shown, from 1; 0: none
  bool was_still_ = false;    ///< value at the last drawing
  bool is_full_screen_ = false, is_paused_ = false, is_dirty_ = true, quits_ = false;
  std::string error_, message_, hint_, screenshot_;

  SceneLoader loader_;
  Window window_;
  FrameSource source_;
};

/// Initialises SDL's events for its lifetime.
class Events {
public:
  Events() {
    sdl().SDL_SetMainReady();
    if (sdl().SDL_InitSubSystem(SDL_INIT_EVENTS) != 0)
      throw Error(std::string("cannot wait for events: ") + sdl().SDL_GetError());
  }
  ~Events() { sdl().SDL_Quit(); }
};

} // namespace

bool view(const ViewOptions& options) {
  const Events events;
  Viewer viewer(options);
  return viewer.run();
}

} // namespace celltrace::viewer
