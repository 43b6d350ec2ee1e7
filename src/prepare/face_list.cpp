#include "prepare/face_list.hpp"

#include <cmath>
#include <tuple>
#include <utility>

#include <glm/vector_relational.hpp>

namespace celltrace {

namespace {

/// Turns the normal, which points outwards, to the direction that Face requires. Sets faces_up.
void turn(Face& face) {
  constexpr double kNone = 1e-9;
  int axis = 0;
  while (axis < 2 && std::abs(face.normal[axis]) < kNone)
    ++axis;
  face.faces_up = face.normal[axis] > 0;
  if (face.faces_up) return;
  face.normal = -face.normal;
  face.distance = -face.distance;
}

/// Returns a face of a solid; `outward` is its normal in the solid's space.
Face face_of(const Vec3 (&corners)[4], const Vec3& outward, const Transform& transform) {
  Face face{};
  face.normal = glm::normalize(transform.normal(outward));
  for (const Vec3& corner : corners) {
    const Vec3 place = transform.point(corner);
    face.extent = &corner == corners ? Extent{place, place} : face.extent.joined({place, place});
    face.distance = glm::dot(face.normal, place);
  }
  turn(face);
  return face;
}

/// Returns false for faces of a singular transformation, or of a box that reaches to the largest numbers;
/// such objects are rejected elsewhere.
bool is_usable(const Face& face) {
  constexpr double kFarthest = 1e12;
  const Vec3 reach = glm::max(glm::abs(face.extent.min), glm::abs(face.extent.max));
  return glm::dot(face.normal, face.normal) < 2 && std::abs(face.distance) < kFarthest &&
         reach.x < kFarthest && reach.y < kFarthest && reach.z < kFarthest;
}

double radius_at(const Cylinder& cylinder, int) {
  return cylinder.radius;
}
double radius_at(const Cone& cone, int side) {
  return side != 0 ? cone.cap_radius : cone.base_radius;
}

bool are_parallel(const Face& a, const Face& b) {
  constexpr double kSame = 1e-9;
  const Vec3 difference = glm::abs(a.normal - b.normal);
  return std::max({difference.x, difference.y, difference.z}) < kSame;
}

} // namespace

FaceList::FaceList(const Scene& scene, std::span<const std::uint32_t> material_flags, const Vec3* eye,
                   std::size_t most)
    : scene_(scene), material_flags_(material_flags), eye_(eye) {
  std::size_t solids = 0;
  for (std::size_t i = 0; i < std::min(scene.objects.size(), most); ++i) {
    const Object& object = scene.objects[i];
    if (const auto* const plane = std::get_if<Plane>(&object.shape)) add_plane(i, *plane);
    const auto visit = [&](const auto& solid, const Transform& transform, Index material, const CsgPath& path,
                           int inversions) {
      if (!object.is_hidden && inversions < 2)
        add(i, solids, solid, transform, material, path, inversions == 1);
      ++solids;
    };
    visit_solids(object, visit);
  }
  solid_count_ = solids;
}

void FaceList::add_plane(std::size_t object, const Plane& plane) {
  Face face{};
  const Transform& transform = scene_.objects[object].transform;
  face.normal = glm::normalize(transform.normal(plane.normal));
  face.distance = glm::dot(face.normal, transform.point(glm::normalize(plane.normal) * plane.distance));
  turn(face);
  face.extent = Extent::everywhere();
  face.material = scene_.objects[object].material;
  face.object = object;
  face.solid = Face::kPlane;
  if (is_usable(face)) faces_.push_back(face);
}

void FaceList::add(std::size_t object, std::size_t number, const Box& box, const Transform& transform,
                   Index material, const CsgPath& path, bool is_inverse) {
  const bool has_order = !path.empty() && !is_inverse; // is compared with other faces of its CSG
  if (has_order) paths_.push_back(path);
  const Vec3 low = glm::min(box.corner[0], box.corner[1]), high = glm::max(box.corner[0], box.corner[1]);
  const bool is_seen_inside =
      is_inverse || (eye_ != nullptr && path.empty() && holds_eye(low, high, transform));
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    const double at = (side % 2 != 0 ? high : low)[axis];
    Vec3 unit(0);
    unit[axis] = 1;
    Vec3 corners[4];
    for (int corner = 0; corner < 4; ++corner) {
      corners[corner][axis] = at;
      corners[corner][(axis + 1) % 3] = (corner & 1 ? high : low)[(axis + 1) % 3];
      corners[corner][(axis + 2) % 3] = (corner & 2 ? high : low)[(axis + 2) % 3];
    }
    Face face = face_of(corners, unit * (side % 2 != 0 ? 1.0 : -1.0), transform);
    face.material = material;
    face.is_inverse = is_inverse;
    face.faces_up = face.faces_up != is_seen_inside;
    // Skips opaque back faces, since there may be many: they are visible only through transparent objects and
    // in mirrors.
    if (eye_ != nullptr && is_opaque(face) && !faces_camera(face)) continue;
    face.object = object;
    face.solid = number;
    face.side = side;
    face.path = has_order ? static_cast<std::uint32_t>(paths_.size()) : 0;
    if (is_usable(face)) faces_.push_back(face);
  }
}

bool FaceList::holds_eye(const Vec3& low, const Vec3& high, const Transform& transform) const {
  const Vec3 eye = transform.inverse().point(*eye_);
  return glm::all(glm::lessThanEqual(low, eye)) && glm::all(glm::lessThanEqual(eye, high));
}

template <class Round>
void FaceList::add(std::size_t object, std::size_t number, const Round& solid, const Transform& transform,
                   Index material, const CsgPath&, bool is_inverse) {
  if (solid.open || is_inverse) return;
  const Vec3 axis = solid.cap - solid.base;
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(axis[i]) < std::abs(axis[least])) least = i;
  Vec3 unit(0);
  unit[least] = 1;
  const Vec3 across = glm::normalize(glm::cross(axis, unit)), up = glm::normalize(glm::cross(axis, across));
  for (int side = 0; side < 2; ++side) {
    const double radius = radius_at(solid, side);
    const Vec3 middle = side != 0 ? solid.cap : solid.base;
    Vec3 corners[4];
    for (int corner = 0; corner < 4; ++corner)
      corners[corner] =
          middle + (across * (corner & 1 ? 1.0 : -1.0) + up * (corner & 2 ? 1.0 : -1.0)) * radius;
    Face face = face_of(corners, side != 0 ? axis : -axis, transform);
    face.material = material;
    if (is_opaque(face) || (eye_ != nullptr && faces_camera(face))) continue;
    face.object = object;
    face.solid = number;
    face.side = side;
    face.is_round = true;
    if (is_usable(face)) faces_.push_back(face);
  }
}

bool FaceList::are_in_one_plane(const Face& a, const Face& b) {
  constexpr double kSame = 1e-11;
  return are_parallel(a, b) && std::abs(a.distance - b.distance) <= kSame * (1 + std::abs(a.distance));
}

void FaceList::sort() {
  struct Key {
    std::int32_t normal[3]; ///< rounded to a millionth
    std::uint32_t face;
    double distance;
  };
  std::vector<Key> keys;
  keys.reserve(faces_.size());
  for (const Face& face : faces_) {
    const auto rounded = [&](int axis) {
      return static_cast<std::int32_t>(std::floor(face.normal[axis] * 1e6 + 0.25));
    };
    const auto number = static_cast<std::uint32_t>(keys.size());
    keys.push_back({{rounded(0), rounded(1), rounded(2)}, number, face.distance});
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return std::tie(a.normal[0], a.normal[1], a.normal[2], a.distance) <
           std::tie(b.normal[0], b.normal[1], b.normal[2], b.distance);
  });
  std::vector<Face> sorted;
  sorted.reserve(faces_.size());
  for (const Key& key : keys)
    sorted.push_back(faces_[key.face]);
  faces_ = std::move(sorted);
}

} // namespace celltrace
