// A ray tracer to compare with: Whitted's, in double precision and by brute force, with POV-Ray 3.7's
// formulas. Slow. Of textures it has pigments of patterns without noise.
#pragma once

#include "celltrace/image.hpp"
#include "reference/geometry.hpp"
#include "reference/shading.hpp"

namespace celltrace::reference {

class Tracer {
public:
  /// The scene must outlive the tracer.
  explicit Tracer(const Scene& scene);

  Image render(int width, int height) const;
  /// What a ray from the camera sees.
  Vec3 see(const Ray& ray) const;
  /// Multiplier of a light's colour at the end of `distance` along a shadow ray.
  /// `inside`: what the ray begins in; nothing if it is not given.
  Vec3 attenuation(const Ray& ray, double distance, InteriorStack inside = {}, bool is_dimmed = false) const;

  struct Hit {
    const Shape* shape = nullptr; ///< none: the background
    Crossing crossing{};
  };
  /// `mirrored`: the ray comes from a mirror.
  Hit closest(const Ray& ray, bool mirrored = false) const;

private:
  /// A ray on its way down the tree.
  struct Branch {
    Ray ray;
    int level;
    double weight;
    InteriorStack inside;
    bool mirrored = false;
  };
  struct Point {
    Vec3 position, normal;
    const Shape* shape;
    double distance; ///< from where the ray began
  };

  /// With the pigment that it has there.
  Material material_at(Index index, const Shape& shape, const Ray& ray, const Crossing& crossing) const;
  Vec3 trace(const Branch& branch) const;
  Vec3 shade(const Branch& branch, const Point& point, const Material& material) const;
  /// What a light sends of what it would without anything in the way.
  Vec3 arriving(const Light& light, const Ray& ray, double distance, const InteriorStack& inside) const;
  /// What fogs leave of light on a part of its way.
  Vec3 fog_share(const Ray& ray, double begin, double end, const InteriorStack& inside) const;
  /// `group`: that of an object.
  bool shines_on(const Light& light, Index group) const;
  Vec3 own_light(const Branch& branch, const Point& point, const Material& material) const;
  /// What is seen of `behind` through the fogs.
  Vec3 in_fog(const Branch& branch, double distance, const Vec3& behind) const;

  const Scene& scene_;
  std::vector<Shape> shapes_;
  struct Projector {
    std::shared_ptr<const Scene> scene; ///< that has no other object
    std::vector<Shape> shapes;
  };
  std::vector<Projector> projectors_; ///< by light
  InteriorStack camera_inside_;
};

} // namespace celltrace::reference
