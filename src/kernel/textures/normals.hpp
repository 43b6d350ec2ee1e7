// Disturbance of normals by patterns. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/textures/features.hpp"
#include "kernel/textures/map_walk.hpp"

namespace celltrace::kernel {

namespace detail {

/// Returns the height that a slope map has for a pattern's value: curves go through its entries, with each
/// entry's slope (Hermite).
template <class Spu>
typename Spu::rare_simd::F height_of(SceneAccess<Spu>& scene, const PatternRecord& r,
                                     const typename Spu::rare_simd::F& value) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  using M = typename S::M;
  F height(0.0f);
  find_interval<S>(
      scene, r, value,
      [&](const M& some, uint32_t, const MapEntryRecord& entry) {
        height = S::select(some, F(entry.rgb[0]), height);
      },
      [&](const M& some, uint32_t, const MapEntryRecord& below, const MapEntryRecord& above, const F& t) {
        const F one(1.0f), rest = one - t, rise = t * t * (F(3.0f) - t - t);
        const F bend = t * rest * (F(below.rgb[1]) * rest - F(above.rgb[1]) * t);
        height = S::select(some, F(below.rgb[0]) * (one - rise) + F(above.rgb[0]) * rise + bend, height);
      });
  return height;
}

/// Returns the negative slope of the pattern's values, from four points around each point.
template <class Spu>
V3<typename Spu::rare_simd>
slope_disturbance(SceneAccess<Spu>& scene, MapWalk<Spu, TextureStage::normals>& walk, const PatternRecord& r,
                  const PatternPoints<typename Spu::rare_simd>& points, uint32_t lanes, float accuracy) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  // The corners of a tetrahedron.
  static constexpr float kCorners[4][3] = {{0.942809041f, -1.0f / 3, 0.0f},
                                           {-0.471404521f, -1.0f / 3, 0.816496581f},
                                           {-0.471404521f, -1.0f / 3, -0.816496581f},
                                           {0.0f, 1.0f, 0.0f}};
  V3<S> sum = {F(0.0f), F(0.0f), F(0.0f)};
  [[maybe_unused]] const typename Strategy<Spu>::template ScopedNeighbours<Spu> neighbours(scene);
  for (const float(&corner)[3] : kCorners) {
    const V3<S> to = splat3<S>(corner);
    PatternPoints<S> beside = points;
    beside.at = points.at + to * F(accuracy);
    F value;
    if (is_pigment(r))
      value = in_wave<S>(r, walk.grey_of_pigment(r.table, beside, lanes));
    else
      value = pattern_value(scene, r, beside);
    if (r.entry_count != 0) value = height_of(scene, r, value);
    sum = sum + to * value;
  }
  return sum * F(-0.1f / accuracy);
}

/// Computes the transposed inverse of a linear map, times a positive factor.
inline void cofactors(const float (&m)[9], float (&c)[9]) {
  for (uint32_t row = 0; row < 3; ++row) {
    const float* const a = m + (row + 1) % 3 * 3;
    const float* const b = m + (row + 2) % 3 * 3;
    c[row * 3] = a[1] * b[2] - a[2] * b[1];
    c[row * 3 + 1] = a[2] * b[0] - a[0] * b[2];
    c[row * 3 + 2] = a[0] * b[1] - a[1] * b[0];
  }
  const float determinant = m[0] * c[0] + m[1] * c[1] + m[2] * c[2];
  if (determinant < 0.0f)
    for (float& number : c)
      number = -number;
}

/// Disturbs a unit normal by the pattern of `normal`, which is no map but may be in maps of `walk`.
template <class Spu>
CELLTRACE_ONE_COPY void
disturb_by(SceneAccess<Spu>& scene, MapWalk<Spu, TextureStage::normals>& walk, const NormalRecord& normal,
           const PatternPoints<typename Spu::rare_simd>& points, uint32_t lanes,
           const V3<typename Spu::rare_simd>& unit, V3<typename Spu::rare_simd>& disturbed) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  Spu& spu = scene.spu();
  Kept<Spu, PatternRecord> r = *scene.pattern(normal.pattern);
  const PatternPoints<S> own = to_pattern_space<TextureStage::normals>(scene, r, points, lanes);
  const V3<S>& p = own.at;
  float c[9];
  cofactors(normal.linear, c);
  const V3<S> local = normalise<S>(
      {dot<S>(splat3<S>(c), unit), dot<S>(splat3<S>(c + 3), unit), dot<S>(splat3<S>(c + 6), unit)});
  V3<S> change;
  const uint32_t kind = r.kind_and_flags & pattern_flag::kind_mask;
  if (kind == kPatternKind<BumpsPattern> && (r.kind_and_flags & pattern_flag::at_features) != 0) {
    // Facets: along the surface, by the noise at the feature point of the cell; or, if the first parameter is
    // not 0, the direction of the feature point that is nearest to the normal times that parameter.
    const float times = r.parameter[0];
    spu.enter_module(modules::kRarePatterns);
    const V3<S> facet =
        module_rare::nearest_feature(scene, r, times != 0.0f ? local * F(times) : p * F(10.0f));
    if (times != 0.0f) {
      change = facet - local;
    } else {
      spu.enter_module(modules::kNoise);
      change = module_noise::disturbance(spu, r, facet);
      change = change - local * dot<S>(change, local);
    }
  } else if (kind == kPatternKind<DentsPattern> && (r.kind_and_flags & pattern_flag::gradient_noise) != 0) {
    // The depth is noise of generator 3, which has no vectors.
    PatternRecord part = r;
    constexpr auto kNoWave = static_cast<uint32_t>(PatternWave::none) << pattern_flag::wave_shift;
    part.kind_and_flags = kind | kNoWave | pattern_flag::gradient_noise;
    const F depth = pattern_value(scene, part, own);
    part.kind_and_flags = kPatternKind<BumpsPattern>;
    spu.enter_module(modules::kNoise);
    change = module_noise::disturbance(spu, part, p) * depth;
  } else if (!disturbs(kind)) {
    change = slope_disturbance(scene, walk, r, own, lanes, normal.accuracy);
  } else if (Patterns::kCode[kind] == PatternCode::rare) {
    spu.enter_module(modules::kRarePatterns);
    change = module_rare::disturbance(scene, r, p);
  } else {
    spu.enter_module(modules::kNoise);
    change = module_noise::disturbance(spu, r, p);
  }
  const V3<S> n = local + change * F(normal.amount);
  const float* const m = normal.linear;
  disturbed = normalise<S>(splat3<S>(m) * n.x + splat3<S>(m + 3) * n.y + splat3<S>(m + 6) * n.z);
}

/// Disturbs the normals of a part of a packet; see disturb_normal().
template <class Spu>
void disturb_part(SceneAccess<Spu>& scene, const NormalRecord& record,
                  const PatternPoints<typename Spu::rare_simd>& points, uint32_t lanes,
                  V3<typename Spu::rare_simd>& unit) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  const auto take = S::M::from_bits(lanes);
  V3<S> disturbed;
  MapWalk<Spu, TextureStage::normals> walk(scene, points);
  if (record.is_mapped == 0) {
    disturb_by(scene, walk, record, points, lanes, unit, disturbed);
    unit = select<S>(take, disturbed, unit);
    return;
  }
  V3<S> sum = {F(0.0f), F(0.0f), F(0.0f)};
  walk.enter(record.pattern, F(1.0f), lanes);
  MapEntryRecord entry;
  F weight;
  uint32_t some;
  while (walk.next(entry, weight, some)) {
    Kept<Spu, NormalRecord> leaf = *scene.normal(entry.child);
    disturb_by(scene, walk, leaf, points, some, unit, disturbed);
    sum = sum + disturbed * weight;
  }
  unit = select<S>(take, normalise<S>(sum), unit);
}

} // namespace detail

/// Disturbs the normals at `points`, which are unit vectors on the viewer's side, by the record at `offset`.
template <class Spu>
CELLTRACE_ONE_COPY void disturb_normal(SceneAccess<Spu>& scene, uint32_t offset,
                                       const PatternPoints<typename Spu::simd>& points, uint32_t lanes,
                                       V3<typename Spu::simd>& unit) {
  Kept<Spu, NormalRecord> record = *scene.normal(offset);
  for_each_part<Spu>([&](uint32_t first) {
    const uint32_t some = part_of<Spu>(lanes, first);
    if (some == 0) return;
    V3<typename Spu::rare_simd> normal = part_of<Spu>(unit, first);
    detail::disturb_part(scene, record, part_of<Spu>(points, first), some, normal);
    set_part<Spu>(unit, first, normal);
  });
}

} // namespace celltrace::kernel
