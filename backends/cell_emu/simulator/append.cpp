#include "backends/cell_emu/simulator/append.hpp"

#include <cstdarg>
#include <cstdio>

namespace celltrace::cell_emu {

void append(std::string& text, const char* format, ...) {
  char piece[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(piece, sizeof piece, format, arguments);
  va_end(arguments);
  text += piece;
}

} // namespace celltrace::cell_emu
