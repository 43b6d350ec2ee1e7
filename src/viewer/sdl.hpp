// SDL2 and SDL2_ttf, loaded when a window is opened: they load some sixty other libraries, which would make
// commands that open no window take several times as long to start.
#pragma once

#include <SDL.h>
#include <SDL_ttf.h>

namespace celltrace::viewer {

/// Lists the functions that the viewer calls. SDL_BlitSurface and SDL_BlitScaled are macros for SDL_Upper...
#define CELLTRACE_SDL_FUNCTIONS(function)                                                                    \
  function(SDL_CreateRGBSurfaceWithFormat);                                                                  \
  function(SDL_CreateRGBSurfaceWithFormatFrom);                                                              \
  function(SDL_CreateWindow);                                                                                \
  function(SDL_DestroyWindow);                                                                               \
  function(SDL_FillRect);                                                                                    \
  function(SDL_FreeSurface);                                                                                 \
  function(SDL_GetCurrentVideoDriver);                                                                       \
  function(SDL_GetError);                                                                                    \
  function(SDL_GetKeyFromName);                                                                              \
  function(SDL_GetModState);                                                                                 \
  function(SDL_GetWindowSize);                                                                               \
  function(SDL_GetWindowSurface);                                                                            \
  function(SDL_InitSubSystem);                                                                               \
  function(SDL_MapRGBA);                                                                                     \
  function(SDL_PollEvent);                                                                                   \
  function(SDL_PushEvent);                                                                                   \
  function(SDL_Quit);                                                                                        \
  function(SDL_QuitSubSystem);                                                                               \
  function(SDL_RegisterEvents);                                                                              \
  function(SDL_SetClipboardText);                                                                            \
  function(SDL_SetMainReady);                                                                                \
  function(SDL_SetSurfaceBlendMode);                                                                         \
  function(SDL_SetWindowFullscreen);                                                                         \
  function(SDL_SetWindowSize);                                                                               \
  function(SDL_SetWindowTitle);                                                                              \
  function(SDL_UpdateWindowSurface);                                                                         \
  function(SDL_UpperBlit);                                                                                   \
  function(SDL_UpperBlitScaled);                                                                             \
  function(SDL_WaitEventTimeout)
#define CELLTRACE_SDL_TTF_FUNCTIONS(function)                                                                \
  function(TTF_CloseFont);                                                                                   \
  function(TTF_FontLineSkip);                                                                                \
  function(TTF_Init);                                                                                        \
  function(TTF_OpenFont);                                                                                    \
  function(TTF_Quit);                                                                                        \
  function(TTF_RenderUTF8_Blended);                                                                          \
  function(TTF_SizeUTF8);                                                                                    \
  function(TTF_WasInit)

struct Sdl {
#define CELLTRACE_POINTER_TO(name) decltype(&::name) name
  CELLTRACE_SDL_FUNCTIONS(CELLTRACE_POINTER_TO);
  CELLTRACE_SDL_TTF_FUNCTIONS(CELLTRACE_POINTER_TO);
#undef CELLTRACE_POINTER_TO
};

/// Returns the functions. The first call loads the libraries, for good. Throws Error if they are missing.
/// Thread-safe.
const Sdl& sdl();

} // namespace celltrace::viewer
