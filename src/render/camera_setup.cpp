#include "render/camera_setup.hpp"

#include "kernel/cameras/list.hpp"
#include "render/far_camera.hpp"
#include "render/picture_options.hpp"
#include "scene_image/object_records.hpp"
#include "scene_image/record_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <type_traits>
#include <utility>

#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

double middle_x(const PictureOnGrid& picture) {
  return picture.left + 0.5 * picture.width - 0.5;
}
double middle_y(const PictureOnGrid& picture) {
  return picture.top + 0.5 * picture.height - 0.5;
}

/// Returns the number of rows from the middle of a perspective picture down to its horizon, or 0 if the
/// picture shows no horizon. This is the horizon of floors if up is nearly the y axis.
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
  // Rows are counted from the horizon, because the precision of the difference of two directions decides how
  // far away rays hit a floor, and on which of its squares.
  const double first_row = parallel ? 0 : horizon_row(base, row, picture.height);
  base += row * first_row;
  copy(parallel ? camera.direction : camera.location, record.origin);
  copy(base, record.base);
  copy(camera.right / picture.width, record.dx);
  copy(row, record.dy);
  record.middle_x = static_cast<float>(middle_x(picture));
  record.middle_y = static_cast<float>(middle_y(picture) + first_row);
}

/// Returns a unit vector; a zero vector stays zero.
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
  copy(camera.location, record.origin);
  copy(axis(camera.direction), record.base);
  copy(axis(camera.right), record.dx);
  copy(axis(camera.up), record.dy);
  const double step_x = 2 * picture.half_width / on_grid.width;
  const double step_y = 2 * picture.half_height / on_grid.height;
  record.middle_x = static_cast<float>(middle_x(on_grid));
  record.middle_y = static_cast<float>(middle_y(on_grid) + (step_y > 0 ? picture.middle / step_y : 0));
  record.step_x = static_cast<float>(step_x);
  record.step_y = static_cast<float>(step_y);
  record.bend = static_cast<float>(picture.bend);
}

/// Returns a record whose rays start ahead of the camera, by `start` lengths of the camera's direction.
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
      copy(camera.location + camera.direction * start, record.origin);
      copy(camera.direction / length, record.base);
      copy(camera.right / (length * picture.width), record.dx);
      copy(camera.up / (length * picture.height), record.dy);
      record.middle_x = static_cast<float>(middle_x(picture));
      record.middle_y = static_cast<float>(middle_y(picture));
      record.step_x = record.step_y = 1;
    } else {
      if (std::is_same_v<Kind, SphericalCamera>) {
        // Uses the axes about which the camera turns its rays, which may differ from the camera's own axes.
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

Camera framed(Camera camera, double width, double height) {
  const double own = glm::length(camera.right) / glm::length(camera.up);
  // The ratio of the picture's width to that of the camera's view.
  const double wider = width / height / own;
  if (camera.framing == Camera::Framing::fixed || !(wider > 0) || !std::isfinite(wider)) return camera;
  if (camera.framing == Camera::Framing::whole && wider > 1)
    camera.right *= wider;
  else
    camera.up /= wider;
  return camera;
}

} // namespace

PictureOnGrid picture_on_grid(const RenderOptions& options) {
  const PictureRegion region = region_of(options);
  // The grid has one more point than pixels each way: the corners of pixels, or their middles including a row
  // and column before the first pixel.
  const auto& antialiasing = options.antialiasing;
  const bool fixed = antialiasing && antialiasing->method == Antialiasing::Method::fixed;
  const double first = !antialiasing ? 0.0 : fixed ? 1.0 : 0.5;
  return {static_cast<double>(options.width), static_cast<double>(options.height), first - region.left,
          first - region.top};
}

CameraRecord camera_record(const Camera& any_picture, const PictureOnGrid& picture, const SceneImage* image,
                           PassedLimits* limits) {
  Camera camera = framed(any_picture, picture.width, picture.height);
  // Samples lie up to a pixel beyond the picture.
  const double margin = 4 / std::min(picture.width, picture.height);
  const double start = image != nullptr ? start_of_rays(camera, margin, *image, limits) : 0;
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

PassedLimits set_camera(FrameBlock& frame, const Camera& camera, const PictureOnGrid& picture,
                        const std::vector<Medium>& media, const SceneImage& image) {
  PassedLimits limits;
  frame.camera = camera_record(camera, picture, &image, &limits);
  std::vector<std::pair<double, std::uint32_t>> around;
  for (const Medium& medium : media) {
    if (!medium.contains(camera.location)) continue;
    around.emplace_back(medium.volume(), offset_of_interior(image.header().interior_offset, medium.interior));
  }
  std::sort(around.begin(), around.end(), std::greater<>());
  static_assert(kMaxInteriorDepth == most_of(PictureLimit::camera_interiors));
  const std::size_t kept = std::min<std::size_t>(around.size(), kMaxInteriorDepth);
  if (kept < around.size()) limits.insert(PictureLimit::camera_interiors);
  frame.camera_interior_count = static_cast<std::uint32_t>(kept);
  for (std::size_t i = 0; i < kept; ++i)
    frame.camera_interiors[i] = around[around.size() - kept + i].second;
  return limits;
}

} // namespace celltrace
