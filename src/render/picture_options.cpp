#include "render/picture_options.hpp"

#include "celltrace/cache.hpp"
#include "celltrace/error.hpp"
#include "records/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace celltrace {

using namespace kernel;

namespace {

/// Limit on the cache's size in bytes: the program leaves 112 KB of a local store, of which the ray stack and
/// the packets take 39 KB.
constexpr std::uint32_t kMaxCacheBytes = 70 * 1024;

void check(const Antialiasing& antialiasing, Model model) {
  if (model != Model::shared) throw InputError("antialiasing is for the shared programming model");
  if (antialiasing.depth < 1 || antialiasing.depth > static_cast<int>(kMaxSamplingDepth))
    throw InputError("the depth of antialiasing has to be 1 to " + std::to_string(kMaxSamplingDepth));
  if (!(antialiasing.threshold >= 0) || !std::isfinite(antialiasing.threshold))
    throw InputError("the threshold of antialiasing must not be negative");
  if (!(antialiasing.jitter >= 0 && antialiasing.jitter <= 1))
    throw InputError("the jitter of antialiasing has to be 0 to 1");
  if (!(antialiasing.gamma > 0) || !std::isfinite(antialiasing.gamma))
    throw InputError("the gamma of antialiasing has to be above 0");
}

std::uint64_t bytes_per_pixel(const RenderOptions& options) {
  return 4u + (options.antialiasing ? 16 : 0) +
         (options.colours || options.alpha || options.first_hits ? 32 : 0) + (options.first_hits ? 20 : 0);
}

/// Checks the number of pixels that are in memory at a time.
void check_memory(const RenderOptions& options) {
  const PictureRegion region = region_of(options);
  const int height = region.bottom - region.top;
  if (options.most_memory != 0) {
    const int rows = options.rows_at_once == 0 ? options.height : std::min(options.rows_at_once, height);
    const std::uint64_t bytes = bytes_per_pixel(options) * static_cast<std::uint64_t>(options.width) *
                                static_cast<std::uint64_t>(rows);
    if (bytes > options.most_memory)
      throw InputError("the picture takes " + std::to_string(bytes) + " bytes, and " +
                       std::to_string(options.most_memory) + " are allowed");
  }
  if (options.rows_at_once == 0) {
    if (std::int64_t{options.width} * options.height <= kMaxImagePixels) return;
    throw InputError("a picture of " + std::to_string(options.width) + "x" + std::to_string(options.height) +
                     " pixels is too large to be in memory as a whole: " + std::to_string(kMaxImagePixels) +
                     " pixels are the limit. RenderOptions::rows_at_once is for larger ones");
  }
  if (options.rows_at_once < 0 ||
      (options.rows_at_once % Renderer::kRowStep != 0 && options.rows_at_once < height))
    throw InputError("the rows to render at once have to be a multiple of " +
                     std::to_string(Renderer::kRowStep));
  if (std::int64_t{region.right - region.left} * std::min(options.rows_at_once, height) > kMaxImagePixels)
    throw InputError("the rows to render at once have to have at most " + std::to_string(kMaxImagePixels) +
                     " pixels");
  if (options.model != Model::shared && options.rows_at_once < height)
    throw InputError("rows are rendered one after the other by the shared programming model only");
  if (options.blocks) throw InputError("a picture in blocks is rendered as a whole");
}

} // namespace

void check(const RenderOptions& options) {
  if (options.model == Model::pipeline_split && options.accelerator == Accelerator::bvh)
    throw InputError("the split pipeline finds objects by the grid");
  if (options.width < 1 || options.width > kMaxImageSide || options.height < 1 ||
      options.height > kMaxImageSide)
    throw InputError("the picture's width and height have to be 1 to " + std::to_string(kMaxImageSide) +
                     " pixels");
  if (!options.cache.valid())
    throw InputError("the cache has to have a power of two of ways and a power of two of sets, and at most " +
                     std::to_string(CacheConfig::kMaxLines) + " lines");
  if (options.backend != Backend::native && options.cache.local_store_bytes() > kMaxCacheBytes)
    throw InputError("the cache takes " + std::to_string(options.cache.local_store_bytes()) +
                     " bytes of local store; beside the program there is room for " +
                     std::to_string(kMaxCacheBytes));
  if (options.max_trace_level && (*options.max_trace_level < 1 || *options.max_trace_level > 256))
    throw InputError("the maximum trace level has to be 1 to 256");
  if (options.adc_bailout && !(*options.adc_bailout >= 0))
    throw InputError("the adaptive depth control's bailout must not be negative");
  if (!(options.most_seconds >= 0)) throw InputError("the most seconds must not be negative");
  if (options.quality < 0 || options.quality > 11) throw InputError("the quality has to be 0 to 11");
  const PictureRegion region = region_of(options);
  if (region.left < 0 || region.left >= region.right || region.right > options.width || region.top < 0 ||
      region.top >= region.bottom || region.bottom > options.height)
    throw InputError("the region to render has no pixels, or some that are not in the picture");
  check_memory(options);
  if (options.antialiasing) check(*options.antialiasing, options.model);
  if (options.colours && options.model != Model::shared)
    throw InputError("colours as numbers are for the shared programming model");
  if (options.alpha && options.model != Model::shared)
    throw InputError("pictures with alpha are for the shared programming model");
  if (options.first_hits && options.model != Model::shared)
    throw InputError("what is seen first is told by the shared programming model");
  if (options.blocks && options.model != Model::shared)
    throw InputError("pictures in blocks are for the shared programming model");
  if (options.blocks && (options.antialiasing || options.region || brings_colours(options)))
    throw InputError(
        "pictures leave the SPEs in blocks without antialiasing, region, alpha, colours and first hits");
  if (options.blocks && options.finished_block) throw InputError("a picture in blocks cannot be watched");
}

RenderOptions with_picture_of(RenderOptions options, const RenderOptions& given) {
  options.width = given.width;
  options.height = given.height;
  options.region = given.region;
  options.antialiasing = given.antialiasing;
  options.colours = given.colours;
  options.alpha = given.alpha;
  options.first_hits = given.first_hits;
  options.blocks = given.blocks;
  options.work_map = given.work_map;
  options.finished_block = given.finished_block;
  options.rows_at_once = given.rows_at_once;
  return options;
}

bool brings_colours(const RenderOptions& options) {
  return options.colours || options.alpha || options.first_hits;
}

PictureRegion region_of(const RenderOptions& options) {
  return options.region.value_or(PictureRegion{0, options.width, 0, options.height});
}

} // namespace celltrace
