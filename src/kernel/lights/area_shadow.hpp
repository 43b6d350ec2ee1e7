// Shadows of area lights, sampled as in POV-Ray: a light has a grid of places, and a place is sampled only if
// the places around it disagree. Kernel dialect.
//
// The value of a quad of the grid is the mean of its corners, or of its quarters if it is divided. The value
// is computed with a stack of quads, each with the weight of its mean. Results of places are kept in a small
// table, as quads share corners.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/lights/incident_light.hpp"
#include "kernel/lights/list.hpp"
#include "kernel/modules.hpp"
#include "records/frame.hpp"
#include "records/light.hpp"

namespace celltrace::kernel {

namespace detail {
// Offsets of lanes by the additive recurrence of the plastic number, which keeps neighbours far apart.
alignas(64) constexpr float kJitterX[kSimdLanes] = {
    0.0f,       0.7548777f, 0.5097553f, 0.2646330f, 0.0195107f, 0.7743883f, 0.5292660f, 0.2841436f,
    0.0390213f, 0.7938990f, 0.5487767f, 0.3036543f, 0.0585320f, 0.8134097f, 0.5682873f, 0.3231650f};
alignas(64) constexpr float kJitterY[kSimdLanes] = {
    0.0f,       0.5698403f, 0.1396806f, 0.7095209f, 0.2793612f, 0.8492015f, 0.4190417f, 0.9888820f,
    0.5587223f, 0.1285626f, 0.6984029f, 0.2682432f, 0.8380835f, 0.4079238f, 0.9777641f, 0.5476044f};
} // namespace detail

/// A place on the grid of a light.
struct LightPlace {
  uint32_t column, row;
};

/// A quad of the grid, and the lanes that sample it.
struct LightQuad {
  uint8_t left, top, right, bottom;
  uint16_t lanes, level;
  float weight; ///< weight of the mean of its corners

  static LightQuad whole(const LightRecord& light, uint32_t lanes) {
    return {0,
            0,
            static_cast<uint8_t>(light.columns - 1),
            static_cast<uint8_t>(light.rows - 1),
            static_cast<uint16_t>(lanes),
            0,
            1.0f};
  }
  bool has_places_between() const { return right > left + 1 || bottom > top + 1; }
  LightPlace corner(uint32_t number) const {
    return {(number & 1) == 0 ? left : right, (number & 2) == 0 ? top : bottom};
  }
  /// Calls `push(quarter)` for the quarters, which the lanes `among` sample. Quarters share the middle, or
  /// lie on both sides of it. A quad that is one row or column wide has two halves instead.
  template <class Push> void divide(uint32_t among, const Push& push) const {
    const uint32_t x0 = (left + right) / 2u, x1 = (left + right + 1u) / 2u;
    const uint32_t y0 = (top + bottom) / 2u, y1 = (top + bottom + 1u) / 2u;
    const bool column = left == right, row = top == bottom;
    const float share = weight * (column || row ? 0.5f : 0.25f);
    const auto push_quarter = [&](uint32_t x, uint32_t y, uint32_t to_x, uint32_t to_y) {
      push(LightQuad{static_cast<uint8_t>(x), static_cast<uint8_t>(y), static_cast<uint8_t>(to_x),
                     static_cast<uint8_t>(to_y), static_cast<uint16_t>(among),
                     static_cast<uint16_t>(level + 1), share});
    };
    push_quarter(left, top, x0, y0);
    if (!column) push_quarter(x1, top, right, y0);
    if (!row) push_quarter(left, y1, x0, bottom);
    if (!column && !row) push_quarter(x1, y1, right, bottom);
  }
};

namespace module_areas {

/// Returns a pseudo-random number in [0, 1) that depends on the place alone, so that pictures do not depend
/// on which SPE renders them or how often.
inline float scattered(uint32_t place) {
  uint32_t bits = (place ^ (place >> 16)) * 0x45D9F3Bu;
  bits = (bits ^ (bits >> 16)) * 0x45D9F3Bu;
  return static_cast<float>((bits ^ (bits >> 16)) >> 8) * (1.0f / 16777216.0f);
}

/// Returns a jitter from -1/2 to 1/2 for the sum of a lane's and a place's numbers, each from 0 to 1.
template <class S> [[gnu::always_inline]] inline typename S::F jitter(const typename S::F& sum) {
  using F = typename S::F;
  return S::select(sum >= F(1.0f), sum - F(1.5f), sum - F(0.5f));
}

/// Pseudo-random numbers of a place for its jitter along both axes.
struct PlaceJitter {
  float x, y;

  explicit PlaceJitter(const LightPlace& place) {
    const uint32_t number = place.row * kMaxLightPlaces + place.column;
    x = scattered(2 * number + 1);
    y = scattered(2 * number + 2);
  }
};

/// Returns the vector from the middle of a light to a column and row on it, which may lie between places.
/// `to_middle` points from the surface to the middle.
template <class S>
[[gnu::always_inline]] inline V3<S> offset_at(const LightRecord& light, const V3<S>& to_middle,
                                              const typename S::F& column, const typename S::F& row) {
  using F = typename S::F;
  const uint32_t flags = light.kind_and_flags;
  F u = light.columns > 1 ? column * F(light.inverse_columns) - F(0.5f) : F(0.0f);
  F v = light.rows > 1 ? row * F(light.inverse_rows) - F(0.5f) : F(0.0f);
  if ((flags & light_flag::circular) != 0) {
    // Each square around the middle is mapped to a circle. POV-Ray's circles are off the middle by 0.001.
    u = u + F(0.001f);
    v = v + F(0.001f);
    const F shrunk = S::max(S::abs(u), S::abs(v)) / S::max(S::sqrt(u * u + v * v), F(1e-30f));
    u = u * shrunk;
    v = v * shrunk;
  }
  V3<S> across = splat3<S>(light.across), along = splat3<S>(light.along);
  if ((flags & light_flag::orient) != 0) {
    // Both axes turn toward the surface, and have the length of the first axis.
    const F zero(0.0f), one(1.0f), length = S::sqrt(dot<S>(across, across));
    const V3<S> toward = normalise<S>(to_middle);
    const auto near_z = S::abs(toward.z) > F(0.99f);
    const V3<S> beside = {zero, S::select(near_z, one, zero), S::select(near_z, zero, one)};
    const V3<S> sideways = normalise<S>(cross<S>(toward, beside));
    across = sideways * length;
    along = cross<S>(toward, sideways) * length;
  }
  return across * u + along * v;
}

/// Returns the vector from the middle to a place, with jitter, for the part of a packet that begins at lane
/// `first`.
template <class S>
V3<S> offset_of(const LightRecord& light, const V3<S>& to_middle, const LightPlace& place, uint32_t first) {
  using F = typename S::F;
  F column(static_cast<float>(place.column)), row(static_cast<float>(place.row));
  if ((light.kind_and_flags & light_flag::jitter) != 0) {
    const PlaceJitter of_place(place);
    column = column + jitter<S>(F::load(detail::kJitterX + first) + F(of_place.x));
    row = row + jitter<S>(F::load(detail::kJitterY + first) + F(of_place.y));
  }
  return offset_at<S>(light, to_middle, column, row);
}

/// Sets the ray from surfaces to a place on a light, and its length. As in POV-Ray, parallel light from a
/// place has the direction of the whole light, and its rays end beside the place. Nothing occludes points
/// behind the light.
template <class S>
void aim_part(const LightRecord& light, const V3<S>& points, const V3<S>& to_middle, const LightPlace& place,
              uint32_t first, IncidentLight<S>& from_place) {
  using F = typename S::F;
  const bool parallel = is_parallel(light);
  const V3<S> toward = parallel ? splat3<S>(light.axis) * F(-light.axis_length) : to_middle;
  const V3<S> offset = offset_of<S>(light, toward, place, first);
  from_place.set_ray(toward + offset);
  if (!parallel) return;
  const F beside = dot<S>(splat3<S>(light.location) + offset - points, from_place.direction);
  const F zero(0.0f);
  from_place.distance = S::select(dot<S>(to_middle, to_middle) > zero, S::max(beside, zero), zero);
}
template <class Spu>
void aim(const LightRecord& light, const V3<typename Spu::simd>& points,
         const V3<typename Spu::simd>& to_middle, const LightPlace& place, V3<typename Spu::simd>& direction,
         typename Spu::simd::F& distance) {
  using R = typename Spu::rare_simd;
  for_each_part<Spu>([&](uint32_t first) {
    IncidentLight<R> from_place;
    aim_part<R>(light, part_of<Spu>(points, first), part_of<Spu>(to_middle, first), place, first, from_place);
    set_part<Spu>(direction, first, from_place.direction);
    set_part<Spu>(distance, first, from_place.distance);
  });
}

/// Sets the light that comes from a place, with the colour of the light from the middle.
template <class Spu>
CELLTRACE_ONE_COPY void aim_shadow_rays(Spu& spu, const LightRecord& light,
                                        const Surfaces<typename Spu::simd>& s, const LightPlace& place,
                                        const IncidentLight<typename Spu::simd>& middle,
                                        IncidentLight<typename Spu::simd>& from_place) {
  spu.run_in_module(modules::kAreas);
  aim<Spu>(light, s.point, middle.direction * middle.distance, place, from_place.direction,
           from_place.distance);
  from_place.colour = middle.colour;
  from_place.facing = middle.facing;
}

} // namespace module_areas

/// The state of sampling a light that surfaces of a packet face. The caller gets places one by one from
/// next_place(), and stores the light that comes from a place in light(), or reports with answer() the lanes
/// that the whole light reaches.
template <class S> struct AreaShadow {
  ShadowRays* to_place; ///< rays to the current place
  /// Returns the light of the current place: before sampling the whole light, afterwards the part that comes
  /// through.
  VectorLanes& light() { return colour[corner_count]; }

  // The members below are internal.
  static constexpr uint32_t kCorners = 4;
  static constexpr float kTolerance = 0.1f; ///< difference of colours up to which corners agree
  static constexpr uint32_t kDivisions = 9; ///< number of divisions of the longest grid
  static constexpr uint32_t kMaxQuads = 3 * kDivisions + 1;
  static constexpr uint32_t kPlaces = 256; ///< size of the table
  static_assert((1u << (kDivisions - 1)) >= kMaxLightPlaces);

  /// A place, and the lanes in which all or none of its light comes through.
  struct CachedPlace {
    uint16_t place, lit, dark;
  };
  static_assert(kMaxLightPlaces * kMaxLightPlaces <= 1u << 16);

  VectorLanes to_middle, whole;
  FloatLanes share;    ///< share of the whole light, summed over the places sampled so far
  VectorLanes more;    ///< tinted light, in addition to `share`; only in lanes with `is_tinted`
  uint32_t is_tinted;  ///< lanes
  uint32_t is_visible; ///< lanes in which the difference between all and no light is visible
  // Light from the corners of the quad: in `lit` lanes the whole light, in `tinted` lanes a colour, in others
  // none.
  VectorLanes colour[kCorners];
  uint32_t lit[kCorners], tinted[kCorners];
  CachedPlace cache[kPlaces];
  LightQuad quads[kMaxQuads];
  uint32_t quad_count;
  uint32_t corner_count; ///< number of finished corners
  LightQuad quad;        ///< current quad

  LightPlace place; ///< current place
  uint32_t lanes;
  uint32_t ray_count; ///< number of rays so far

  CachedPlace& cached_at(const LightPlace& at) {
    const auto name = static_cast<uint16_t>(at.row * kMaxLightPlaces + at.column);
    CachedPlace& entry = cache[(at.row * 17 + at.column) % kPlaces];
    if (entry.place != name) entry = {name, 0, 0};
    return entry;
  }
};

namespace module_areas {

template <class S>
CELLTRACE_ONE_COPY void begin_area(const LightRecord& light, const Surfaces<S>& s,
                                   const IncidentLight<S>& incident, AreaShadow<S>& a) {
  using F = typename S::F;
  a.to_place->rays.origin.template store<S>(s.point);
  a.to_place->rays.start_object = *s.objects;
  a.to_middle.template store<S>(incident.direction * incident.distance);
  a.whole.template store<S>(incident.colour);
  F(0.0f).store(a.share.lane);
  a.is_tinted = 0;
  a.is_visible = (absolute_sum<S>(incident.colour) > F(AreaShadow<S>::kTolerance)).bits();
  for (typename AreaShadow<S>::CachedPlace& entry : a.cache)
    entry = {0, 0, 0}; // place 0 is unknown, too
  a.ray_count = 0;
  a.quad_count = 0;
  a.lanes = 0;
  a.corner_count = 0;
  a.quad = LightQuad::whole(light, incident.facing);
}

/// Stores the result for the current place: its `lit` and `tinted` lanes.
template <class S> void take_answer(AreaShadow<S>& a, uint32_t lit, uint32_t tinted) {
  const uint32_t corner = a.corner_count++;
  typename AreaShadow<S>::CachedPlace& cached = a.cached_at(a.place);
  a.lit[corner] |= lit;
  a.tinted[corner] = tinted;
  cached.lit |= static_cast<uint16_t>(lit);
  cached.dark |= static_cast<uint16_t>(a.lanes & ~(lit | tinted));
  a.lanes = 0;
}
template <class S> void take_colours(AreaShadow<S>& a) {
  using F = typename S::F;
  const V3<S> came = a.light().template load<S>(), whole = a.whole.template load<S>();
  const F zero(0.0f);
  const auto lit = (came.x == whole.x) & (came.y == whole.y) & (came.z == whole.z);
  const auto dark = (came.x == zero) & (came.y == zero) & (came.z == zero);
  take_answer(a, a.lanes & lit.bits(), a.lanes & ~(lit | dark).bits());
}

/// Returns the colour of a corner for the part of the packet that begins at lane `first`.
template <class Spu>
V3<typename Spu::rare_simd> colour_of(const AreaShadow<typename Spu::simd>& a, uint32_t number,
                                      uint32_t first) {
  using R = typename Spu::rare_simd;
  using F = typename R::F;
  const V3<R> dark = {F(0.0f), F(0.0f), F(0.0f)};
  const V3<R> untinted = select<R>(R::M::from_bits(part_of<Spu>(a.lit[number], first)),
                                   a.whole.template load_from<R>(first), dark);
  return select<R>(R::M::from_bits(part_of<Spu>(a.tinted[number], first)),
                   a.colour[number].template load_from<R>(first), untinted);
}
/// Returns the lanes of `tinted` in which neighbouring corners differ so much that the quad has to be
/// divided.
template <class Spu>
CELLTRACE_ONE_COPY uint32_t disagreement(const AreaShadow<typename Spu::simd>& a, uint32_t tinted) {
  using R = typename Spu::rare_simd;
  using F = typename R::F;
  constexpr uint32_t kRound[] = {0, 1, 3, 2};
  uint32_t differ = 0;
  for_each_part<Spu>([&](uint32_t first) {
    V3<R> before = colour_of<Spu>(a, 2, first);
    for (const uint32_t corner : kRound) {
      const V3<R> next = colour_of<Spu>(a, corner, first);
      differ |= (absolute_sum<R>(before - next) > F(a.kTolerance)).bits() << first;
      before = next;
    }
  });
  return differ & tinted;
}
/// Adds `weight` times the light of the corners to the tinted light.
template <class Spu>
CELLTRACE_ONE_COPY void add_tinted(AreaShadow<typename Spu::simd>& a, uint32_t lanes, float weight) {
  using R = typename Spu::rare_simd;
  using F = typename R::F;
  for_each_part<Spu>([&](uint32_t first) {
    V3<R> sum = colour_of<Spu>(a, 0, first);
    for (uint32_t i = 1; i < a.kCorners; ++i)
      sum = sum + colour_of<Spu>(a, i, first);
    const F zero(0.0f), added = R::select(R::M::from_bits(part_of<Spu>(lanes, first)), F(weight), zero);
    const V3<R> none = {zero, zero, zero};
    const V3<R> before = select<R>(R::M::from_bits(part_of<Spu>(a.is_tinted, first)),
                                   a.more.template load_from<R>(first), none);
    a.more.template store_from<R>(first, before + sum * added);
  });
  a.is_tinted |= lanes;
}

/// Finishes a quad with known corners: adds their mean in lanes where they agree, and divides the quad in
/// other lanes.
template <class Spu> void finish_quad(const LightRecord& light, AreaShadow<typename Spu::simd>& a) {
  using S = typename Spu::simd;
  using F = typename S::F;
  const LightQuad q = a.quad;
  const uint32_t tinted = (a.tinted[0] | a.tinted[1] | a.tinted[2] | a.tinted[3]) & q.lanes;
  uint32_t divided = 0;
  if (q.has_places_between()) {
    if (q.level < light.adaptive) {
      divided = q.lanes;
    } else {
      const uint32_t any = a.lit[0] | a.lit[1] | a.lit[2] | a.lit[3],
                     all = a.lit[0] & a.lit[1] & a.lit[2] & a.lit[3];
      divided = any & ~all & a.is_visible;
      if (tinted != 0) divided = (divided & ~tinted) | disagreement<Spu>(a, tinted);
      divided &= q.lanes;
    }
  }
  const uint32_t agreed = q.lanes & ~divided;
  if (agreed != 0) {
    // Weights are powers of 2, so that the sum is exact.
    const float weight = 0.25f * q.weight;
    F share = F::load(a.share.lane);
    for (const uint32_t lit : a.lit)
      share = S::select(S::M::from_bits(lit & agreed & ~tinted), share + F(weight), share);
    share.store(a.share.lane);
    if ((agreed & tinted) != 0) add_tinted<Spu>(a, agreed & tinted, weight);
  }
  if (divided != 0) q.divide(divided, [&](const LightQuad& quarter) { a.quads[a.quad_count++] = quarter; });
}

/// Advances to the next place to sample. Returns false if there is none.
template <class Spu>
CELLTRACE_ONE_COPY bool next_sample(Spu& spu, const LightRecord& light, AreaShadow<typename Spu::simd>& a) {
  using S = typename Spu::simd;
  using F = typename S::F;
  spu.run_in_module(modules::kAreas);
  if (a.lanes != 0) take_colours<S>(a);
  for (;;) {
    for (; a.corner_count < AreaShadow<S>::kCorners; ++a.corner_count) {
      const LightPlace place = a.quad.corner(a.corner_count);
      const typename AreaShadow<S>::CachedPlace& cached = a.cached_at(place);
      a.lit[a.corner_count] = cached.lit;
      a.tinted[a.corner_count] = 0;
      const uint32_t lanes = a.quad.lanes & ~uint32_t(cached.lit | cached.dark);
      if (lanes == 0) continue;
      V3<S> direction;
      F distance;
      aim<Spu>(light, a.to_place->rays.origin.template load<S>(), a.to_middle.template load<S>(), place,
               direction, distance);
      a.to_place->rays.direction.template store<S>(direction);
      distance.store(a.to_place->distance.lane);
      a.light() = a.whole;
      a.place = place;
      a.lanes = lanes;
      a.ray_count += static_cast<uint32_t>(__builtin_popcount(lanes));
      return true;
    }
    finish_quad<Spu>(light, a);
    if (a.quad_count == 0) return false;
    a.quad = a.quads[--a.quad_count];
    a.corner_count = 0;
  }
}

/// Scales `sent`, the light that surfaces send on if nothing occludes the light, by the sampled share of the
/// light. Channels that the light does not have become 0.
template <class Spu>
CELLTRACE_ONE_COPY void dim(Spu& spu, const AreaShadow<typename Spu::simd>& a, VectorLanes& sent) {
  using R = typename Spu::rare_simd;
  using F = typename R::F;
  spu.run_in_module(modules::kAreas);
  const F zero(0.0f);
  const auto share_of = [&](const F& some, const F& of) { return R::select(of == zero, zero, some / of); };
  for_each_part<Spu>([&](uint32_t first) {
    const F share = F::load(a.share.lane + first);
    V3<R> left = {share, share, share};
    const uint32_t tinted = part_of<Spu>(a.is_tinted, first);
    if (tinted != 0) {
      const V3<R> sum = a.more.template load_from<R>(first), all = a.whole.template load_from<R>(first);
      const V3<R> more = {share_of(sum.x, all.x), share_of(sum.y, all.y), share_of(sum.z, all.z)};
      left = select<R>(R::M::from_bits(tinted), left + more, left);
    }
    sent.store_from<R>(first, sent.load_from<R>(first) * left);
  });
}

} // namespace module_areas

/// Allocates local store for the sampling of area lights, if the scene has any.
template <class Spu> AreaShadow<typename Spu::simd>* allocate_area_shadow(Spu& spu, const FrameBlock& frame) {
  if (!has_areas(frame)) return nullptr;
  return spu.template allocate<AreaShadow<typename Spu::simd>>();
}

/// Starts the sampling of a light for the surfaces that face it; `to_place` will hold the rays.
template <class Spu>
void begin_sampling(Spu& spu, const LightRecord& light, const Surfaces<typename Spu::simd>& s,
                    const IncidentLight<typename Spu::simd>& incident, ShadowRays& to_place,
                    AreaShadow<typename Spu::simd>& shadow) {
  spu.enter_module(modules::kAreas);
  shadow.to_place = &to_place;
  module_areas::begin_area<typename Spu::simd>(light, s, incident, shadow);
}

/// Advances to the next place to sample. Returns false if there is none.
template <class Spu>
bool next_place(Spu& spu, const LightRecord& light, AreaShadow<typename Spu::simd>& shadow) {
  spu.enter_module(modules::kAreas);
  return module_areas::next_sample(spu, light, shadow);
}

/// Reports that all light of the current place comes in `lit` lanes, and none in others.
template <class S> void answer(AreaShadow<S>& shadow, uint32_t lit) {
  module_areas::take_answer(shadow, lit, 0);
}

/// Samples an area light and scales `sent`, the light that surfaces send on if nothing occludes the light, by
/// the result. `trace(shadow)` stores in `shadow.light()` the light that comes from `shadow.place`. Returns
/// the number of rays.
template <class Spu, class Trace>
uint32_t sample_area(Spu& spu, const LightRecord& light, const Surfaces<typename Spu::simd>& s,
                     const IncidentLight<typename Spu::simd>& incident, ShadowRays& to_place,
                     AreaShadow<typename Spu::simd>& shadow, VectorLanes& sent, Trace trace) {
  begin_sampling(spu, light, s, incident, to_place, shadow);
  while (next_place(spu, light, shadow))
    trace(shadow);
  module_areas::dim(spu, shadow, sent);
  return shadow.ray_count;
}

} // namespace celltrace::kernel
