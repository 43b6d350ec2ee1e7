#include "viewer/sdl.hpp"

#include "celltrace/error.hpp"

#include <dlfcn.h>

#include <string>

namespace celltrace::viewer {

namespace {

/// Names of the libraries' binary interfaces, which packages without headers install, too.
#ifdef __APPLE__
constexpr char kSdl[] = "libSDL2-2.0.0.dylib", kSdlTtf[] = "libSDL2_ttf-2.0.0.dylib";
#else
constexpr char kSdl[] = "libSDL2-2.0.so.0", kSdlTtf[] = "libSDL2_ttf-2.0.so.0";
#endif

class Library {
public:
  explicit Library(const char* name) : handle_(dlopen(name, RTLD_NOW | RTLD_LOCAL)) {
    if (handle_ == nullptr) throw Error(std::string("a window needs SDL2 and SDL2_ttf: ") + dlerror());
  }
  template <class Function> void find(const char* name, Function*& function) const {
    function = reinterpret_cast<Function*>(dlsym(handle_, name));
    if (function == nullptr)
      throw Error(std::string("a window needs another SDL2 or SDL2_ttf: ") + dlerror());
  }

private:
  void* handle_;
};

Sdl loaded() {
  const Library of_sdl(kSdl), of_sdl_ttf(kSdlTtf);
  Sdl all;
#define CELLTRACE_FIND_IN_SDL(name) of_sdl.find(#name, all.name)
  CELLTRACE_SDL_FUNCTIONS(CELLTRACE_FIND_IN_SDL);
#define CELLTRACE_FIND_IN_SDL_TTF(name) of_sdl_ttf.find(#name, all.name)
  CELLTRACE_SDL_TTF_FUNCTIONS(CELLTRACE_FIND_IN_SDL_TTF);
  return all;
}

} // namespace

const Sdl& sdl() {
  static const Sdl functions = loaded();
  return functions;
}

} // namespace celltrace::viewer
