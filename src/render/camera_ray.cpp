#include "celltrace/camera_ray.hpp"

#include "backends/native/query_spu.hpp"
#include "celltrace/error.hpp"
#include "celltrace/spe/simd_host.hpp"
#include "kernel/cameras/primary_rays.hpp"
#include "render/camera_setup.hpp"

namespace celltrace {

std::optional<Ray> camera_ray(const Camera& camera, int width, int height, double x, double y) {
  using Simd = HostSimd<BaselineArch>;
  if (width < 1 || height < 1) throw InputError("a ray goes through a picture of at least one pixel");
  // The grid is shifted by half a pixel: coordinates count from the corners of pixels, not from their
  // middles.
  const kernel::CameraRecord record = camera_record(camera, {double(width), double(height), 0.5, 0.5});
  native::QuerySpu<Simd> spu;
  kernel::RayPacket packet;
  const std::uint32_t lanes =
      kernel::make_rays_through(spu, record, Simd::F(static_cast<float>(x) - record.middle_x),
                                Simd::F(static_cast<float>(y) - record.middle_y), packet);
  if ((lanes & 1) == 0) return std::nullopt;
  Ray ray{};
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    ray.origin[axis] = packet.origin[axis].lane[0];
    ray.direction[axis] = packet.direction[axis].lane[0];
  }
  return ray;
}

} // namespace celltrace
