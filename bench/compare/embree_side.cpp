#include "embree_side.hpp"

#include "celltrace/error.hpp"
#include "embree_trace.hpp"
#include "query_side.hpp"

#include <algorithm>
#include <atomic>
#include <thread>
#include <type_traits>
#include <vector>

namespace celltrace::compare {

namespace {

template <auto release> struct Release {
  template <class Handle> void operator()(Handle* handle) const { release(handle); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release<rtcReleaseDevice>>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release<rtcReleaseScene>>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, Release<rtcReleaseGeometry>>;

Device make_device(unsigned threads) {
  Device device(rtcNewDevice(("threads=" + std::to_string(threads)).c_str()));
  if (!device) throw Error("Embree cannot make a device");
  return device;
}

RTCBuildQuality quality_of(EmbreeConfig::Quality quality) {
  switch (quality) {
  case EmbreeConfig::Quality::high:
    return RTC_BUILD_QUALITY_HIGH;
  case EmbreeConfig::Quality::medium:
    return RTC_BUILD_QUALITY_MEDIUM;
  case EmbreeConfig::Quality::refit:
    return RTC_BUILD_QUALITY_REFIT;
  default:
    return RTC_BUILD_QUALITY_LOW;
  }
}

void copy(const Vec3& from, float (&to)[3]) {
  for (int i = 0; i < 3; ++i)
    to[i] = static_cast<float>(from[i]);
}

class EmbreeSide : public Side {
public:
  EmbreeSide(int size, unsigned threads, const EmbreeConfig& config)
      : config_(config), threads_(threads), picture_(size, size), device_(make_device(threads)) {
    rtcSetDeviceMemoryMonitorFunction(device_.get(), count_memory, &memory_);
    frame_.packet = config.packet;
    frame_.size = size;
    frame_.rgba = picture_.rgba.data();
  }

  void take(const Model& model) override {
    const bool same_shape = spheres_.size() == model.spheres.size() && triangles_ == model.triangles;
    // A dynamic scene keeps its geometry, whose buffers therefore stay where they are.
    if (!same_shape) forget_scene();
    spheres_ = model.spheres;
    triangles_ = model.triangles;
    vertices_.resize(model.vertices.size());
    std::transform(model.vertices.begin(), model.vertices.end(), vertices_.begin(),
                   [](const Vec3f& vertex) { return glm::vec4(vertex, 0); });
    set_camera(model);
  }

  /// Without a frame.
  RTCScene built() {
    build();
    return scene_.get();
  }

  Frame build_and_trace() override {
    const Stopwatch stopwatch;
    build();
    const Seconds build = stopwatch.elapsed();
    Frame frame = trace();
    frame.build = build;
    return frame;
  }

  Frame trace() override {
    const Stopwatch stopwatch;
    std::atomic<int> next_row{0};
    std::atomic<std::uint64_t> shadow_rays{0};
    const auto work = [&] {
      const DenormalsAreZero mode;
      std::uint64_t mine = 0;
      for (int row = next_row++; row * 4 < frame_.size; row = next_row++)
        mine += trace_tile_row(frame_, row);
      shadow_rays += mine;
    };
    std::vector<std::thread> others;
    for (unsigned i = 1; i < threads_; ++i)
      others.emplace_back(work);
    work();
    for (std::thread& other : others)
      other.join();
    Frame frame;
    frame.trace = stopwatch.elapsed();
    frame.primary_rays = static_cast<std::uint64_t>(frame_.size) * static_cast<std::uint64_t>(frame_.size);
    frame.shadow_rays = shadow_rays;
    return frame;
  }

  const Image& picture() const override { return picture_; }
  std::uint64_t accelerator_bytes() const override { return static_cast<std::uint64_t>(memory_.load()); }

private:
  static bool count_memory(void* memory, ssize_t bytes, bool) {
    *static_cast<std::atomic<std::int64_t>*>(memory) += bytes;
    return true;
  }

  void set_camera(const Model& model) {
    const double pixel = 1.0 / frame_.size;
    const Camera& camera = model.camera;
    copy(camera.location, frame_.origin);
    copy(camera.direction + (0.5 * pixel - 0.5) * camera.right + (0.5 - 0.5 * pixel) * camera.up,
         frame_.base);
    copy(camera.right * pixel, frame_.dx);
    copy(-camera.up * pixel, frame_.dy);
    copy(model.light, frame_.light);
  }

  void forget_scene() {
    geometry_.reset();
    scene_.reset();
  }

  void build() {
    const bool dynamic =
        config_.quality == EmbreeConfig::Quality::low || config_.quality == EmbreeConfig::Quality::refit;
    if (!dynamic) forget_scene();
    if (scene_)
      rtcUpdateGeometryBuffer(geometry_.get(), RTC_BUFFER_TYPE_VERTEX, 0);
    else
      make_scene(dynamic);
    rtcCommitGeometry(geometry_.get());
    rtcCommitScene(scene_.get());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw Error("Embree cannot build this model");
    frame_.scene = scene_.get();
  }

  void make_scene(bool dynamic) {
    const RTCBuildQuality quality = quality_of(config_.quality);
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene_.get(), dynamic ? RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_NONE);
    // A scene itself is not refitted.
    rtcSetSceneBuildQuality(scene_.get(),
                            quality == RTC_BUILD_QUALITY_REFIT ? RTC_BUILD_QUALITY_MEDIUM : quality);
    geometry_.reset(rtcNewGeometry(device_.get(), spheres_.empty() ? RTC_GEOMETRY_TYPE_TRIANGLE
                                                                   : RTC_GEOMETRY_TYPE_SPHERE_POINT));
    rtcSetGeometryBuildQuality(geometry_.get(), quality);
    if (spheres_.empty()) {
      share(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices_);
      share(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles_);
    } else {
      share(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, spheres_);
    }
    rtcCommitGeometry(geometry_.get());
    rtcAttachGeometry(scene_.get(), geometry_.get());
  }
  template <class Element>
  void share(RTCBufferType type, RTCFormat format, const std::vector<Element>& elements) {
    rtcSetSharedGeometryBuffer(geometry_.get(), type, 0, format, elements.data(), 0, sizeof(Element),
                               elements.size());
  }

  EmbreeConfig config_;
  unsigned threads_;
  Image picture_;
  EmbreeFrame frame_;
  std::atomic<std::int64_t> memory_{0};
  // Read by Embree where they lie.
  std::vector<glm::vec4> vertices_, spheres_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  Device device_;
  SceneHandle scene_;
  Geometry geometry_;
};

class EmbreeQueries : public QuerySide {
public:
  explicit EmbreeQueries(const Model& model) : side_(16, 1, {1, EmbreeConfig::Quality::high}) {
    side_.take(model);
    scene_ = side_.built();
  }

  void closest_hits(std::span<const Ray> rays, std::span<float> distances) override {
    intersect_one_by_one(scene_, rays.data(), distances.data(), rays.size());
  }

private:
  EmbreeSide side_;
  RTCScene scene_;
};

} // namespace

std::unique_ptr<QuerySide> make_embree_queries(const Model& model) {
  return std::make_unique<EmbreeQueries>(model);
}

std::optional<std::string> embree_version() {
  return "Embree " RTC_VERSION_STRING;
}

int widest_embree_packet() {
  const Device device = make_device(1);
  return rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0 ? 16 : 8;
}

std::unique_ptr<Side> make_embree_side(int size, unsigned threads, const EmbreeConfig& config) {
  return std::make_unique<EmbreeSide>(size, threads, config);
}

} // namespace celltrace::compare
