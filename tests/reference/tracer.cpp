#include "reference/tracer.hpp"

#include <algorithm>
#include <cmath>

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "reference/area_light.hpp"
#include "reference/camera.hpp"
#include "reference/textures.hpp"

namespace celltrace::reference {

namespace {

constexpr double kMinHitDistance = 1e-4;
constexpr double kMaxHitDistance = 1e7;
constexpr double kShadowTolerance = 1e-3;

double max_component(const Vec3& v) {
  return std::max({v.x, v.y, v.z});
}

/// What adaptive depth control takes for the strength of a reflection.
double reflected_weight(const Finish& finish, const Vec3& mirrored) {
  if (finish.reflection_fresnel) return max_component(mirrored);
  return std::max(max_component(finish.reflection_min), max_component(finish.reflection_max));
}

/// The interiors around the camera, the largest first.
InteriorStack interiors_around(const std::vector<Shape>& shapes, const Vec3& point) {
  std::vector<const Shape*> around;
  for (const Shape& shape : shapes)
    if (contains(shape, point)) around.push_back(&shape);
  const auto volume = [](const Shape* shape) {
    return std::abs(shape->object->transform.determinant()) * std::pow(shape->sphere.radius, 3);
  };
  std::sort(around.begin(), around.end(),
            [&](const Shape* a, const Shape* b) { return volume(a) > volume(b); });
  InteriorStack stack;
  for (const Shape* shape : around)
    stack.push_back(shape->object->interior);
  return stack;
}

} // namespace

Tracer::Tracer(const Scene& scene)
    : scene_(scene), shapes_(shapes_of(scene)),
      camera_inside_(interiors_around(shapes_, scene.camera.location)) {
  for (const Light& light : scene.lights) {
    projectors_.emplace_back();
    if (!light.projected_through) continue;
    auto alone = std::make_shared<Scene>();
    alone->objects = {*light.projected_through};
    projectors_.back() = {alone, shapes_of(*alone)};
  }
}

Image Tracer::render(int width, int height) const {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::optional<Ray> ray = camera_ray(scene_.camera, (x + 0.5) / width, (y + 0.5) / height);
      const Vec3 colour = ray ? see(*ray) : Vec3(0);
      for (int i = 0; i < 3; ++i)
        image.pixel(x, y)[i] = encode(colour[i], scene_.gamma_mode, scene_.assumed_gamma);
    }
  return image;
}

Vec3 Tracer::see(const Ray& ray) const {
  return trace({ray, 0, 1, camera_inside_});
}

Tracer::Hit Tracer::closest(const Ray& ray, bool mirrored) const {
  Hit hit;
  hit.crossing.distance = kMaxHitDistance;
  for (const Shape& shape : shapes_) {
    if (mirrored ? shape.object->no_reflection : shape.object->no_image) continue;
    for (const Crossing& crossing : cross(shape, ray))
      if (crossing.distance > kMinHitDistance && crossing.distance < hit.crossing.distance)
        hit = {&shape, crossing};
  }
  return hit;
}

Vec3 Tracer::arriving(const Light& light, const Ray& ray, double distance,
                      const InteriorStack& inside) const {
  if (light.projected_through) {
    double nearest = HUGE_VAL;
    for (const Shape& shape : projectors_[static_cast<std::size_t>(&light - scene_.lights.data())].shapes)
      for (const Crossing& crossing : cross(shape, ray))
        if (crossing.distance > kMinHitDistance) nearest = std::min(nearest, crossing.distance);
    if (nearest >= distance) return Vec3(0);
    distance = nearest;
  }
  return light.shadowless ? Vec3(1) : attenuation(ray, distance, inside, light.is_dimmed_by_fog);
}

Vec3 Tracer::fog_share(const Ray& ray, double begin, double end, const InteriorStack& inside) const {
  Vec3 share(1);
  if (std::all_of(inside.begin(), inside.end(), [&](Index i) { return scene_.interiors[i].hollow; }))
    for (const Fog& fog : scene_.fogs)
      share *= through(fog, ray.origin + begin * ray.direction, ray.direction, end - begin).pass;
  return share;
}

Vec3 Tracer::attenuation(const Ray& ray, double distance, InteriorStack inside, bool is_dimmed) const {
  std::vector<Hit> surfaces;
  for (const Shape& shape : shapes_)
    for (const Crossing& c : cross(shape, ray))
      if (!shape.object->no_shadow && c.distance > kShadowTolerance &&
          c.distance < distance - kShadowTolerance)
        surfaces.push_back({&shape, c});
  std::sort(surfaces.begin(), surfaces.end(),
            [](const Hit& a, const Hit& b) { return a.crossing.distance < b.crossing.distance; });
  Vec3 passed(1);
  double last = 0;
  for (const auto& [shape, c] : surfaces) {
    const double weights[3] = {1 - c.u - c.v, c.u, c.v};
    Vec3 filter(0);
    for (int i = 0; i < 3; ++i)
      filter += weights[i] * filter_colour(material_at(shape->material[i], *shape, ray, c).pigment);
    const Interior& interior = scene_.interiors[shape->object->interior];
    const bool leaves = std::find(inside.begin(), inside.end(), shape->object->interior) != inside.end();
    if (leaves && interior.fade_power != 0) filter *= faded(interior, c.distance - last);
    if (interior.caustics != 0) {
      const double cosine =
          std::abs(glm::dot(ray.direction, normal_at(*shape, ray.origin + c.distance * ray.direction, c)));
      filter *= 1 + std::pow(cosine, 45 * interior.caustics);
    }
    if (is_dimmed) passed *= fog_share(ray, last, c.distance, inside);
    cross_surface(inside, shape->object->interior, scene_.interiors);
    passed *= filter;
    last = c.distance;
  }
  if (is_dimmed) passed *= fog_share(ray, last, distance, inside);
  return passed;
}

Vec3 Tracer::in_fog(const Branch& branch, double distance, const Vec3& behind) const {
  for (const Index interior : branch.inside)
    if (!scene_.interiors[interior].hollow) return behind;
  Vec3 added(0), passed(1);
  for (const Fog& fog : scene_.fogs) {
    const Fogged one = through(fog, branch.ray.origin, branch.ray.direction, distance);
    added += one.add;
    passed *= one.pass;
  }
  Vec3 bow_added(0), bow_passed(0);
  int bows = 0;
  for (const Rainbow& rainbow : scene_.rainbows)
    if (const auto one = through(rainbow, branch.ray.direction, distance)) {
      bow_added += one->add;
      bow_passed += one->pass;
      ++bows;
    }
  const Vec3 seen = bows == 0 ? behind : (bow_added + bow_passed * behind) / double(bows);
  return added + passed * seen;
}

Material Tracer::material_at(Index index, const Shape& shape, const Ray& ray,
                             const Crossing& crossing) const {
  Material material = scene_.materials[index];
  const Vec3 point = ray.origin + ray.direction * crossing.distance;
  Vec3 normal = normal_at(shape, point, crossing);
  if (glm::dot(normal, ray.direction) > 0) normal = -normal;
  material.pigment = pigment_at(material.pigment, {point, coordinates_at(shape, point, crossing), normal});
  return material;
}

Vec3 Tracer::trace(const Branch& branch) const {
  if (branch.level >= scene_.max_trace_level || branch.weight < scene_.adc_bailout) return Vec3(0);
  const Hit hit = closest(branch.ray, branch.mirrored);
  constexpr double kNowhere = 1e10;
  if (hit.shape == nullptr) return in_fog(branch, kNowhere, scene_.background);
  Point point;
  point.shape = hit.shape;
  point.distance = hit.crossing.distance;
  point.position = branch.ray.origin + branch.ray.direction * hit.crossing.distance;
  point.normal = normal_at(*hit.shape, point.position, hit.crossing);
  if (glm::dot(point.normal, branch.ray.direction) > 0) point.normal = -point.normal;
  const auto material = [&](int corner) {
    return material_at(hit.shape->material[corner], *hit.shape, branch.ray, hit.crossing);
  };
  if (!hit.shape->blended) return in_fog(branch, point.distance, shade(branch, point, material(0)));

  const double weights[3] = {1 - hit.crossing.u - hit.crossing.v, hit.crossing.u, hit.crossing.v};
  Vec3 sum(0);
  for (int i = 0; i < 3; ++i)
    if (weights[i] >= scene_.adc_bailout) sum += weights[i] * shade(branch, point, material(i));
  return in_fog(branch, point.distance, sum);
}

bool Tracer::shines_on(const Light& light, Index group) const {
  if (group == kNoIndex) return light.is_global;
  const LightGroup& own = scene_.light_groups[group];
  const auto index = static_cast<Index>(&light - scene_.lights.data());
  return (own.global_lights && light.is_global) ||
         std::find(own.lights.begin(), own.lights.end(), index) != own.lights.end();
}

Vec3 Tracer::own_light(const Branch& branch, const Point& point, const Material& material) const {
  const Vec3& direction = branch.ray.direction;
  const Finish& f = material.finish;
  Vec3 sum = material.pigment.rgb * (f.ambient * scene_.ambient_light + f.emission) *
             opacity(material.pigment, scene_.version);
  const Index group = point.shape->object->light_group;
  for (const Light& light : scene_.lights) {
    if (!shines_on(light, group)) continue;
    const Incoming arrival = incoming(light, point.position);
    const Vec3 &to_light = arrival.to_light, &unshadowed = arrival.colour;
    const double distance = arrival.distance;
    const bool is_lit_through = point.shape->object->is_lit_through;
    const double cosine = glm::dot(point.normal, to_light);
    if (cosine < 1e-10 && !is_lit_through && f.diffuse_behind == 0) continue;
    const bool is_parallel = light.parallel || light.kind == Light::Kind::cylinder;
    const auto from_place = [&](int column, int row) {
      const Vec3 offset = area_offset(*light.area, to_light, column, row);
      const Vec3 middle = is_parallel ? light.location - light.point_at : to_light * distance;
      const Vec3 way = glm::normalize(middle + offset);
      // Parallel light ends beside the place itself, and has no shadows behind it.
      const double end = distance > 0 ? glm::dot(light.location + offset - point.position, way) : 0;
      return unshadowed * arriving(light, {point.position, way}, end, branch.inside);
    };
    Vec3 colour = unshadowed;
    if (light.area && !light.shadowless)
      colour = area_mean(*light.area, from_place);
    else
      colour *= arriving(light, {point.position, to_light}, distance, branch.inside);
    sum += lit(material, scene_.version, colour, to_light, direction, point.normal, !light.shadowless,
               is_lit_through) *
           film(f, scene_.irid_wavelength, std::abs(cosine), std::abs(glm::dot(direction, point.normal)));
  }
  return sum;
}

Vec3 Tracer::shade(const Branch& branch, const Point& point, const Material& material) const {
  const Vec3& direction = branch.ray.direction;
  Vec3 sum = own_light(branch, point, material);

  InteriorStack inside = branch.inside;
  const double ratio = cross_surface(inside, point.shape->object->interior, scene_.interiors);
  const double cosine = -glm::dot(direction, point.normal);
  const Vec3 mirrored = reflectivity(
      material, cosine, fresnel_ratio(branch.inside, point.shape->object->interior, scene_.interiors));
  Vec3 filter = filter_colour(material.pigment);
  if (material.finish.conserve_energy) filter *= 1.0 - mirrored;
  const Index own = point.shape->object->interior;
  const bool leaves = std::find(branch.inside.begin(), branch.inside.end(), own) != branch.inside.end();
  const Vec3 left =
      scene_.interiors[own].refraction * (leaves ? faded(scene_.interiors[own], point.distance) : Vec3(1));
  const Vec3 filmed = film(material.finish, scene_.irid_wavelength, cosine, cosine);

  if (grey(filter) > scene_.adc_bailout) {
    const double weight = branch.weight * max_component(filter);
    if (std::abs(ratio - 1) < 1e-6) {
      // Goes on at the same level, although only if there is one more.
      if (branch.level + 1 < scene_.max_trace_level)
        sum += left * filter *
               trace({{point.position, direction}, branch.level, weight, inside, branch.mirrored});
    } else if (const auto bent = refract(direction, point.normal, ratio)) {
      sum +=
          left * filter * trace({{point.position, *bent}, branch.level + 1, weight, inside, branch.mirrored});
    } else {
      const Ray back{point.position, mirror(direction, point.normal)};
      return sum + left * filmed * trace({back, branch.level + 1, weight, branch.inside, branch.mirrored});
    }
  }
  const double strength = reflected_weight(material.finish, mirrored);
  if (strength <= 0) return sum;
  const Vec3 seen = trace({{point.position, mirror(direction, point.normal)},
                           branch.level + 1,
                           branch.weight * strength,
                           branch.inside,
                           true});
  return sum + mirrored * glm::pow(filmed * seen, Vec3(1 / material.finish.reflection_exponent));
}

} // namespace celltrace::reference
