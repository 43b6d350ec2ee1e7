// Statistics and diagnostics of SPEs as the JSON that docs/statistics.md describes.
#pragma once

#include "celltrace/spe/diagnostic.hpp"
#include "celltrace/spe/timing.hpp"

#include <nlohmann/json_fwd.hpp>

namespace celltrace {

nlohmann::ordered_json cycles_json(const SpuCycles& cycles);

/// Returns a diagnostic. Removes addresses from its text, because addresses of main memory differ from run to
/// run.
nlohmann::ordered_json diagnostic_json(const Diagnostic& diagnostic);

} // namespace celltrace
