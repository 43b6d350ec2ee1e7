#include "embree_trace.hpp"

#include "model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <pmmintrin.h>

namespace celltrace::compare {

namespace {

constexpr int kEdge = 4;
constexpr int kLanes = kEdge * kEdge;
/// celltrace's tolerance at both ends of a shadow ray, which is POV-Ray's.
constexpr float kTolerance = 1e-3f;

/// Rays of a tile of 4x4 pixels; lane by lane, so that the compiler makes vectors of the loops over lanes.
struct Tile {
  RTCRayHit16 rays;
  RTCRay16 shadow_rays;
  alignas(64) int valid[kLanes];
  alignas(64) int facing[kLanes];
  alignas(64) float shade[kLanes];
};

void make_primary_rays(const EmbreeFrame& frame, int left, int top, Tile& tile) {
  RTCRay16& ray = tile.rays.ray;
  for (int lane = 0; lane < kLanes; ++lane) {
    const int column = left + lane % kEdge;
    const int row = top + lane / kEdge;
    const auto x = static_cast<float>(column);
    const auto y = static_cast<float>(row);
    const float dir_x = frame.base[0] + x * frame.dx[0] + y * frame.dy[0];
    const float dir_y = frame.base[1] + x * frame.dx[1] + y * frame.dy[1];
    const float dir_z = frame.base[2] + x * frame.dx[2] + y * frame.dy[2];
    const float scale = 1 / std::sqrt(dir_x * dir_x + dir_y * dir_y + dir_z * dir_z);
    ray.org_x[lane] = frame.origin[0];
    ray.org_y[lane] = frame.origin[1];
    ray.org_z[lane] = frame.origin[2];
    ray.dir_x[lane] = dir_x * scale;
    ray.dir_y[lane] = dir_y * scale;
    ray.dir_z[lane] = dir_z * scale;
    ray.tnear[lane] = 0;
    ray.tfar[lane] = std::numeric_limits<float>::infinity();
    ray.time[lane] = 0;
    ray.mask[lane] = 0xFFFFFFFFu;
    ray.flags[lane] = 0;
    tile.rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    tile.rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    tile.valid[lane] = column < frame.size && row < frame.size ? -1 : 0;
  }
}

bool any_hit(const Tile& tile) {
  bool any = false;
  for (int lane = 0; lane < kLanes; ++lane)
    any |= tile.rays.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
  return any;
}

/// Returns the number of rays.
int make_shadow_rays(const EmbreeFrame& frame, Tile& tile) {
  const RTCRay16& ray = tile.rays.ray;
  const RTCHit16& hit = tile.rays.hit;
  RTCRay16& shadow = tile.shadow_rays;
  int count = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    const float x = ray.org_x[lane] + ray.tfar[lane] * ray.dir_x[lane];
    const float y = ray.org_y[lane] + ray.tfar[lane] * ray.dir_y[lane];
    const float z = ray.org_z[lane] + ray.tfar[lane] * ray.dir_z[lane];
    const float to_x = frame.light[0] - x;
    const float to_y = frame.light[1] - y;
    const float to_z = frame.light[2] - z;
    const float distance = std::sqrt(to_x * to_x + to_y * to_y + to_z * to_z);
    const float scale = 1 / distance;
    const float n_x = hit.Ng_x[lane], n_y = hit.Ng_y[lane], n_z = hit.Ng_z[lane];
    const float toward_viewer = n_x * ray.dir_x[lane] + n_y * ray.dir_y[lane] + n_z * ray.dir_z[lane];
    const float length = std::sqrt(n_x * n_x + n_y * n_y + n_z * n_z);
    const float sign = toward_viewer > 0 ? -1.0f : 1.0f;
    const float cosine = (n_x * to_x + n_y * to_y + n_z * to_z) * scale * sign / length;
    const bool is_hit = tile.valid[lane] != 0 && hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
    const bool faces = is_hit && cosine >= 1e-10f;
    shadow.org_x[lane] = x;
    shadow.org_y[lane] = y;
    shadow.org_z[lane] = z;
    shadow.dir_x[lane] = to_x * scale;
    shadow.dir_y[lane] = to_y * scale;
    shadow.dir_z[lane] = to_z * scale;
    shadow.tnear[lane] = kTolerance;
    shadow.tfar[lane] = distance - kTolerance;
    shadow.time[lane] = 0;
    shadow.mask[lane] = 0xFFFFFFFFu;
    shadow.flags[lane] = 0;
    tile.shade[lane] = kDiffuse * cosine;
    tile.facing[lane] = faces ? -1 : 0;
    count += faces ? 1 : 0;
  }
  return count;
}

void write_pixels(const EmbreeFrame& frame, int left, int top, const Tile& tile) {
  alignas(64) std::uint32_t pixels[kLanes];
  constexpr auto kBlue = 0xFFFF0000u;
  static_assert(kBackground[0] == 0 && kBackground[1] == 0 && kBackground[2] == 1);
  for (int lane = 0; lane < kLanes; ++lane) {
    const bool lit = tile.facing[lane] != 0 && tile.shadow_rays.tfar[lane] >= 0;
    const float grey = std::min(kPigment * (kAmbient + (lit ? tile.shade[lane] : 0)), 1.0f);
    const auto level = static_cast<std::uint32_t>(static_cast<int>(grey * 255 + 0.5f));
    const bool is_hit = tile.rays.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
    pixels[lane] = is_hit ? 0xFF000000u | level * 0x010101u : kBlue;
  }
  const int columns = std::min(kEdge, frame.size - left);
  for (int y = 0; y < kEdge && top + y < frame.size; ++y) {
    const std::uint32_t* const row = pixels + y * kEdge;
    auto* const target = reinterpret_cast<std::uint32_t*>(frame.rgba) +
                         static_cast<std::size_t>(top + y) * static_cast<std::size_t>(frame.size) + left;
    std::copy(row, row + columns, target);
  }
}

/// How the rays of a tile are handed to Embree.
template <int kPacket> struct Calls;

template <> struct Calls<16> {
  static void intersect(RTCScene scene, RTCIntersectContext& context, Tile& tile) {
    rtcIntersect16(tile.valid, scene, &context, &tile.rays);
  }
  static void occlude(RTCScene scene, RTCIntersectContext& context, Tile& tile) {
    rtcOccluded16(tile.facing, scene, &context, &tile.shadow_rays);
  }
};

template <class Half> void copy_ray(const RTCRay16& from, int first, Half& to) {
  constexpr int kWidth = sizeof to.org_x / sizeof to.org_x[0];
  for (int lane = 0; lane < kWidth; ++lane) {
    to.org_x[lane] = from.org_x[first + lane];
    to.org_y[lane] = from.org_y[first + lane];
    to.org_z[lane] = from.org_z[first + lane];
    to.dir_x[lane] = from.dir_x[first + lane];
    to.dir_y[lane] = from.dir_y[first + lane];
    to.dir_z[lane] = from.dir_z[first + lane];
    to.tnear[lane] = from.tnear[first + lane];
    to.tfar[lane] = from.tfar[first + lane];
    to.time[lane] = 0;
    to.mask[lane] = 0xFFFFFFFFu;
    to.flags[lane] = 0;
  }
}

template <> struct Calls<8> {
  static void intersect(RTCScene scene, RTCIntersectContext& context, Tile& tile) {
    for (int first = 0; first < kLanes; first += 8) {
      RTCRayHit8 half;
      copy_ray(tile.rays.ray, first, half.ray);
      std::fill_n(half.hit.geomID, 8, RTC_INVALID_GEOMETRY_ID);
      std::fill_n(half.hit.instID[0], 8, RTC_INVALID_GEOMETRY_ID);
      rtcIntersect8(tile.valid + first, scene, &context, &half);
      std::copy_n(half.ray.tfar, 8, tile.rays.ray.tfar + first);
      std::copy_n(half.hit.Ng_x, 8, tile.rays.hit.Ng_x + first);
      std::copy_n(half.hit.Ng_y, 8, tile.rays.hit.Ng_y + first);
      std::copy_n(half.hit.Ng_z, 8, tile.rays.hit.Ng_z + first);
      std::copy_n(half.hit.geomID, 8, tile.rays.hit.geomID + first);
    }
  }
  static void occlude(RTCScene scene, RTCIntersectContext& context, Tile& tile) {
    for (int first = 0; first < kLanes; first += 8) {
      RTCRay8 half;
      copy_ray(tile.shadow_rays, first, half);
      rtcOccluded8(tile.facing + first, scene, &context, &half);
      std::copy_n(half.tfar, 8, tile.shadow_rays.tfar + first);
    }
  }
};

RTCRay single_ray(const RTCRay16& from, int lane) {
  RTCRay ray;
  ray.org_x = from.org_x[lane];
  ray.org_y = from.org_y[lane];
  ray.org_z = from.org_z[lane];
  ray.dir_x = from.dir_x[lane];
  ray.dir_y = from.dir_y[lane];
  ray.dir_z = from.dir_z[lane];
  ray.tnear = from.tnear[lane];
  ray.tfar = from.tfar[lane];
  ray.time = 0;
  ray.mask = 0xFFFFFFFFu;
  ray.flags = 0;
  return ray;
}

template <> struct Calls<1> {
  static void intersect(RTCScene scene, RTCIntersectContext& context, Tile& tile) {
    for (int lane = 0; lane < kLanes; ++lane) {
      if (tile.valid[lane] == 0) continue;
      RTCRayHit one;
      one.ray = single_ray(tile.rays.ray, lane);
      one.hit.geomID = one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene, &context, &one);
      tile.rays.ray.tfar[lane] = one.ray.tfar;
      tile.rays.hit.Ng_x[lane] = one.hit.Ng_x;
      tile.rays.hit.Ng_y[lane] = one.hit.Ng_y;
      tile.rays.hit.Ng_z[lane] = one.hit.Ng_z;
      tile.rays.hit.geomID[lane] = one.hit.geomID;
    }
  }
  static void occlude(RTCScene scene, RTCIntersectContext& context, Tile& tile) {
    for (int lane = 0; lane < kLanes; ++lane) {
      if (tile.facing[lane] == 0) continue;
      RTCRay one = single_ray(tile.shadow_rays, lane);
      rtcOccluded1(scene, &context, &one);
      tile.shadow_rays.tfar[lane] = one.tfar;
    }
  }
};

template <int kPacket> std::uint64_t trace_row(const EmbreeFrame& frame, int tile_row) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  std::uint64_t shadow_rays = 0;
  const int top = tile_row * kEdge;
  for (int left = 0; left < frame.size; left += kEdge) {
    Tile tile;
    make_primary_rays(frame, left, top, tile);
    Calls<kPacket>::intersect(frame.scene, context, tile);
    std::fill_n(tile.facing, kLanes, 0);
    const int count = any_hit(tile) ? make_shadow_rays(frame, tile) : 0;
    if (count != 0) Calls<kPacket>::occlude(frame.scene, context, tile);
    shadow_rays += static_cast<std::uint64_t>(count);
    write_pixels(frame, left, top, tile);
  }
  return shadow_rays;
}

} // namespace

std::uint64_t trace_tile_row(const EmbreeFrame& frame, int tile_row) {
  switch (frame.packet) {
  case 1:
    return trace_row<1>(frame, tile_row);
  case 8:
    return trace_row<8>(frame, tile_row);
  default:
    return trace_row<16>(frame, tile_row);
  }
}

void intersect_one_by_one(RTCScene scene, const Ray* rays, float* distances, std::size_t count) {
  const DenormalsAreZero mode;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t i = 0; i < count; ++i) {
    const Ray& ray = rays[i];
    RTCRayHit one;
    one.ray.org_x = ray.origin[0];
    one.ray.org_y = ray.origin[1];
    one.ray.org_z = ray.origin[2];
    one.ray.dir_x = ray.direction[0];
    one.ray.dir_y = ray.direction[1];
    one.ray.dir_z = ray.direction[2];
    one.ray.tnear = 0;
    one.ray.tfar = ray.tfar;
    one.ray.time = 0;
    one.ray.mask = 0xFFFFFFFFu;
    one.ray.flags = 0;
    one.hit.geomID = one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &one);
    distances[i] =
        one.hit.geomID != RTC_INVALID_GEOMETRY_ID ? one.ray.tfar : std::numeric_limits<float>::infinity();
  }
}

DenormalsAreZero::DenormalsAreZero() : before_(_mm_getcsr()) {
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
}

DenormalsAreZero::~DenormalsAreZero() {
  _mm_setcsr(before_);
}

} // namespace celltrace::compare
