#include "celltrace_side.hpp"

#include <algorithm>

namespace celltrace::compare {

namespace {

RenderOptions options_of(int size, unsigned threads) {
  RenderOptions options;
  options.width = options.height = size;
  options.spes = threads;
  options.ray_queries = true;
  return options;
}

std::shared_ptr<const Mesh> mesh_of(const Model& model) {
  auto mesh = std::make_shared<Mesh>();
  mesh->vertices = model.vertices;
  mesh->triangles.reserve(model.triangles.size());
  for (const auto& [a, b, c] : model.triangles)
    mesh->triangles.push_back({{a, b, c}});
  return mesh;
}

} // namespace

CelltraceSide::CelltraceSide(int size, unsigned threads) : renderer_(options_of(size, threads)) {
  scene_.background = Vec3(kBackground[0], kBackground[1], kBackground[2]);
  scene_.gamma_mode = GammaMode::none;
  scene_.max_trace_level = 1;
  Material grey;
  grey.pigment.rgb = Vec3(kPigment);
  grey.finish.diffuse = kDiffuse;
  grey.finish.ambient = Vec3(kAmbient);
  scene_.add(grey);
  scene_.add(Interior{});
}

void CelltraceSide::take(const Model& model) {
  scene_.camera = model.camera;
  scene_.lights = {Light{model.light}};
  scene_.objects.clear();
  if (!model.triangles.empty()) scene_.objects.push_back({mesh_of(model), {}});
  scene_.objects.reserve(scene_.objects.size() + model.spheres.size());
  for (const glm::vec4& sphere : model.spheres)
    scene_.objects.push_back({Sphere{Vec3(sphere), sphere.w}, {}});
}

Frame CelltraceSide::build_and_trace() {
  Frame frame = render(scene_);
  const RenderStatistics& statistics = result_.statistics;
  frame.build.wall = statistics.build_seconds + statistics.prepare_seconds;
  accelerator_bytes_ = statistics.accelerator_bytes;
  return frame;
}

Frame CelltraceSide::refit_and_trace() {
  Frame frame = render(scene_, SceneChanges{true, false});
  const RenderStatistics& statistics = result_.statistics;
  frame.build.wall = statistics.build_seconds + statistics.prepare_seconds;
  return frame;
}

Frame CelltraceSide::trace() {
  return render(scene_.camera);
}

CelltraceQueries::CelltraceQueries(const Model& model, Kind kind)
    : side_(16, 1), queries_((side_.take(model), side_.build_and_trace(), side_.queries())), kind_(kind) {
}

void CelltraceQueries::closest_hits(std::span<const Ray> rays, std::span<float> distances) {
  if (kind_ == Kind::single) {
    std::transform(rays.begin(), rays.end(), distances.begin(),
                   [this](const Ray& ray) { return queries_.closest_hit(ray).distance; });
    return;
  }
  // As applications ask that use hits while these are in the caches: tile by tile.
  constexpr std::size_t kTile = 4096;
  hits_.resize(kTile);
  for (std::size_t first = 0; first < rays.size(); first += kTile) {
    const std::size_t count = std::min(kTile, rays.size() - first);
    queries_.closest_hits(rays.subspan(first, count), std::span(hits_).first(count));
    std::transform(hits_.begin(), hits_.begin() + static_cast<std::ptrdiff_t>(count),
                   distances.begin() + static_cast<std::ptrdiff_t>(first),
                   [](const RayHit& hit) { return hit.distance; });
  }
}

/// The statistics have no processor time; what the call took in all goes to `trace`.
template <class... Input> Frame CelltraceSide::render(const Input&... input) {
  const Stopwatch stopwatch;
  result_ = renderer_.render(input...);
  const RenderStatistics& statistics = result_.statistics;
  Frame frame;
  frame.trace = {statistics.render_seconds, stopwatch.elapsed().processor};
  frame.primary_rays = statistics.primary_rays;
  frame.shadow_rays = statistics.shadow_rays;
  return frame;
}

} // namespace celltrace::compare
