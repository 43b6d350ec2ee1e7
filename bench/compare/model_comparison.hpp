// celltrace beside Embree on models.
#pragma once

#include "model.hpp"
#include "report.hpp"
#include "settings.hpp"

namespace celltrace::compare {

/// What a model is in the comparison; decides which bars hold for it.
enum class ModelKind { scanned, generated };

/// Adds the figures of a model: rays, first frame, rebuilt every frame, threads, accelerator, agreement.
void compare_model(const Model& model, ModelKind kind, const Settings& settings, Report& report);

/// Adds how the time per ray grows from a million primitives on, from the figures there are.
void add_growth(Report& report);

} // namespace celltrace::compare
