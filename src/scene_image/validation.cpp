#include "scene_image/validation.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <unordered_set>

#include <glm/geometric.hpp>

#include "celltrace/error.hpp"
#include "geometry/shape_geometry.hpp"
#include "geometry/triangles.hpp"
#include "prepare/projectors.hpp"
#include "records/light.hpp"
#include "scene/progress_monitor.hpp"
#include "scene_image/light_sets.hpp"
#include "scene_image/shapes.hpp"
#include "scene_image/texture_checks.hpp"

namespace celltrace {

namespace {

constexpr std::size_t kMostEntries = std::numeric_limits<Index>::max() - 1;

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The name of a checked item, which becomes text only if there is an error.
struct Name {
  const char* what;
  std::size_t index = kNoNumber; ///< index of the item, if it is one of many
  const char* part = "";

  static constexpr std::size_t kNoNumber = std::numeric_limits<std::size_t>::max();
  std::string text() const {
    return what + (index == kNoNumber ? std::string() : ' ' + std::to_string(index)) + part;
  }
};

template <class Number> void check_finite(std::initializer_list<Number> values, const Name& name) {
  for (const Number& value : values)
    if (!std::isfinite(value)) throw InputError(name.text() + " has a number that is not finite");
}

template <class Vector> void check_vectors(std::initializer_list<Vector> values, const Name& name) {
  for (const Vector& value : values)
    if (!is_finite(value)) throw InputError(name.text() + " has a number that is not finite");
}

void check(const Light& light, const Name& name) {
  check_vectors({light.location, light.colour, light.point_at}, name);
  check_finite({light.radius, light.falloff, light.tightness, light.fade_distance, light.fade_power}, name);
  if (!light.area) return;
  const LightArea& area = *light.area;
  check_vectors({area.across, area.along}, name);
  const auto is_count = [](int places) { return places >= 1 && places <= int{kernel::kMaxLightPlaces}; };
  if (!is_count(area.columns) || !is_count(area.rows))
    throw InputError(name.text() + " has to have an area of 1 to " + std::to_string(kernel::kMaxLightPlaces) +
                     " columns and rows");
  if (area.adaptive < 0) throw InputError(name.text() + " has a negative adaptive level");
}

void check(const Fog& fog, const Name& name) {
  check_vectors({fog.colour, fog.up, fog.turbulence.amount, fog.turbulence_origin}, name);
  check_finite({fog.filter, fog.transmit, fog.distance, fog.offset, fog.altitude, fog.turbulence.omega,
                fog.turbulence.lambda, fog.turbulence_depth},
               name);
  if (fog.turbulence.octaves < 1 || fog.turbulence.octaves > 10)
    throw InputError(name.text() + " has turbulence whose octaves are not 1 to 10");
}

void check(const Rainbow& bow, const Name& name) {
  check_vectors({bow.direction, bow.up}, name);
  check_finite({bow.angle, bow.width, bow.distance, bow.jitter, bow.arc_angle, bow.falloff_angle}, name);
  const Vec3 across = glm::cross(bow.direction, bow.up);
  if (!(glm::dot(across, across) > 0)) throw InputError(name.text() + " has no direction, or is up along it");
  if (bow.colours.empty() || bow.colours.size() > kMostMapEntries)
    throw InputError(name.text() + " has to have 1 to " + std::to_string(kMostMapEntries) + " colours");
  for (const Rainbow::Colour& colour : bow.colours) {
    check_vectors({colour.rgb}, name);
    check_finite({colour.position, colour.filter, colour.transmit}, name);
    if (&colour != bow.colours.data() && colour.position < (&colour)[-1].position)
      throw InputError(name.text() + " has colours whose positions do not ascend");
  }
}

void check(const Interior& interior, const Name& name) {
  check_finite(
      {interior.ior, interior.fade_distance, interior.fade_power, interior.refraction, interior.caustics},
      name);
  check_vectors({interior.fade_colour}, name);
}

void check_index(Index index, std::size_t count, const Name& name) {
  if (index >= count)
    throw InputError(name.text() + ": index " + std::to_string(index) + " is out of range, there are " +
                     std::to_string(count));
}

bool is_sound(const Mesh& mesh, const Mesh::Triangle& triangle, std::size_t materials) {
  // Tests all indices without a branch for each. kNoIndex + 1 is 0.
  const auto optional = [](Index index, std::size_t count) { return Index{index + 1} <= count; };
  const bool smooth = triangle.normal[0] != kNoIndex;
  bool sound = true;
  for (int corner = 0; corner < 3; ++corner) {
    sound &= triangle.vertex[corner] < mesh.vertices.size();
    sound &= (triangle.normal[corner] != kNoIndex) == smooth;
    sound &= optional(triangle.normal[corner], mesh.normals.size());
    sound &= optional(triangle.material[corner], materials);
  }
  return sound;
}

/// Returns whether all triangles of a mesh without normals are valid. Tests many words at a time, as
/// greatest_magnitude() does.
bool are_sound(const Mesh& mesh, std::size_t materials) {
  static_assert(sizeof(Mesh::Triangle) == 9 * sizeof(Index));
  constexpr std::size_t kAtATime = 4, kWords = 9 * kAtATime; // fills whole vectors
  constexpr std::size_t kTooMany = std::size_t{1} << 31;     // the test needs the sign bit
  if (!mesh.normals.empty() || mesh.vertices.size() >= kTooMany || materials >= kTooMany) return false;
  // A vertex must be less than the number of vertices; a material index plus one, where kNoIndex becomes 0,
  // must not exceed the number of materials. The sign bit of the difference to the last valid number, or of
  // the number itself, shows an error.
  Index add[kWords], last[kWords], wrong[kWords] = {};
  for (std::size_t i = 0; i < kWords; ++i) {
    const std::size_t word = i % 9;
    add[i] = word < 3 ? 0 : 1;
    last[i] = static_cast<Index>(word < 3 ? mesh.vertices.size() - 1 : word < 6 ? 0 : materials);
  }
  const std::size_t whole = mesh.triangles.size() / kAtATime * kAtATime;
  for (std::size_t first = 0; first < whole; first += kAtATime) {
    ProgressMonitor::check_cancelled(first);
    const auto* const bytes = reinterpret_cast<const std::byte*>(&mesh.triangles[first]);
    for (std::size_t i = 0; i < kWords; ++i) {
      Index index;
      std::memcpy(&index, bytes + i * sizeof index, sizeof index);
      index += add[i];
      wrong[i] |= index | (last[i] - index);
    }
  }
  bool sound = true;
  for (const Index word : wrong)
    sound &= word >> 31 == 0;
  for (std::size_t i = whole; i < mesh.triangles.size(); ++i)
    sound &= is_sound(mesh, mesh.triangles[i], materials);
  return sound;
}

/// Throws InputError if a number is not finite; only then tests vectors one by one, to name the number.
void check_all_finite(const std::vector<Vec3f>& vectors, const Name& name, const char* what) {
  if (std::isfinite(greatest_magnitude(vectors))) return;
  for (std::size_t i = 0; i < vectors.size(); ++i)
    if (!std::isfinite(greatest_magnitude({&vectors[i], 1})))
      throw InputError(name.text() + Name{what, i}.text() + " has a number that is not finite");
}

void check_mesh(const Mesh& mesh, std::size_t materials, const Name& name) {
  if (mesh.vertices.size() > kMostEntries || mesh.normals.size() > kMostEntries ||
      mesh.triangles.size() > kMostEntries)
    throw InputError(name.text() + " has more entries than 32 bits can count");
  check_all_finite(mesh.vertices, name, ", vertex");
  check_all_finite(mesh.normals, name, ", normal");
  if (!mesh.coordinates.empty() && mesh.coordinates.size() != mesh.triangles.size())
    throw InputError(name.text() + " has surface coordinates for other triangles than it has");
  for (std::size_t i = 0; i < mesh.coordinates.size(); ++i)
    for (const Vec2f& at : mesh.coordinates[i].corner)
      if (!std::isfinite(at.x) || !std::isfinite(at.y))
        throw InputError(name.text() + Name{", triangle", i}.text() +
                         " has surface coordinates that are not finite");
  if (!is_finite(mesh.inside_vector))
    throw InputError(name.text() + " has an inside vector that is not finite");
  if (are_sound(mesh, materials)) return;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    ProgressMonitor::check_cancelled(i);
    if (!is_sound(mesh, mesh.triangles[i], materials))
      throw InputError(name.text() + Name{", triangle", i}.text() + " has an index that is out of range");
  }
}

/// Checks an object of the scene, or a part of it.
void check_object(const Scene& scene, const Object& object, const Name& name, int depth) {
  check_index(object.material, scene.materials.size(), {name.what, name.index, ", material"});
  if (object.interior != kNoIndex)
    check_index(object.interior, scene.interiors.size(), {name.what, name.index, ", interior"});
  if (object.light_group != kNoIndex)
    check_index(object.light_group, scene.light_groups.size(), {name.what, name.index, ", light group"});
  const Vec3(&rows)[4] = object.transform.rows;
  check_vectors({rows[0], rows[1], rows[2], rows[3]}, name);
  if (const Sphere* sphere = std::get_if<Sphere>(&object.shape)) {
    check_vectors({sphere->centre}, name);
    check_finite({sphere->radius}, name);
  } else if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape)) {
    if (!*mesh) throw InputError(name.text() + " has no mesh");
  } else if (const auto* csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape)) {
    if (!*csg) throw InputError(name.text() + " has no CSG");
    if (depth == kDeepestCsg) throw InputError(name.text() + " is a CSG that nests too deeply");
    for (const Object& part : (*csg)->parts)
      check_object(scene, part, name, depth + 1);
  } else {
    const bool is_missing = std::visit(
        [](const auto& shape) {
          if constexpr (requires { shape.get(); }) return shape == nullptr;
          return false;
        },
        object.shape);
    if (is_missing) throw InputError(name.text() + " has no shape");
    validate_shape(object, name.text());
  }
  if (!object.clipped_by) return;
  if (depth == kDeepestCsg) throw InputError(name.text() + " is clipped by what nests too deeply");
  for (const Object& clip : *object.clipped_by)
    check_object(scene, clip, name, depth + 1);
}

/// Checks meshes, each once, since instances share their mesh. `object` is number `index` of the scene, or a
/// part of it.
void check_meshes(const Object& object, std::size_t materials, std::size_t index,
                  std::unordered_set<const Mesh*>& seen) {
  if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape)) {
    if (seen.insert(mesh->get()).second) check_mesh(**mesh, materials, {"object", index});
  } else if (const auto* csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape)) {
    for (const Object& part : (*csg)->parts)
      check_meshes(part, materials, index, seen);
  }
  if (!object.clipped_by) return;
  for (const Object& clip : *object.clipped_by)
    check_meshes(clip, materials, index, seen);
}

} // namespace

void validate(const Camera& camera) {
  check_vectors({camera.location, camera.direction, camera.right, camera.up}, {"the camera"});
  check_finite({camera.angle, camera.vertical_angle}, {"the camera"});
  if (camera.angle < 0 || camera.vertical_angle < 0) throw InputError("the camera has a negative angle");
  const std::pair<const Vec3*, const char*> axes[] = {
      {&camera.direction, "direction"}, {&camera.right, "right"}, {&camera.up, "up"}};
  for (const auto& [axis, name] : axes)
    if (*axis == Vec3(0)) throw InputError(std::string("the camera's ") + name + " is 0");
}

void validate_all_but_objects(const Scene& scene) {
  validate(scene.camera);
  check_vectors({scene.background, scene.mirrored_background.value_or(scene.background)}, {"the background"});
  check_finite({scene.background_transparency}, {"the background"});
  check_vectors({scene.irid_wavelength}, {"the wavelengths"});
  check_vectors({scene.ambient_light}, {"the ambient light"});
  check_finite({scene.assumed_gamma, scene.version, scene.adc_bailout}, {"the scene"});
  if (scene.objects.size() > kMostEntries || scene.materials.size() > kMostEntries ||
      scene.interiors.size() > kMostEntries)
    throw InputError("the scene has more entries than 32 bits can count");
  if (scene.noise_generator < 1 || scene.noise_generator > 3)
    throw InputError("the scene has a noise generator that is not 1 to 3");
  for (std::size_t i = 0; i < scene.fogs.size(); ++i)
    check(scene.fogs[i], {"fog", i});
  for (std::size_t i = 0; i < scene.rainbows.size(); ++i)
    check(scene.rainbows[i], {"rainbow", i});
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    check(scene.lights[i], {"light", i});
  validate_light_groups(scene);
  if (const std::optional<Scene> with_projectors = add_projectors(scene, {Eye(), {}}))
    for (std::size_t i = scene.objects.size(); i < with_projectors->objects.size(); ++i)
      check_object(*with_projectors, with_projectors->objects[i], {"projector", i - scene.objects.size()}, 0);
  validate_textures(scene.materials);
  validate_sky(scene);
  for (std::size_t i = 0; i < scene.interiors.size(); ++i)
    check(scene.interiors[i], {"interior", i});
}

void validate(const Scene& scene) {
  validate_all_but_objects(scene);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    ProgressMonitor::check_cancelled(i);
    check_object(scene, scene.objects[i], {"object", i}, 0);
  }
  std::unordered_set<const Mesh*> meshes;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    check_meshes(scene.objects[i], scene.materials.size(), i, meshes);
}

} // namespace celltrace
