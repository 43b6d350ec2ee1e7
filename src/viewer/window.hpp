// A window with a picture and information over it, by SDL.
//
// There are three surfaces, as in the thesis: the window's own; the picture, whose memory receives the SPEs'
// pixels; and the text over it. All three are composed in a fourth one, so that a half-drawn picture is never
// seen.
#pragma once

#include "celltrace/image.hpp"
#include "celltrace/render.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

struct SDL_Surface;
struct SDL_Window;
typedef struct _TTF_Font TTF_Font; // as SDL_ttf declares it

namespace celltrace::viewer {

/// The information that is shown over a picture.
struct Overlay {
  struct Colour {
    std::uint8_t r, g, b, a;
  };
  struct Patch {
    PictureRegion region; ///< region in pixels of the picture
    Colour colour;
  };
  struct Bar {
    std::string label;
    double share; ///< 0 to 1
  };

  std::vector<Patch> patches;
  std::vector<std::string> lines; ///< lines at the top left
  std::vector<Bar> bars;          ///< bars below the lines
  std::vector<std::string> page;  ///< lines of a page in the middle
  std::string hint;               ///< text at the top right
  std::string message;            ///< text at the bottom, in any number of lines
  bool is_error = false;          ///< true: the message is an error
};

class Window {
public:
  /// Opens a window. Throws Error if there is no display. `font`: a TrueType file; empty: one of the
  /// system's.
  Window(const std::string& title, int width, int height, const std::filesystem::path& font);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  int width() const;
  int height() const;
  /// Returns false if no font was found; text over pictures is not shown then.
  bool has_font() const { return font_ != nullptr; }
  void set_title(const std::string& title);
  void set_full_screen(bool full_screen);
  void set_size(int width, int height);

  /// Shows the picture in the size of the window; black if it is empty.
  void show(const Image& picture, const Overlay& overlay);
  /// Returns the picture in the window's size, with patches, but without text. Call show() again
  /// afterwards.
  Image without_text(const Image& picture, std::vector<Overlay::Patch> patches);
  /// Return the number of letters in a row, and of rows, that the window has room for.
  int columns() const;
  int rows() const;

private:
  struct Free {
    void operator()(SDL_Surface* surface) const noexcept;
  };
  using Surface = std::unique_ptr<SDL_Surface, Free>;

  void open_font(const std::filesystem::path& font);
  bool compose(const Image& picture, const Overlay& overlay);
  void draw_lines(const Overlay& overlay);
  void draw_page(const std::vector<std::string>& page);
  void draw_message(const Overlay& overlay);
  void draw(const Overlay& overlay, const Image& picture);
  /// Writes text. Returns its height.
  int write(const std::string& text, int x, int y, Overlay::Colour colour);
  int line_height() const;
  int width_of(const std::string& text) const;
  void shade(int x, int y, int width, int height, Overlay::Colour colour);

  SDL_Window* window_ = nullptr;
  TTF_Font* font_ = nullptr;
  Surface together_; ///< the composed surface
};

} // namespace celltrace::viewer
