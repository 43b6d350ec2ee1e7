// The note that recommends --lenient if a scene uses something unsupported.
#pragma once

#include "celltrace/pov.hpp"

#include <algorithm>

namespace celltrace::cli {

inline bool is_unsupported(const SceneError& error) {
  const std::vector<Finding>& findings = error.findings();
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return finding.is_unsupported; });
}

inline constexpr const char* kLenientNote =
    "note: --lenient renders the scene without what is not supported yet; in the environment, "
    "CELLTRACE_OPTIONS=--lenient does\n";

} // namespace celltrace::cli
