#include "render/frame_setup.hpp"

#include "celltrace/balance.hpp"
#include "celltrace/error.hpp"
#include "kernel/cameras/list.hpp"
#include "render/far_camera.hpp"
#include "render/quality.hpp"
#include "scene_image/object_records.hpp"
#include "scene_image/surface_records.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <type_traits>

#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

/// Of the 112 KB that a program of this size leaves of a local store, 39 KB are the ray stack's and the
/// packets'.
constexpr std::uint32_t kMaxCacheBytes = 70 * 1024;
/// Bits of light_way that pictures ask for; scenes have the others.
constexpr std::uint32_t kWaysOfPictures = light_way::alpha | light_way::first_hits;

void store(const Vec3& v, float* to) {
  for (int i = 0; i < 3; ++i)
    to[i] = static_cast<float>(v[i]);
}

/// Voxels per unit of length so that a box holds `wanted` cubes. An axis that is too short for more than one
/// layer does not count: the others share what it leaves.
double voxels_per_unit(std::array<double, 3> extent, double wanted) {
  std::sort(extent.begin(), extent.end(), std::greater<>());
  double per_unit = 0;
  double size = 1;
  for (int axes = 1; axes <= 3; ++axes) {
    size *= extent[axes - 1];
    const double density = std::pow(wanted / size, 1.0 / axes);
    if (axes > 1 && extent[axes - 1] * density < 1) break;
    per_unit = density;
  }
  return per_unit;
}

AcceleratorKind accelerator_of(const RenderOptions& options) {
  const bool pipeline = options.model == Model::pipeline || options.model == Model::pipeline_split;
  if (pipeline && options.accelerator == Accelerator::automatic) return AcceleratorKind::grid;
  return options.accelerator == Accelerator::grid ? AcceleratorKind::grid : AcceleratorKind::bvh;
}

double middle_x(const PictureOnGrid& picture) {
  return picture.left + 0.5 * picture.width - 0.5;
}
double middle_y(const PictureOnGrid& picture) {
  return picture.top + 0.5 * picture.height - 0.5;
}

/// How many rows below the middle a perspective picture has its horizon, that of floors if up is nearly the y
/// axis; 0 if it has none.
double horizon_row(const Vec3& middle, const Vec3& row, double height) {
  int up = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(row[axis]) > std::abs(row[up])) up = axis;
  const double exact = row[up] != 0 ? -middle[up] / row[up] : 0;
  return std::abs(exact) <= height / 2 ? std::round(exact) : 0;
}

void set_flat(CameraRecord& record, const Camera& camera, const PictureOnGrid& picture, bool parallel) {
  record.sheaf = static_cast<std::uint32_t>(parallel ? RaySheaf::parallel : RaySheaf::pinhole);
  const Vec3 row = -camera.up / picture.height;
  Vec3 base = parallel ? camera.location : camera.direction;
  // Counted from the horizon: what single precision leaves of the difference of two directions decides how
  // far away its rays meet a floor, and on which of its squares.
  const double first_row = parallel ? 0 : horizon_row(base, row, picture.height);
  base += row * first_row;
  store(parallel ? camera.direction : camera.location, record.origin);
  store(base, record.base);
  store(camera.right / picture.width, record.dx);
  store(row, record.dy);
  record.middle_x = static_cast<float>(middle_x(picture));
  record.middle_y = static_cast<float>(middle_y(picture) + first_row);
}

/// A vector of no length stays that.
Vec3 unit(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : v;
}

template <class Kind>
void set_curved(CameraRecord& record, const Camera& camera, const PictureOnGrid& on_grid) {
  record.sheaf = static_cast<std::uint32_t>(RaySheaf::made);
  constexpr double kRadiansPerDegree = std::numbers::pi / 180;
  const CameraPicture picture =
      Kind::picture({camera.angle * kRadiansPerDegree, camera.vertical_angle * kRadiansPerDegree,
                     glm::length(camera.right), glm::length(camera.up)});
  const auto axis = [](const Vec3& v) { return Kind::kHasUnitAxes ? unit(v) : v; };
  store(camera.location, record.origin);
  store(axis(camera.direction), record.base);
  store(axis(camera.right), record.dx);
  store(axis(camera.up), record.dy);
  const double step_x = 2 * picture.half_width / on_grid.width;
  const double step_y = 2 * picture.half_height / on_grid.height;
  record.middle_x = static_cast<float>(middle_x(on_grid));
  record.middle_y = static_cast<float>(middle_y(on_grid) + (step_y > 0 ? picture.middle / step_y : 0));
  record.step_x = static_cast<float>(step_x);
  record.step_y = static_cast<float>(step_y);
  record.bend = static_cast<float>(picture.bend);
}

/// Rays start that far ahead of the camera.
CameraRecord far_record(Camera camera, const PictureOnGrid& picture, double start) {
  const double length = glm::length(camera.direction);
  CameraRecord record{};
  record.kind = static_cast<std::uint32_t>(camera.kind);
  Cameras::dispatch(record.kind, [&](auto kind) {
    using Kind = decltype(kind);
    if constexpr (Kind::kShared == SharedByRays::direction) {
      camera.location += camera.direction * start;
      set_flat(record, camera, picture, true);
      record.ahead = static_cast<float>(start * length * length);
    } else if constexpr (Kind::kIsFlat) {
      record.sheaf = static_cast<std::uint32_t>(RaySheaf::made);
      record.ahead = static_cast<float>(start * length);
      store(camera.location + camera.direction * start, record.origin);
      store(camera.direction / length, record.base);
      store(camera.right / (length * picture.width), record.dx);
      store(camera.up / (length * picture.height), record.dy);
      record.middle_x = static_cast<float>(middle_x(picture));
      record.middle_y = static_cast<float>(middle_y(picture));
      record.step_x = record.step_y = 1;
    } else {
      if (std::is_same_v<Kind, SphericalCamera>) {
        // As it turns, which is not always toward its axes.
        const Vec3 forward = unit(camera.direction), right = unit(camera.right), up = unit(camera.up);
        camera.right = glm::cross(up, forward) * glm::length(camera.right);
        camera.up = glm::cross(forward, right) * glm::length(camera.up);
      }
      record.ahead = static_cast<float>(start);
      camera.location += unit(camera.direction) * start;
      set_curved<Kind>(record, camera, picture);
    }
  });
  return record;
}

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

/// Checks how many pixels are in memory at a time.
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

/// How far samples are moved, in pixels.
double jitter_of(const Antialiasing& antialiasing) {
  const bool fixed = antialiasing.method == Antialiasing::Method::fixed;
  return antialiasing.jitter / (fixed ? antialiasing.depth : (1 << antialiasing.depth) + 1);
}

/// By which colours become linear.
double exponent_of(const Scene& scene) {
  constexpr double kOfSrgb = 2.4; // but for the darkest colours
  switch (scene.gamma_mode) {
  case GammaMode::none:
    break;
  case GammaMode::srgb:
    return kOfSrgb;
  case GammaMode::assumed:
    return scene.assumed_gamma;
  }
  return 1;
}

/// POV-Ray makes colours linear before it compares them.
void set_comparison(FrameBlock& frame, const RenderOptions& options) {
  if (options.antialiasing)
    frame.sampling.inverse_gamma = frame.assumed_gamma / static_cast<float>(options.antialiasing->gamma);
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

void set_options(FrameBlock& frame, const RenderOptions& options, const Machine& machine) {
  const auto blocks = [](std::uint32_t count, std::uint32_t edge) { return (count + edge - 1) / edge; };
  const std::uint32_t edge = bundle_edge(machine.direct_memory());
  const PictureRegion region = region_of(options);
  frame.width = static_cast<std::uint32_t>(region.right - region.left);
  frame.height = static_cast<std::uint32_t>(region.bottom - region.top);
  frame.purpose = static_cast<std::uint32_t>(brings_colours(options) ? FramePurpose::grid
                                             : options.blocks        ? FramePurpose::blocks
                                                                     : FramePurpose::picture);
  frame.light_ways &= ~kWaysOfPictures;
  if (options.alpha) frame.light_ways |= light_way::alpha;
  if (options.first_hits) frame.light_ways |= light_way::first_hits;
  frame.sampling = SamplingRecord{};
  if (const auto& antialiasing = options.antialiasing) {
    frame.purpose = static_cast<std::uint32_t>(FramePurpose::grid);
    ++frame.width;
    ++frame.height;
    frame.sampling.method = static_cast<std::uint32_t>(antialiasing->method == Antialiasing::Method::fixed
                                                           ? SamplingMethod::fixed
                                                           : SamplingMethod::adaptive);
    frame.sampling.depth = static_cast<std::uint32_t>(antialiasing->depth);
    frame.sampling.threshold = static_cast<float>(antialiasing->threshold);
    frame.sampling.jitter = static_cast<float>(jitter_of(*antialiasing));
  }
  set_comparison(frame, options);
  frame.packet_columns = blocks(frame.width, kPacketEdge);
  frame.packet_rows = blocks(frame.height, kPacketEdge);
  frame.bundle_columns = blocks(frame.packet_columns, edge);
  frame.surface_pitch = frame.packet_columns * kPacketEdge * 4;
  if (options.blocks) frame.surface_pitch = (frame.packet_columns + 1) / 2 * 16;
  if (brings_colours(options))
    frame.sampling.colours_pitch =
        frame.packet_columns * kPacketEdge * static_cast<std::uint32_t>(sizeof(ColourRecord));
  frame.cache_ways = options.cache.ways;
  frame.cache_sets = options.cache.sets;
  frame.cache_replacement = static_cast<std::uint32_t>(options.cache.replacement);
  frame.cache_enabled = options.cache.enabled ? 1 : 0;
  frame.accelerator = static_cast<std::uint32_t>(accelerator_of(options));
  frame.exchange_parameter = options.balance == Balance::gde
                                 ? fixed_point_parameter(optimal_chain_parameter(machine.spe_count()))
                                 : 0;
}

void set_scene(FrameBlock& frame, const Scene& scene, const RenderOptions& options, const SceneImage& image) {
  const ImageHeader& header = image.header();
  frame.image = reinterpret_cast<std::uintptr_t>(image.base());
  frame.object_offset = header.object_offset;
  frame.object_count = header.object_count;
  frame.unbounded_count = header.unbounded_count;
  frame.group_offset = header.group_offset;
  frame.group_count = header.group_count;
  frame.longest_group = header.longest_group;
  frame.prototype_offset = header.prototype_count != 0 ? header.prototype_offset : 0;
  frame.light_offset = header.light_offset;
  frame.light_count = header.light_count;
  frame.fog_offset = header.fog_offset;
  frame.fog_count = header.fog_count;
  frame.light_ways = header.light_ways | (frame.light_ways & kWaysOfPictures);
  // Their stages cannot walk: light is dimmed by what lies within POV-Ray's tolerance, too.
  if (options.model != Model::shared) frame.light_ways &= ~(light_way::near_surfaces | light_way::restarts);
  constexpr double kVersionOfTransparency = 3.7;
  const bool has_backdrop = scene.version >= kVersionOfTransparency;
  if (!has_backdrop) frame.light_ways |= light_way::no_backdrop;
  frame.background_clear =
      has_backdrop ? static_cast<float>(std::clamp(scene.background_transparency, 0.0, 1.0)) : 1.0f;
  frame.rainbow_offset = header.rainbow_offset;
  frame.rainbow_count = header.rainbow_count;
  if (options.model != Model::shared && (header.light_ways & light_way::stepwise) != 0)
    throw InputError("interiors that fade, throw caustics or look different from inside, and lights that fog "
                     "dims, need the shared model");
  if (options.model != Model::shared && (header.light_ways & light_way::projectors) != 0)
    throw InputError("lights that are projected through something need the shared model");
  frame.light_places = 0;
  if (std::any_of(scene.lights.begin(), scene.lights.end(),
                  [](const Light& light) { return light.area && light.area->jitter; }))
    frame.light_ways |= light_way::jitter;
  for (const Light& light : scene.lights)
    frame.light_places += light.area ? static_cast<std::uint32_t>(light.area->columns * light.area->rows) : 1;
  frame.max_trace_level =
      static_cast<std::uint32_t>(std::clamp(options.max_trace_level.value_or(scene.max_trace_level), 1, 256));
  if (options.quality < kRaysGoOn) frame.max_trace_level = 1;
  frame.adc_bailout = static_cast<float>(options.adc_bailout.value_or(scene.adc_bailout));
  frame.gamma_encoding = static_cast<std::uint32_t>(
      scene.gamma_mode == GammaMode::assumed ? GammaEncoding::assumed : GammaEncoding::none);
  frame.assumed_gamma = static_cast<float>(exponent_of(scene));
  set_comparison(frame, options);
  frame.sky = header.sky;
  const bool is_mirrored = options.alpha && scene.mirrored_background && frame.sky == kNoOffset;
  if (is_mirrored) frame.light_ways |= light_way::mirrored_background;
  store(is_mirrored ? *scene.mirrored_background : scene.background, frame.background);
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

PictureOnGrid picture_on_grid(const RenderOptions& options) {
  const PictureRegion region = region_of(options);
  // One more point than pixels each way: the pixels' corners, or their middles from those before the first
  // one on.
  const auto& antialiasing = options.antialiasing;
  const bool fixed = antialiasing && antialiasing->method == Antialiasing::Method::fixed;
  const double first = !antialiasing ? 0.0 : fixed ? 1.0 : 0.5;
  return {static_cast<double>(options.width), static_cast<double>(options.height), first - region.left,
          first - region.top};
}

namespace {

/// Returns the camera for a picture of that width and height.
Camera framed(Camera camera, double width, double height) {
  const double own = glm::length(camera.right) / glm::length(camera.up);
  // By which the picture is wider than the camera's view.
  const double wider = width / height / own;
  if (camera.framing == Camera::Framing::fixed || !(wider > 0) || !std::isfinite(wider)) return camera;
  if (camera.framing == Camera::Framing::whole && wider > 1)
    camera.right *= wider;
  else
    camera.up /= wider;
  return camera;
}

} // namespace

CameraRecord camera_record(const Camera& any_picture, const PictureOnGrid& picture, const SceneImage* image) {
  Camera camera = framed(any_picture, picture.width, picture.height);
  // Samples are up to a pixel beyond the picture.
  const double margin = 4 / std::min(picture.width, picture.height);
  const double start = image != nullptr ? start_of_rays(camera, margin, *image) : 0;
  if (start > 0) return far_record(camera, picture, start);
  CameraRecord record{};
  record.kind = static_cast<std::uint32_t>(camera.kind);
  Cameras::dispatch(record.kind, [&](auto kind) {
    using Kind = decltype(kind);
    if constexpr (Kind::kIsFlat)
      set_flat(record, camera, picture, Kind::kShared == SharedByRays::direction);
    else
      set_curved<Kind>(record, camera, picture);
  });
  return record;
}

void set_camera(FrameBlock& frame, const Camera& camera, const PictureOnGrid& picture,
                const std::vector<Medium>& media, const SceneImage& image) {
  frame.camera = camera_record(camera, picture, &image);
  std::vector<std::pair<double, std::uint32_t>> around;
  for (const Medium& medium : media) {
    if (!medium.contains(camera.location)) continue;
    around.emplace_back(medium.volume(), offset_of_interior(image.header().interior_offset, medium.interior));
  }
  std::sort(around.begin(), around.end(), std::greater<>());
  const std::size_t kept = std::min<std::size_t>(around.size(), kMaxInteriorDepth);
  frame.camera_interior_count = static_cast<std::uint32_t>(kept);
  for (std::size_t i = 0; i < kept; ++i)
    frame.camera_interiors[i] = around[around.size() - kept + i].second;
}

GridRecord choose_grid(const ImageHeader& header) {
  // About eight voxels an object; more cost memory and steps, fewer cost intersection tests.
  constexpr double kVoxelsPerObject = 8;
  constexpr double kMaxCellsPerAxis = 512;
  constexpr double kMaxCells = 1 << 24;
  std::array<double, 3> extent;
  double longest = 0;
  for (int i = 0; i < 3; ++i) {
    extent[i] = double{header.bounds_max[i]} - double{header.bounds_min[i]};
    longest = std::max(longest, extent[i]);
  }
  for (double& e : extent)
    e = std::max(e, longest * 1e-4); // flat scenes
  const double wanted = std::clamp(kVoxelsPerObject * header.object_count, 1.0, kMaxCells);
  const double per_unit = voxels_per_unit(extent, wanted);
  GridRecord grid{};
  for (int i = 0; i < 3; ++i) {
    const double cells = std::clamp(std::round(extent[i] * per_unit), 1.0, kMaxCellsPerAxis);
    const double middle = 0.5 * (double{header.bounds_min[i]} + double{header.bounds_max[i]});
    grid.cells[i] = static_cast<std::uint32_t>(cells);
    grid.min[i] = static_cast<float>(middle - 0.5 * extent[i]);
    grid.max[i] = static_cast<float>(middle + 0.5 * extent[i]);
    grid.cell_size[i] = static_cast<float>(extent[i] / cells);
    grid.inverse_cell_size[i] = static_cast<float>(cells / extent[i]);
  }
  grid.row_of_cells = grid.cells[0] * grid.cells[1];
  return grid;
}

} // namespace celltrace
