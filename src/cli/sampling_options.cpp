#include "cli/sampling_options.hpp"

#include "celltrace/error.hpp"
#include "cli/choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace celltrace::cli {

namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Returns how many columns or rows a fraction of the whole is. POV-Ray stores fractions in single precision.
double part_of(double part, int size) {
  return std::floor(double{static_cast<float>(part)} * size);
}
/// Returns the first column or row, counted as POV-Ray does: from 1, and below 1 as a fraction of the whole.
int first_of(double start, int size) {
  return static_cast<int>(std::min(start < 1 ? part_of(start, size) : std::floor(start) - 1, 1e9));
}
int end_of(double end, int size) {
  return static_cast<int>(std::min(end <= 1 ? part_of(end, size) : std::floor(end), 1e9));
}
void check_part(int first, int end, int size, const char* what) {
  if (end > size || first >= size)
    throw InputError(std::string("the ") + what + " to render are not all in the picture, which has " +
                     std::to_string(size));
  if (first >= end) throw InputError(std::string("there are no ") + what + " to render");
}

} // namespace

void add_region_options(CLI::App& command, SamplingTexts& texts) {
  const auto add = [&](const std::string& name, double& value, const std::string& what) {
    command.add_option(name, value, what)->check(number_range(0, kNoLimit))->type_name("N|FRACTION");
  };
  add("--start-column", texts.start_column,
      "The first column to render: a number from 1 on, or less than 1 for a fraction of the width");
  add("--end-column", texts.end_column,
      "The last column to render: a number above 1, or up to 1 for a fraction of the width");
  add("--start-row", texts.start_row,
      "The first row to render: a number from 1 on, or less than 1 for a fraction of the height");
  add("--end-row", texts.end_row,
      "The last row to render: a number above 1, or up to 1 for a fraction of the height");
}

void add_antialiasing_options(CLI::App& command, SamplingTexts& texts) {
  command
      .add_option("--antialias", texts.antialias,
                  "Trace more rays for pixels whose colours differ by this much or more")
      ->check(number_range(0, 3))
      ->type_name("THRESHOLD");
  command
      .add_option(
          "--antialias-method", texts.antialias_method,
          "Pixels whose colours differ get 1: equally many samples; 2: more samples, the more colours differ")
      ->check(CLI::Range(1, 2))
      ->capture_default_str();
  command
      .add_option("--antialias-depth", texts.antialiasing.depth,
                  "Method 1: N x N samples for a pixel; method 2: limit on how often a pixel is divided")
      ->check(CLI::Range(1, 9))
      ->capture_default_str();
  command
      .add_option("--antialias-jitter", texts.antialiasing.jitter,
                  "Random offset of samples, in distances between samples; 0: none")
      ->check(number_range(0, 1))
      ->capture_default_str();
  command.add_option("--antialias-gamma", texts.antialiasing.gamma, "Gamma of the colours that are compared")
      ->check(number_range(0.01, 100))
      ->capture_default_str();
}

std::optional<PictureRegion> region_of(const SamplingTexts& texts, const RenderOptions& options) {
  check_number(texts.start_column, "--start-column");
  check_number(texts.end_column, "--end-column");
  check_number(texts.start_row, "--start-row");
  check_number(texts.end_row, "--end-row");
  const PictureRegion region = {
      first_of(texts.start_column, options.width), end_of(texts.end_column, options.width),
      first_of(texts.start_row, options.height), end_of(texts.end_row, options.height)};
  check_part(region.left, region.right, options.width, "columns");
  check_part(region.top, region.bottom, options.height, "rows");
  if (region.right - region.left == options.width && region.bottom - region.top == options.height)
    return std::nullopt;
  return region;
}

std::optional<Antialiasing> antialiasing_of(const SamplingTexts& texts) {
  if (!texts.antialias) return std::nullopt;
  Antialiasing antialiasing = texts.antialiasing;
  antialiasing.threshold = *texts.antialias;
  antialiasing.method =
      texts.antialias_method == 1 ? Antialiasing::Method::fixed : Antialiasing::Method::adaptive;
  return antialiasing;
}

} // namespace celltrace::cli
