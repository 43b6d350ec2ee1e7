// Random scenes, regular only in what a test wants of them.
#pragma once

#include "lanes.hpp"

#include <memory>

namespace celltrace::test {

struct SoupKinds {
  unsigned spheres = 0, ellipsoids = 0, triangles = 0;
};

/// Objects of about `size` within `reach` of the origin: opaque, filtering and blended ones, some without
/// shadow.
inline Scene soup(unsigned seed, const SoupKinds& kinds, double reach, double size) {
  Random random(seed);
  Scene scene;
  for (int i = 0; i < 6; ++i) {
    Material m;
    m.pigment.rgb = {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
    if (i >= 2) m.pigment.filter = random.uniform(0.2, 0.6);
    if (i >= 4) m.pigment.transmit = random.uniform(0.2, 0.4);
    scene.add(m);
  }
  const auto add = [&](auto shape) -> Object& {
    Object object;
    object.shape = std::move(shape);
    object.material = random.below(6);
    object.interior = scene.add(Interior{});
    object.no_shadow = random.below(10) == 0;
    scene.objects.push_back(object);
    return scene.objects.back();
  };
  for (unsigned i = 0; i < kinds.spheres; ++i)
    add(Sphere{random.point(reach), size * random.uniform(0.2, 1)});
  for (unsigned i = 0; i < kinds.ellipsoids; ++i)
    add(Sphere{{0, 0, 0}, size}).transform =
        Transform::scale({random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)})
            .then(Transform::rotate(random.point(180)))
            .then(Transform::translate(random.point(reach)));
  Mesh mesh;
  for (unsigned i = 0; i < kinds.triangles; ++i) {
    const Vec3 place = random.point(reach);
    const Index first = static_cast<Index>(mesh.vertices.size());
    for (int v = 0; v < 3; ++v)
      mesh.vertices.emplace_back(place + random.point(size));
    Mesh::Triangle triangle{{first, first + 1, first + 2}};
    if (i % 3 == 0)
      for (Index& material : triangle.material)
        material = random.below(6);
    mesh.triangles.push_back(triangle);
  }
  if (kinds.triangles > 0) add(std::make_shared<const Mesh>(std::move(mesh)));
  return scene;
}

} // namespace celltrace::test
