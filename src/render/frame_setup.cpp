#include "render/frame_setup.hpp"

#include "celltrace/balance.hpp"
#include "celltrace/error.hpp"
#include "kernel/strategy.hpp"
#include "records/light_feature.hpp"
#include "render/picture_options.hpp"
#include "render/quality.hpp"
#include "scene_image/record_vectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace celltrace {

using namespace kernel;

namespace {

/// The bits of light_feature that depend on pictures; the others depend on scenes.
constexpr std::uint32_t kPictureFeatures = light_feature::alpha | light_feature::first_hits;

/// Returns the voxels per unit of length for which a box holds `wanted` cubes. An axis too short for more
/// than one layer is ignored: the other axes share all cubes.
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

/// Returns how far samples are moved, in pixels.
double jitter_of(const Antialiasing& antialiasing) {
  const bool fixed = antialiasing.method == Antialiasing::Method::fixed;
  return antialiasing.jitter / (fixed ? antialiasing.depth : (1 << antialiasing.depth) + 1);
}

/// Returns the exponent that makes colours linear.
double exponent_of(const Scene& scene) {
  constexpr double kOfSrgb = 2.4; // correct for all but the darkest colours
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

/// Sets how colours are compared: POV-Ray makes them linear first.
void set_comparison(FrameBlock& frame, const RenderOptions& options) {
  if (options.antialiasing)
    frame.sampling.inverse_gamma = frame.assumed_gamma / static_cast<float>(options.antialiasing->gamma);
}

} // namespace

void set_options(FrameBlock& frame, const RenderOptions& options, const Machine& machine) {
  const auto blocks = [](std::uint32_t count, std::uint32_t edge) { return (count + edge - 1) / edge; };
  const std::uint32_t edge = bundle_edge(machine.direct_memory());
  const PictureRegion region = region_of(options);
  frame.width = static_cast<std::uint32_t>(region.right - region.left);
  frame.height = static_cast<std::uint32_t>(region.bottom - region.top);
  frame.purpose = static_cast<std::uint32_t>(brings_colours(options) ? FramePurpose::grid
                                             : options.blocks        ? FramePurpose::blocks
                                                                     : FramePurpose::picture);
  frame.light_features &= ~kPictureFeatures;
  if (options.alpha) frame.light_features |= light_feature::alpha;
  if (options.first_hits) frame.light_features |= light_feature::first_hits;
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
  frame.light_features = header.light_features | (frame.light_features & kPictureFeatures);
  // Stages of other models cannot step over surfaces within POV-Ray's tolerance, so that these surfaces dim
  // light, too.
  if (options.model != Model::shared)
    frame.light_features &= ~(light_feature::near_surfaces | light_feature::restarts);
  constexpr double kVersionOfTransparency = 3.7;
  const bool has_backdrop = scene.version >= kVersionOfTransparency;
  if (!has_backdrop) frame.light_features |= light_feature::no_backdrop;
  frame.background_transparency =
      has_backdrop ? static_cast<float>(std::clamp(scene.background_transparency, 0.0, 1.0)) : 1.0f;
  frame.rainbow_offset = header.rainbow_offset;
  frame.rainbow_count = header.rainbow_count;
  if (options.model != Model::shared && (header.light_features & light_feature::stepwise) != 0)
    throw InputError("interiors that fade, throw caustics or look different from inside, and lights that fog "
                     "dims, need the shared model");
  if (options.model != Model::shared && (header.light_features & light_feature::projectors) != 0)
    throw InputError("lights that are projected through something need the shared model");
  frame.light_places = 0;
  if (std::any_of(scene.lights.begin(), scene.lights.end(),
                  [](const Light& light) { return light.area && light.area->jitter; }))
    frame.light_features |= light_feature::jitter;
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
  if (is_mirrored) frame.light_features |= light_feature::mirrored_background;
  copy(is_mirrored ? *scene.mirrored_background : scene.background, frame.background);
}

GridRecord choose_grid(const ImageHeader& header) {
  // About eight voxels per object: more voxels cost memory and steps, fewer voxels cost intersection tests.
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
    e = std::max(e, longest * 1e-4); // for flat scenes
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
