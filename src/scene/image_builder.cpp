#include "scene/image_builder.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

void copy(const Vec3& from, float* to) {
  for (int i = 0; i < 3; ++i)
    to[i] = static_cast<float>(from[i]);
}

LightRecord make_record(const Light& light) {
  LightRecord r{};
  copy(light.location, r.location);
  copy(light.colour, r.colour);
  r.flags = light.shadowless ? light_flag::shadowless : 0;
  return r;
}

/// The opacity rule changed with language version 3.7.
double opacity(const Pigment& p, double version) {
  if (version < 3.7) return 1 - (p.filter * std::max({p.rgb.x, p.rgb.y, p.rgb.z}) + p.transmit);
  return 1 - p.filter - p.transmit;
}

MaterialRecord make_record(const Material& material, const Scene& scene) {
  const Pigment& p = material.pigment;
  const Finish& f = material.finish;
  MaterialRecord r{};
  copy(p.rgb, r.pigment);
  r.filter = static_cast<float>(p.filter);
  r.transmit = static_cast<float>(p.transmit);
  r.opacity = static_cast<float>(opacity(p, scene.version));
  copy(f.ambient * scene.ambient_light + f.emission, r.ambient);
  r.diffuse = static_cast<float>(f.diffuse);
  r.brilliance = static_cast<float>(f.brilliance);
  r.phong = static_cast<float>(f.phong);
  r.phong_size = static_cast<float>(f.phong_size);
  r.specular = static_cast<float>(f.specular);
  r.inverse_roughness = static_cast<float>(f.roughness > 0 ? 1 / f.roughness : 1e6);
  r.metallic = static_cast<float>(f.metallic);
  copy(f.reflection_min, r.reflection_min);
  copy(f.reflection_max, r.reflection_max);
  r.reflection_falloff = static_cast<float>(f.reflection_falloff);
  r.reflection_metallic = static_cast<float>(f.reflection_metallic);
  r.inverse_reflection_exponent =
      static_cast<float>(f.reflection_exponent != 0 ? 1 / f.reflection_exponent : 1);
  r.flags = (f.reflection_fresnel ? material_flag::fresnel : 0) |
            (f.conserve_energy ? material_flag::conserve_energy : 0);
  return r;
}

bool is_opaque(const Material& material) {
  return material.pigment.filter == 0 && material.pigment.transmit == 0;
}

/// The factor by which a transformation scales everything, or 0 if it does not scale all directions alike.
double uniform_scale(const Transform& t) {
  const double x = glm::length(t.rows[0]);
  const double y = glm::length(t.rows[1]);
  const double z = glm::length(t.rows[2]);
  const double tolerance = 1e-9 * x * x;
  const bool round = std::abs(x - y) <= 1e-9 * x && std::abs(x - z) <= 1e-9 * x &&
                     std::abs(glm::dot(t.rows[0], t.rows[1])) <= tolerance &&
                     std::abs(glm::dot(t.rows[0], t.rows[2])) <= tolerance &&
                     std::abs(glm::dot(t.rows[1], t.rows[2])) <= tolerance;
  return round ? x : 0;
}

class Builder {
public:
  Builder(const Scene& scene, ImageTables& tables) : scene_(scene), tables_(tables) {}

  void add(const Object& object) {
    if (const auto* sphere = std::get_if<Sphere>(&object.shape))
      add_sphere(object, *sphere);
    else
      add_mesh(object, *std::get<std::shared_ptr<const Mesh>>(object.shape));
  }

private:
  ObjectRecord make_object(const Object& object, ObjectKind kind) const {
    ObjectRecord r{};
    r.kind_and_flags = static_cast<std::uint32_t>(kind) | (object.no_shadow ? object_flag::no_shadow : 0);
    r.material = object.material;
    r.interior = object.interior;
    r.normals = kNoOffset;
    return r;
  }

  void add_sphere(const Object& object, const Sphere& sphere) {
    const double radius = std::abs(sphere.radius);
    if (radius == 0) return;
    const double scale = uniform_scale(object.transform);
    ObjectRecord r = make_object(object, scale > 0 ? ObjectKind::sphere : ObjectKind::ellipsoid);
    if (is_opaque(scene_.materials[object.material])) r.kind_and_flags |= object_flag::opaque;
    if (scale > 0) {
      copy(object.transform.point(sphere.centre), r.geometry);
      r.geometry[3] = static_cast<float>(radius * scale);
    } else {
      const Transform inverse = object.transform.inverse();
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) {
          const double value = inverse.rows[column][row] - (column == 3 ? sphere.centre[row] : 0);
          r.geometry[row * 4 + column] = static_cast<float>(value / radius);
        }
    }
    tables_.objects.push_back(r);
  }

  void add_mesh(const Object& object, const Mesh& mesh) {
    std::vector<Vec3f> vertices(mesh.vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
      vertices[i] = Vec3f(object.transform.point(Vec3(mesh.vertices[i])));
    std::vector<Vec3f> normals(mesh.normals.size());
    // The inverse transpose, once for the mesh, not once a normal. Normals are of unit length before, not
    // after it: the blend of a triangle's normals is that of the mesh's own space.
    const Vec3 columns[3] = {object.transform.normal({1, 0, 0}), object.transform.normal({0, 1, 0}),
                             object.transform.normal({0, 0, 1})};
    const double scale =
        1 / std::max({glm::length(columns[0]), glm::length(columns[1]), glm::length(columns[2])});
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const Vec3 n(mesh.normals[i]);
      const double length = glm::length(n);
      const Vec3 unit = length > 0 ? n / length : Vec3(0, 0, 1);
      normals[i] = Vec3f(scale * (unit.x * columns[0] + unit.y * columns[1] + unit.z * columns[2]));
    }
    for (const Mesh::Triangle& triangle : mesh.triangles)
      add_triangle(object, triangle, vertices, normals);
  }

  void add_triangle(const Object& object, const Mesh::Triangle& triangle, const std::vector<Vec3f>& vertices,
                    const std::vector<Vec3f>& normals) {
    const Vec3f corners[3] = {vertices[triangle.vertex[0]], vertices[triangle.vertex[1]],
                              vertices[triangle.vertex[2]]};
    const Vec3 area = glm::cross(Vec3(corners[1]) - Vec3(corners[0]), Vec3(corners[2]) - Vec3(corners[0]));
    if (glm::dot(area, area) == 0) return;
    ObjectRecord r = make_object(object, ObjectKind::triangle);
    set_material(r, object, triangle);
    for (int v = 0; v < 3; ++v)
      for (int i = 0; i < 3; ++i)
        r.geometry[v * 3 + i] = corners[v][i];
    if (triangle.normal[0] != kNoIndex && !same(triangle.normal)) {
      r.kind_and_flags |= object_flag::smooth;
      r.normals = static_cast<std::uint32_t>(tables_.normals.size());
      NormalsRecord record{};
      for (int v = 0; v < 3; ++v)
        for (int i = 0; i < 3; ++i)
          record.normal[v * 3 + i] = normals[triangle.normal[v]][i];
      tables_.normals.push_back(record);
    }
    tables_.objects.push_back(r);
  }

  static bool same(const Index (&index)[3]) { return index[0] == index[1] && index[0] == index[2]; }

  void set_material(ObjectRecord& r, const Object& object, const Mesh::Triangle& triangle) {
    Index materials[3];
    for (int i = 0; i < 3; ++i)
      materials[i] = triangle.material[i] != kNoIndex ? triangle.material[i] : object.material;
    const bool opaque = std::all_of(std::begin(materials), std::end(materials),
                                    [&](Index m) { return is_opaque(scene_.materials[m]); });
    if (opaque) r.kind_and_flags |= object_flag::opaque;
    r.material = materials[0];
    if (same(materials)) return;
    r.kind_and_flags |= object_flag::blended;
    r.material = static_cast<std::uint32_t>(tables_.blends.size());
    tables_.blends.push_back({{materials[0], materials[1], materials[2]}, 0});
  }

  const Scene& scene_;
  ImageTables& tables_;
};

/// Single precision has to hold the squares of coordinates.
void check_size(const Box& box) {
  constexpr float kMost = 1e18f;
  for (int i = 0; i < 3; ++i)
    if (!(box.min[i] > -kMost && box.max[i] < kMost))
      throw InputError(
          "the scene has an object that is too large, too thin or too far away for single precision");
}

Box bounds_of(const std::vector<ObjectRecord>& objects) {
  if (objects.empty()) return {{0, 0, 0}, {1, 1, 1}};
  Box all = bounding_box(objects.front());
  for (const ObjectRecord& object : objects) {
    const Box box = bounding_box(object);
    check_size(box);
    for (int i = 0; i < 3; ++i) {
      all.min[i] = std::min(all.min[i], box.min[i]);
      all.max[i] = std::max(all.max[i], box.max[i]);
    }
  }
  float largest = 0;
  for (int i = 0; i < 3; ++i)
    largest = std::max({largest, all.max[i] - all.min[i], std::abs(all.min[i]), std::abs(all.max[i])});
  for (int i = 0; i < 3; ++i) {
    all.min[i] -= largest * 1e-5f;
    all.max[i] += largest * 1e-5f;
  }
  return all;
}

} // namespace

ImageTables build_tables(const Scene& scene) {
  ImageTables tables;
  for (const Light& light : scene.lights)
    tables.lights.push_back(make_record(light));
  for (const Material& material : scene.materials)
    tables.materials.push_back(make_record(material, scene));
  for (const Interior& interior : scene.interiors)
    tables.interiors.push_back({static_cast<float>(interior.ior), {0, 0, 0}});
  Builder builder(scene, tables);
  for (const Object& object : scene.objects)
    builder.add(object);
  tables.bounds = bounds_of(tables.objects);
  return tables;
}

void make_offsets(ImageTables& tables, const ImageHeader& header) {
  const auto material = [&](std::uint32_t index) {
    return header.material_offset + index * static_cast<std::uint32_t>(sizeof(MaterialRecord));
  };
  for (BlendRecord& blend : tables.blends)
    for (std::uint32_t& index : blend.material)
      index = material(index);
  for (ObjectRecord& object : tables.objects) {
    object.material =
        (object.kind_and_flags & object_flag::blended) != 0
            ? header.blend_offset + object.material * static_cast<std::uint32_t>(sizeof(BlendRecord))
            : material(object.material);
    object.interior =
        header.interior_offset + object.interior * static_cast<std::uint32_t>(sizeof(InteriorRecord));
    if ((object.kind_and_flags & object_flag::smooth) != 0)
      object.normals =
          header.normals_offset + object.normals * static_cast<std::uint32_t>(sizeof(NormalsRecord));
  }
}

} // namespace celltrace
