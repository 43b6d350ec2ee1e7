// Replaces view_command.cpp in builds without SDL2 or SDL2_ttf.
#include "cli/view_command.hpp"

#include "celltrace/error.hpp"

namespace celltrace::cli {

int run_view(const ViewRequest&) {
  throw InputError("this celltrace has no window: it was built without SDL2 and SDL2_ttf");
}

} // namespace celltrace::cli
