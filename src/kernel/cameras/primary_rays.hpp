// Primary rays of packets: the sixteen rays through a 4x4 block of pixels. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/cameras/list.hpp"
#include "kernel/modules.hpp"
#include "records/frame.hpp"
#include "records/offsets.hpp"
#include "records/sampling.hpp"

#include <type_traits>

namespace celltrace::kernel {

namespace detail {
alignas(64) constexpr float kLaneX[kSimdLanes] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr float kLaneY[kSimdLanes] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
} // namespace detail

namespace module_cameras {

/// Makes the rays of a curved or distant camera; returns the lanes that have a ray.
template <class Spu>
CELLTRACE_ONE_COPY uint32_t bend(Spu& spu, const CameraRecord& camera, const typename Spu::simd::F& x,
                                 const typename Spu::simd::F& y, RayPacket& packet) {
  using S = typename Spu::simd;
  using F = typename S::F;
  spu.run_in_module(modules::kCameras);
  const bool is_far = camera.ahead != 0.0f;
  CameraRays<S> rays;
  rays.origin = splat3<S>(camera.origin);
  rays.x = x * F(camera.step_x);
  rays.y = (F(0.0f) - y) * F(camera.step_y);
  uint32_t lanes = 0xFFFF;
  bool turns = false;
  Cameras::dispatch(camera.kind, [&](auto kind) {
    using Kind = decltype(kind);
    if constexpr (Kind::kIsFlat)
      rays.direction = {rays.x, rays.y, F(1.0f)};
    else
      lanes = Kind::template bend<S>(camera, rays);
    turns = !is_far && std::is_same_v<Kind, SphericalCamera>;
  });
  if (is_far) {
    const F scale = F(camera.ahead) / rays.direction.z;
    rays.origin = rays.origin +
                  (splat3<S>(camera.dx) * rays.direction.x + splat3<S>(camera.dy) * rays.direction.y) * scale;
  }
  packet.origin.template store<S>(rays.origin);
  packet.direction.template store<S>(
      normalise<S>(turns ? SphericalCamera::turn<S>(camera, rays) : along_axes<S>(camera, rays.direction)));
  return lanes;
}

} // namespace module_cameras

/// Makes rays through points of the picture, `x` to the right of its middle and `y` below it, in pixels.
/// Returns the lanes that have a ray: some cameras see nothing in some pixels, which are black.
template <class Spu>
uint32_t make_rays_through(Spu& spu, const CameraRecord& camera, const typename Spu::simd::F& x,
                           const typename Spu::simd::F& y, RayPacket& packet) {
  using S = typename Spu::simd;
  for (uint32_t lane = 0; lane < kSimdLanes; ++lane)
    packet.start_object.lane[lane] = kNoOffset;
  if (camera.sheaf == static_cast<uint32_t>(RaySheaf::made)) {
    spu.enter_module(modules::kCameras);
    return module_cameras::bend(spu, camera, x, y, packet);
  }
  const bool parallel = !is_pinhole(camera);
  const V3<S> through = splat3<S>(camera.base) + splat3<S>(camera.dx) * x + splat3<S>(camera.dy) * y;
  const V3<S> fixed = splat3<S>(camera.origin);
  packet.origin.template store<S>(parallel ? through : fixed);
  packet.direction.template store<S>(normalise<S>(parallel ? fixed : through));
  return 0xFFFF;
}

/// Return the positions of the pixels of the packet at (column, row), both counted in packets. Positions are
/// relative to the middle that the record specifies, so that nothing cancels.
template <class S> typename S::F pixels_across(const FrameBlock& frame, uint32_t column) {
  using F = typename S::F;
  return F::load(detail::kLaneX) + F(static_cast<float>(column * kPacketEdge) - frame.camera.middle_x);
}
template <class S> typename S::F pixels_down(const FrameBlock& frame, uint32_t row) {
  using F = typename S::F;
  return F::load(detail::kLaneY) + F(static_cast<float>(row * kPacketEdge) - frame.camera.middle_y);
}

/// Makes the rays of the packet at (column, row); see make_rays_through().
template <class Spu>
uint32_t make_primary_rays(Spu& spu, const FrameBlock& frame, uint32_t column, uint32_t row,
                           RayPacket& packet) {
  using S = typename Spu::simd;
  return make_rays_through(spu, frame.camera, pixels_across<S>(frame, column), pixels_down<S>(frame, row),
                           packet);
}

/// Returns the lanes of a packet that lie in the picture.
inline uint32_t lanes_in_picture(const FrameBlock& frame, uint32_t column, uint32_t row) {
  if ((column + 1) * kPacketEdge <= frame.width && (row + 1) * kPacketEdge <= frame.height) return 0xFFFF;
  const uint32_t columns = frame.width - column * kPacketEdge;
  const uint32_t rows = frame.height - row * kPacketEdge;
  const uint32_t in_row = columns >= kPacketEdge ? 0xFu : (1u << columns) - 1;
  uint32_t lanes = 0;
  for (uint32_t y = 0; y < kPacketEdge && y < rows; ++y)
    lanes |= in_row << (y * kPacketEdge);
  return lanes;
}

} // namespace celltrace::kernel
