#include "celltrace/version.hpp"

namespace celltrace {

const char* version() noexcept {
  return CELLTRACE_VERSION_STRING;
}

} // namespace celltrace
