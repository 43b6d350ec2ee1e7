#include "render/machine_diagnostics.hpp"

#include <algorithm>
#include <utility>

namespace celltrace {

std::vector<Diagnostic> MachineDiagnostics::take() {
  std::vector<Diagnostic> found = machine_.diagnostics();
  found.erase(found.begin(),
              found.begin() + static_cast<std::ptrdiff_t>(std::exchange(known_, found.size())));
  if (options_.diagnostic) std::for_each(found.begin(), found.end(), options_.diagnostic);
  return found;
}

} // namespace celltrace
