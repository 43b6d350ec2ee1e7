// The options for the part of a picture that is rendered, and for its antialiasing.
#pragma once

#include "celltrace/render.hpp"

#include <optional>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

/// Numbers that CLI11 fills in.
struct SamplingTexts {
  std::optional<double> antialias; ///< the threshold; none: no antialiasing
  int antialias_method = 1;
  Antialiasing antialiasing; ///< everything but method and threshold
  double start_column = 0, end_column = 1, start_row = 0, end_row = 1;
};

void add_region_options(CLI::App& command, SamplingTexts& texts);
void add_antialiasing_options(CLI::App& command, SamplingTexts& texts);

/// Returns the part of the picture that is to be rendered; none: all of it. Throws InputError if it is not in
/// the picture, or empty.
std::optional<PictureRegion> region_of(const SamplingTexts& texts, const RenderOptions& options);
/// Returns the antialiasing, or none.
std::optional<Antialiasing> antialiasing_of(const SamplingTexts& texts);

} // namespace celltrace::cli
