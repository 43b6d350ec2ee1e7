#include "render/frame_setup.hpp"

#include "celltrace/balance.hpp"
#include "celltrace/error.hpp"
#include "kernel/cameras/list.hpp"
#include "kernel/direct/door.hpp"
#include "scene/surface_records.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

/// Of the 112 KB that a program of this size leaves of a local store, 39 KB are the ray stack's and the
/// packets'.
constexpr std::uint32_t kMaxCacheBytes = 70 * 1024;
constexpr int kMaxEdge = 65520; // rows of packets fit the balancer's words

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

bool is_inside(const Medium& medium, const Vec3& point) {
  // Hardly any of a million spheres is worth an inverse: most do not even have the point in their box.
  const Sphere& sphere = medium.sphere;
  const Transform& transform = medium.transform;
  const Vec3 away = point - transform.point(sphere.centre);
  constexpr double kRoundedUp = 1.000001;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 reach(transform.rows[0][axis], transform.rows[1][axis], transform.rows[2][axis]);
    if (away[axis] * away[axis] > glm::dot(reach, reach) * sphere.radius * sphere.radius * kRoundedUp)
      return false;
  }
  const Vec3 local = transform.inverse().point(point) - sphere.centre;
  return local.x * local.x + local.y * local.y + local.z * local.z < sphere.radius * sphere.radius;
}

void set_flat(FrameBlock& frame, const Camera& camera, bool parallel) {
  const double w = frame.width;
  const double h = frame.height;
  store(parallel ? camera.direction : camera.location, frame.camera.origin);
  store(parallel ? camera.location : camera.direction, frame.camera.base);
  store(camera.right / w, frame.camera.dx);
  store(-camera.up / h, frame.camera.dy);
  frame.camera.middle_x = static_cast<float>(0.5 * w - 0.5);
  frame.camera.middle_y = static_cast<float>(0.5 * h - 0.5);
}

/// A vector of no length stays that.
Vec3 unit(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : v;
}

template <class Kind> void set_curved(FrameBlock& frame, const Camera& camera) {
  constexpr double kRadiansPerDegree = std::numbers::pi / 180;
  const CameraPicture picture =
      Kind::picture({camera.angle * kRadiansPerDegree, camera.vertical_angle * kRadiansPerDegree,
                     glm::length(camera.right), glm::length(camera.up)});
  const auto axis = [](const Vec3& v) { return Kind::kHasUnitAxes ? unit(v) : v; };
  CameraRecord& record = frame.camera;
  store(camera.location, record.origin);
  store(axis(camera.direction), record.base);
  store(axis(camera.right), record.dx);
  store(axis(camera.up), record.dy);
  const double step_x = 2 * picture.half_width / frame.width;
  const double step_y = 2 * picture.half_height / frame.height;
  record.middle_x = static_cast<float>(0.5 * frame.width - 0.5);
  record.middle_y = static_cast<float>(0.5 * frame.height - 0.5 + (step_y > 0 ? picture.middle / step_y : 0));
  record.step_x = static_cast<float>(step_x);
  record.step_y = static_cast<float>(step_y);
  record.bend = static_cast<float>(picture.bend);
}

/// Whether what a ray is in can make a difference where it hits the material. Maps are taken for ones with
/// such entries.
bool asks_for_interiors(const Material& material) {
  if (material.map) return true;
  for (const Material* layer = &material; layer != nullptr; layer = layer->below.get())
    if (layer->pigment.map || !is_opaque(layer->pigment) || layer->finish.reflection_fresnel) return true;
  return false;
}

} // namespace

void check(const RenderOptions& options) {
  if (options.model == Model::pipeline_split && options.accelerator == Accelerator::bvh)
    throw InputError("the split pipeline finds objects by the grid");
  if (options.width < 1 || options.width > kMaxEdge || options.height < 1 || options.height > kMaxEdge)
    throw InputError("the picture's width and height have to be 1 to " + std::to_string(kMaxEdge) +
                     " pixels");
  if (std::int64_t{options.width} * options.height > kMaxImagePixels)
    throw InputError("the picture has to have at most " + std::to_string(kMaxImagePixels) + " pixels");
  if (!options.cache.valid())
    throw InputError("the cache has to have a power of two of ways and a power of two of sets, and at most " +
                     std::to_string(CacheConfig::kMaxLines) + " lines");
  if (options.backend != "native" && options.cache.local_store_bytes() > kMaxCacheBytes)
    throw InputError("the cache takes " + std::to_string(options.cache.local_store_bytes()) +
                     " bytes of local store; beside the program there is room for " +
                     std::to_string(kMaxCacheBytes));
  if (options.max_trace_level && (*options.max_trace_level < 1 || *options.max_trace_level > 256))
    throw InputError("the maximum trace level has to be 1 to 256");
  if (options.adc_bailout && !(*options.adc_bailout >= 0))
    throw InputError("the adaptive depth control's bailout must not be negative");
}

void set_options(FrameBlock& frame, const RenderOptions& options, const Machine& machine) {
  const auto blocks = [](std::uint32_t count, std::uint32_t edge) { return (count + edge - 1) / edge; };
  const std::uint32_t edge = bundle_edge(machine.direct_memory());
  frame.width = static_cast<std::uint32_t>(options.width);
  frame.height = static_cast<std::uint32_t>(options.height);
  frame.packet_columns = blocks(frame.width, kPacketEdge);
  frame.packet_rows = blocks(frame.height, kPacketEdge);
  frame.bundle_columns = blocks(frame.packet_columns, edge);
  frame.bundle_rows = blocks(frame.packet_rows, edge);
  frame.surface_pitch = frame.packet_columns * kPacketEdge * 4;
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
  frame.light_places = 0;
  for (const Light& light : scene.lights)
    frame.light_places += light.area ? static_cast<std::uint32_t>(light.area->columns * light.area->rows) : 1;
  frame.max_trace_level =
      static_cast<std::uint32_t>(std::clamp(options.max_trace_level.value_or(scene.max_trace_level), 1, 256));
  frame.adc_bailout = static_cast<float>(options.adc_bailout.value_or(scene.adc_bailout));
  frame.gamma_encoding = static_cast<std::uint32_t>(
      scene.gamma_mode == GammaMode::assumed ? GammaEncoding::assumed : GammaEncoding::none);
  frame.assumed_gamma = static_cast<float>(scene.assumed_gamma);
  store(scene.background, frame.background);
  frame.sky = header.sky;
}

std::vector<Medium> media_of(const Scene& scene) {
  if (std::none_of(scene.materials.begin(), scene.materials.end(), asks_for_interiors)) return {};
  std::vector<Medium> media;
  for (const Object& object : scene.objects)
    if (const auto* sphere = std::get_if<Sphere>(&object.shape); sphere != nullptr && sphere->radius != 0)
      media.push_back({*sphere, object.transform, object.interior});
  return media;
}

void set_camera(FrameBlock& frame, const Camera& camera, const std::vector<Medium>& media,
                const SceneImage& image) {
  frame.camera = CameraRecord{};
  frame.camera.kind = static_cast<std::uint32_t>(camera.kind);
  Cameras::dispatch(frame.camera.kind, [&](auto kind) {
    using Kind = decltype(kind);
    if constexpr (Kind::kIsFlat)
      set_flat(frame, camera, Kind::kShared == SharedByRays::direction);
    else
      set_curved<Kind>(frame, camera);
  });

  std::vector<std::pair<double, std::uint32_t>> around;
  for (const Medium& medium : media) {
    if (!is_inside(medium, camera.location)) continue;
    const double radius = std::abs(medium.sphere.radius);
    around.emplace_back(std::abs(medium.transform.determinant()) * radius * radius * radius,
                        image.header().interior_offset +
                            medium.interior * static_cast<std::uint32_t>(sizeof(InteriorRecord)));
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
