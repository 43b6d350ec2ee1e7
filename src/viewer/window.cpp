#include "viewer/window.hpp"

#include "celltrace/error.hpp"
#include "viewer/sdl.hpp"
#include "viewer/text_layout.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace celltrace::viewer {

namespace {

constexpr int kPoints = 13;
constexpr int kMargin = 6;
constexpr Overlay::Colour kText = {255, 255, 255, 255};
constexpr Overlay::Colour kShade = {0, 0, 0, 150};
constexpr Overlay::Colour kError = {120, 0, 0, 210};
constexpr Overlay::Colour kBar = {90, 200, 120, 230};

/// Places where systems have a typeface with letters of one width.
constexpr std::array kFonts = {"/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf",
                               "/usr/share/fonts/dejavu-sans-mono-fonts/DejaVuSansMono.ttf",
                               "/usr/share/fonts/TTF/DejaVuSansMono.ttf",
                               "/usr/share/fonts/truetype/liberation/LiberationMono-Regular.ttf",
                               "/usr/share/fonts/liberation-mono/LiberationMono-Regular.ttf",
                               "/System/Library/Fonts/Menlo.ttc"};

/// Returns whether there is a display. Without one SDL would take a driver that shows nothing, and other
/// libraries would complain.
bool has_display() {
#if defined(__unix__) && !defined(__APPLE__)
  const auto is_set = [](const char* name) {
    return std::getenv(name) != nullptr && *std::getenv(name) != 0;
  };
  return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY") || is_set("SDL_VIDEODRIVER");
#else
  return true;
#endif
}

} // namespace

void Window::Free::operator()(SDL_Surface* surface) const noexcept {
  sdl().SDL_FreeSurface(surface);
}

Window::Window(const std::string& title, int width, int height, const std::filesystem::path& font) {
  if (!has_display())
    throw Error("there is no display to open a window on: neither DISPLAY nor WAYLAND_DISPLAY is set");
  if (sdl().SDL_InitSubSystem(SDL_INIT_VIDEO) != 0)
    throw Error(std::string("there is no display to open a window on: ") + sdl().SDL_GetError());
  if (std::getenv("SDL_VIDEODRIVER") == nullptr &&
      std::string(sdl().SDL_GetCurrentVideoDriver()) == "offscreen") { // its last choice
    sdl().SDL_QuitSubSystem(SDL_INIT_VIDEO);
    throw Error("there is no display to open a window on: none answers");
  }
  window_ = sdl().SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED, width,
                                   height, SDL_WINDOW_RESIZABLE);
  if (window_ == nullptr) {
    const std::string reason = sdl().SDL_GetError();
    sdl().SDL_QuitSubSystem(SDL_INIT_VIDEO);
    throw Error("cannot open a window: " + reason);
  }
  open_font(font);
}

Window::~Window() {
  together_.reset();
  if (font_ != nullptr) sdl().TTF_CloseFont(font_);
  if (sdl().TTF_WasInit() != 0) sdl().TTF_Quit();
  sdl().SDL_DestroyWindow(window_);
  sdl().SDL_QuitSubSystem(SDL_INIT_VIDEO);
}

void Window::open_font(const std::filesystem::path& font) {
  if (sdl().TTF_Init() != 0) return;
  if (!font.empty()) {
    font_ = sdl().TTF_OpenFont(font.c_str(), kPoints);
    return;
  }
  for (const char* path : kFonts)
    if (font_ == nullptr) font_ = sdl().TTF_OpenFont(path, kPoints);
}

int Window::width() const {
  int width = 0;
  sdl().SDL_GetWindowSize(window_, &width, nullptr);
  return std::max(width, 1);
}
int Window::height() const {
  int height = 0;
  sdl().SDL_GetWindowSize(window_, nullptr, &height);
  return std::max(height, 1);
}

void Window::set_title(const std::string& title) {
  sdl().SDL_SetWindowTitle(window_, title.c_str());
}
void Window::set_full_screen(bool full_screen) {
  sdl().SDL_SetWindowFullscreen(window_, full_screen ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
}

void Window::set_size(int width, int height) {
  sdl().SDL_SetWindowSize(window_, width, height);
}

void Window::show(const Image& picture, const Overlay& overlay) {
  if (!compose(picture, overlay)) return;
  SDL_Surface* const own = sdl().SDL_GetWindowSurface(window_);
  sdl().SDL_SetSurfaceBlendMode(together_.get(), SDL_BLENDMODE_NONE);
  sdl().SDL_BlitSurface(together_.get(), nullptr, own, nullptr);
  sdl().SDL_UpdateWindowSurface(window_);
}

Image Window::without_text(const Image& picture, std::vector<Overlay::Patch> patches) {
  Overlay overlay;
  overlay.patches = std::move(patches);
  if (!compose(picture, overlay)) return picture;
  Image image(together_->w, together_->h);
  const auto* from = static_cast<const std::uint8_t*>(together_->pixels);
  for (int y = 0; y < image.height; ++y, from += together_->pitch) {
    std::memcpy(image.pixel(0, y), from, static_cast<std::size_t>(image.width) * 4);
    for (int x = 0; x < image.width; ++x)
      image.pixel(x, y)[3] = 255;
  }
  return image;
}

/// Draws picture and overlay. Returns false while the window is being resized.
bool Window::compose(const Image& picture, const Overlay& overlay) {
  const SDL_Surface* const own = sdl().SDL_GetWindowSurface(window_);
  if (own == nullptr) return false;
  if (!together_ || together_->w != own->w || together_->h != own->h)
    together_.reset(sdl().SDL_CreateRGBSurfaceWithFormat(0, own->w, own->h, 32, SDL_PIXELFORMAT_RGBA32));
  if (!together_) return false;
  sdl().SDL_FillRect(together_.get(), nullptr, sdl().SDL_MapRGBA(together_->format, 0, 0, 0, 255));
  if (!picture.rgba.empty()) {
    // SDL only reads the pixels.
    const Surface pixels(sdl().SDL_CreateRGBSurfaceWithFormatFrom(
        const_cast<std::uint8_t*>(picture.rgba.data()), picture.width, picture.height, 32, picture.width * 4,
        SDL_PIXELFORMAT_RGBA32));
    sdl().SDL_SetSurfaceBlendMode(pixels.get(), SDL_BLENDMODE_NONE);
    sdl().SDL_BlitScaled(pixels.get(), nullptr, together_.get(), nullptr);
  }
  draw(overlay, picture);
  return true;
}

void Window::draw(const Overlay& overlay, const Image& picture) {
  const int width = together_->w, height = together_->h;
  for (const Overlay::Patch& patch : overlay.patches) {
    const auto scaled = [](int at, int from, int to) {
      return static_cast<int>(std::int64_t{at} * to / std::max(from, 1));
    };
    const int left = scaled(patch.region.left, picture.width, width);
    const int top = scaled(patch.region.top, picture.height, height);
    shade(left, top, scaled(patch.region.right, picture.width, width) - left,
          scaled(patch.region.bottom, picture.height, height) - top, patch.colour);
  }
  draw_lines(overlay);
  if (!overlay.hint.empty()) {
    const int hint = width_of(overlay.hint);
    shade(width - hint - 2 * kMargin, 0, hint + 2 * kMargin, line_height() + 2 * kMargin, kShade);
    write(overlay.hint, width - hint - kMargin, kMargin, kText);
  }
  if (!overlay.page.empty()) draw_page(overlay.page);
  if (!overlay.message.empty()) draw_message(overlay);
}

void Window::draw_lines(const Overlay& overlay) {
  if (overlay.lines.empty() && overlay.bars.empty()) return;
  const int line = line_height();
  std::vector<std::string> lines;
  int widest = 160;
  for (const std::string& text : overlay.lines)
    for (const std::string& part : wrapped(text, columns(), 2)) {
      lines.push_back(part);
      widest = std::max(widest, width_of(part));
    }
  const auto rows = static_cast<int>(lines.size() + overlay.bars.size());
  shade(0, 0, widest + 2 * kMargin, rows * line + 2 * kMargin, kShade);
  int y = kMargin;
  for (const std::string& text : lines)
    y += write(text, kMargin, y, kText);
  for (const Overlay::Bar& bar : overlay.bars) {
    const int label = write(bar.label, kMargin, y, kText) == 0 ? 0 : width_of("SPE 000 ");
    const auto length = static_cast<int>(100 * std::clamp(bar.share, 0.0, 1.0));
    shade(kMargin + label, y + 3, 100, line - 5, kShade);
    shade(kMargin + label, y + 3, length, line - 5, kBar);
    y += line;
  }
}

void Window::draw_page(const std::vector<std::string>& page) {
  int widest = 0;
  for (const std::string& text : page)
    widest = std::max(widest, width_of(text));
  const int height = static_cast<int>(page.size()) * line_height();
  const int left = std::max((together_->w - widest) / 2, kMargin);
  int at = std::max((together_->h - height) / 2, kMargin);
  shade(left - kMargin, at - kMargin, widest + 2 * kMargin, height + 2 * kMargin, {0, 0, 0, 200});
  for (const std::string& text : page)
    at += write(text, left, at, kText);
}

void Window::draw_message(const Overlay& overlay) {
  const std::vector<std::string> lines = wrapped(overlay.message, columns(), 2);
  const int height = static_cast<int>(lines.size()) * line_height() + 2 * kMargin;
  const int top = std::max(together_->h - height, 0);
  shade(0, top, together_->w, height, overlay.is_error ? kError : kShade);
  int at = top + kMargin;
  for (const std::string& text : lines)
    at += write(text, kMargin, at, kText);
}

int Window::columns() const {
  const int letter = std::max(width_of("M"), 1);
  return std::max((width() - 2 * kMargin) / letter, 1);
}

int Window::rows() const {
  return std::max((height() - 2 * kMargin) / std::max(line_height(), 1), 1);
}

int Window::line_height() const {
  return font_ == nullptr ? kPoints + 3 : sdl().TTF_FontLineSkip(font_);
}

int Window::width_of(const std::string& text) const {
  int width = 0;
  if (font_ != nullptr) sdl().TTF_SizeUTF8(font_, text.c_str(), &width, nullptr);
  return width;
}

int Window::write(const std::string& text, int x, int y, Overlay::Colour colour) {
  if (font_ == nullptr) return 0;
  if (text.empty()) return line_height();
  const Surface letters(
      sdl().TTF_RenderUTF8_Blended(font_, text.c_str(), {colour.r, colour.g, colour.b, colour.a}));
  if (!letters) return line_height();
  SDL_Rect at = {x, y, 0, 0};
  sdl().SDL_BlitSurface(letters.get(), nullptr, together_.get(), &at);
  return line_height();
}

void Window::shade(int x, int y, int width, int height, Overlay::Colour colour) {
  if (width <= 0 || height <= 0) return;
  const Surface patch(sdl().SDL_CreateRGBSurfaceWithFormat(0, width, height, 32, SDL_PIXELFORMAT_RGBA32));
  if (!patch) return;
  sdl().SDL_FillRect(patch.get(), nullptr,
                     sdl().SDL_MapRGBA(patch->format, colour.r, colour.g, colour.b, colour.a));
  sdl().SDL_SetSurfaceBlendMode(patch.get(), SDL_BLENDMODE_BLEND);
  SDL_Rect at = {x, y, 0, 0};
  sdl().SDL_BlitSurface(patch.get(), nullptr, together_.get(), &at);
}

} // namespace celltrace::viewer
