#include "scene_image/texture_checks.hpp"

#include "celltrace/error.hpp"
#include "geometry/shape_geometry.hpp"
#include "kernel/textures/map_walk.hpp"
#include "scene_image/list_waves.hpp"
#include "scene_image/patterns.hpp"
#include "scene_image/shapes.hpp"
#include "scene_image/textures.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace celltrace {

using namespace kernel;

namespace {

static_assert(kDeepestMap == kDeepestMapWalk);

class Check {
public:
  /// Begins checks of a texture that errors call `name`. `has_surface` tells whether an object of the scene
  /// has it.
  explicit Check(std::string name, bool has_surface = true)
      : name_(std::move(name)), has_surface_(has_surface) {}

  /// Continues with another texture. Maps that it shares with earlier textures are not checked again.
  void rename(std::string name) { name_ = std::move(name); }

  void material(const Material& m, int depth, int layers) {
    if (m.inside) {
      if (m.inside->inside) fail("looks different from inside, and there again");
      material(*m.inside, 0, 1);
    }
    if (m.map)
      return map(*m.map, depth, [&](const Material& entry, int inside) { material(entry, inside, 1); });
    pigment(m.pigment, 0);
    const Finish& f = m.finish;
    vectors({f.ambient, f.emission, f.reflection_min, f.reflection_max});
    numbers({f.diffuse, f.diffuse_behind, f.brilliance, f.phong, f.phong_size, f.specular, f.roughness,
             f.metallic, f.reflection_falloff, f.reflection_exponent, f.reflection_metallic, f.crand, f.irid,
             f.irid_thickness, f.irid_turbulence});
    if (m.normal) normal(*m.normal, 0);
    if (!m.below) return;
    if (layers == kMostLayers) fail("has more than " + std::to_string(kMostLayers) + " layers");
    if (m.below->map) fail("has a texture map for a layer");
    material(*m.below, depth, layers + 1);
  }

private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + " " + what); }
  void numbers(std::initializer_list<double> values) const {
    for (const double value : values)
      if (!std::isfinite(value)) fail("has a number that is not finite");
  }
  void vectors(std::initializer_list<Vec3> values) const {
    for (const Vec3& v : values)
      numbers({v.x, v.y, v.z});
  }

  void pigment(const Pigment& p, int depth) {
    if (p.map) return map(*p.map, depth, [&](const Pigment& entry, int inside) { pigment(entry, inside); });
    vectors({p.rgb});
    numbers({p.filter, p.transmit});
  }
  void normal(const Normal& n, int depth) {
    if (n.map) return map(*n.map, depth, [&](const Normal& entry, int inside) { normal(entry, inside); });
    numbers({n.amount, n.accuracy});
    if (!(n.accuracy > 0)) fail("has a normal whose accuracy is not greater than 0");
    if (is_colour(n.pattern)) fail("has a pattern of colours that is no pigment's");
    if (n.slopes.size() > kMostMapEntries)
      fail("has a slope map of more than " + std::to_string(kMostMapEntries) + " entries");
    for (const SlopePoint& point : n.slopes)
      numbers({point.position, point.height, point.slope});
    ascending(n.slopes);
    pattern(n.pattern, depth);
  }
  void check_depth(int depth) const {
    if (depth == kDeepestMap) fail("has maps that nest more than " + std::to_string(kDeepestMap) + " deep");
  }
  /// Throws InputError unless positions ascend.
  template <class Entries> void ascending(const Entries& entries) const {
    const auto descends = [](const auto& a, const auto& b) { return a.position > b.position; };
    const auto found = std::adjacent_find(entries.begin(), entries.end(), descends);
    if (found != entries.end())
      fail("has a map whose positions do not ascend: that of entry " +
           std::to_string(found - entries.begin() + 1) + " is less than the one before");
  }
  /// Checks a map unless it has been checked at this or a greater depth: trees of shared maps would take for
  /// ever.
  template <class T, class Visit> void map(const PatternMap<T>& map, int depth, Visit visit) {
    check_depth(depth);
    int& deepest = seen_.try_emplace(&map, -1).first->second;
    if (deepest >= depth) return;
    deepest = depth;
    if (map.entries.empty()) fail("has a map without entries");
    const bool is_of_colours = !map.is_average && is_colour(map.pattern);
    if (is_of_colours && !std::is_same_v<T, Pigment>) fail("has a pattern of colours that is no pigment's");
    if (map.entries.size() > kMostMapEntries && !is_of_colours)
      fail("has a map of more than " + std::to_string(kMostMapEntries) + " entries");
    pattern(map.pattern, depth + 1);
    int inside = depth + 1;
    if (!map.is_average && blends_list(map.pattern) && needs_averages(map)) check_depth(inside++);
    double weights = 0;
    for (const auto& entry : map.entries) {
      numbers({entry.position});
      weights += entry.position;
      visit(entry.value, inside);
    }
    if (map.is_average && weights == 0) fail("has an average whose weights add up to 0");
    if (!map.is_average && !is_list(map.pattern)) ascending(map.entries);
  }
  void turbulence(const Turbulence& t) const {
    vectors({t.amount});
    numbers({t.omega, t.lambda});
    if (t.octaves < 1 || t.octaves > 10) fail("has turbulence whose octaves are not 1 to 10");
  }
  void space_step(const Turbulence& t) const { turbulence(t); }
  void space_step(const Transform& t) const {
    vectors({t.rows[0], t.rows[1], t.rows[2], t.rows[3]});
    t.inverse();
  }
  void space_step(const warp::Repeat& w) const {
    numbers({w.width});
    vectors({w.flip, w.offset});
    if (w.axis < 0 || w.axis > 2 || w.width == 0) fail("has a warp that repeats without axis or width");
  }
  void space_step(const warp::BlackHole& w) const {
    vectors({w.centre, w.repeat, w.turbulence});
    numbers({w.radius, w.strength, w.falloff});
    if (!(w.radius > 0)) fail("has a black hole whose radius is not greater than 0");
  }
  void space_step(const warp::Mapping& w) const {
    vectors({w.orientation});
    numbers({w.distance, w.distance_exponent, w.major_radius});
    if (w.orientation == Vec3(0)) fail("has a warp without orientation");
  }
  /// Checks an object whose inside is a pattern, or a part of such an object.
  void solid(const Object& object, int depth) const {
    if (depth > kDeepestCsg) fail("has the pattern of an object that nests too deeply");
    const Vec3(&rows)[4] = object.transform.rows;
    vectors({rows[0], rows[1], rows[2], rows[3]});
    if (std::holds_alternative<std::shared_ptr<const Mesh>>(object.shape))
      fail("has the pattern of an object with a mesh");
    if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
      vectors({sphere->centre});
      numbers({sphere->radius});
    } else if (const auto* csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape)) {
      if (!*csg || (*csg)->parts.empty()) fail("has the pattern of a CSG without parts");
      for (const Object& part : (*csg)->parts)
        solid(part, depth + 1);
    } else {
      const auto* polygon = std::get_if<std::shared_ptr<const Polygon>>(&object.shape);
      if (polygon != nullptr && !*polygon) fail("has the pattern of an object without a polygon");
      validate_shape(object, name_);
    }
    if (!object.clipped_by) return;
    for (const Object& clip : *object.clipped_by)
      solid(clip, depth + 1);
  }
  /// Checks a pattern; `depth` is the number of maps around a pigment that it consists of.
  void pattern(const Pattern& p, int depth) {
    if ((p.uv_mapping || std::holds_alternative<pattern::Slope>(p.kind)) && !has_surface_)
      fail("has a pattern of surfaces, but no surface");
    space_step(p.normal_space);
    turbulence(p.turbulence);
    numbers({p.wave_exponent, p.frequency, p.phase});
    if (p.noise_generator < 0 || p.noise_generator > 3) fail("has a noise generator that is not 0 to 3");
    for (const SpaceStep& step : p.space)
      std::visit([&](const auto& one) { space_step(one); }, step);
    const PatternWords words = pattern_words(p.kind, 1);
    for (const float number : words.parameter)
      numbers({number});
    const SlopeRecord& s = words.slope;
    numbers({s.direction[0], s.direction[1], s.direction[2], s.factor, s.altitude[0], s.altitude[1],
             s.altitude[2], s.offset});
    if (const auto* inside = std::get_if<pattern::Inside>(&p.kind)) solid(*inside->of, 0);
    if (const auto* grey = std::get_if<pattern::Grey>(&p.kind)) {
      check_depth(depth); // a pigment of one colour becomes a map as well
      pigment(*grey->of, depth);
    }
  }

  std::string name_;
  bool has_surface_;
  std::map<const void*, int> seen_; ///< deepest level at which a map was checked; key: its address
};

} // namespace

void validate_textures(const std::vector<Material>& materials) {
  Check check("");
  for (std::size_t i = 0; i < materials.size(); ++i) {
    check.rename("material " + std::to_string(i));
    check.material(materials[i], 0, 1);
  }
}

void validate_sky(const Scene& scene) {
  if (scene.sky_sphere.size() > kMostLayers)
    throw InputError("the sky sphere has more than " + std::to_string(kMostLayers) + " layers");
  Check("the sky sphere", false).material(sky_of(scene), 0, 1);
}

} // namespace celltrace
