// The places of a light with an area in pairs with the surfaces that ask for them. Kernel dialect, where
// memory is direct.
//
// Of the small quads of the light's grid only few surfaces of a packet ask for a place, each for others. So
// all that the quads of one size ask for is gathered, and pairs of a surface and a place are tested, as many
// at a time as a vector has lanes.
#pragma once

#include "kernel/lights/area_shadow.hpp"
#include "kernel/tuning.hpp"

namespace celltrace::kernel {

/// Where the places of a light are on its grid, in rows. Each is found when it is first asked for.
class LightGrid {
public:
  struct Place {
    float column, row, jitter_x, jitter_y;
  };

  static bool has_room_for(const LightRecord& light) { return light.columns * light.rows <= kMostPlaces; }
  static constexpr uint32_t kMostPlaces = 17 * 17;

  /// The places are those of this light from now on.
  void set(const LightRecord& light) {
    if (light.columns == columns_) return; // a place's numbers do not depend on how many rows there are
    columns_ = light.columns;
    for (Place& place : places_)
      place.column = kUnknown;
  }
  /// Stays where it is.
  const Place& at(uint32_t number) {
    Place& place = places_[number];
    if (place.column == kUnknown) {
      const LightPlace on_grid = {number % columns_, number / columns_};
      const module_areas::PlaceJitter jitter(on_grid);
      place = {static_cast<float>(on_grid.column), static_cast<float>(on_grid.row), jitter.x, jitter.y};
    }
    return place;
  }

private:
  static constexpr float kUnknown = -1.0f;

  uint32_t columns_ = 0;
  Place places_[kMostPlaces];
};

template <class Spu> class AreaPairs {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;

  /// Whether it samples a light: not if that is parallel, or has more places than there is room for.
  static bool can_sample(const LightRecord& light) {
    return LightGrid::has_room_for(light) && !is_parallel(light);
  }

  AreaPairs(const LightRecord& light, LightGrid& grid, AreaShadow<S>& area)
      : light_(light), area_(area), grid_(grid), columns_(light.columns) {
    grid_.set(light);
    const uint32_t places = light.columns * light.rows;
    for (uint32_t i = 0; i < places; ++i)
      places_[i] = {0, 0};
  }

  /// Finds the share of a light of which the sampling has begun. `unoccluded(rays, lanes, distance)` returns
  /// the lanes to which all light comes; to the others none does.
  template <class Unoccluded> void sample(const Unoccluded& unoccluded) {
    sample(unoccluded, [] { return false; });
  }
  /// The same as long as no light comes tinted, of which `is_tinted()` says whether it did in a test. False:
  /// it did, and the share is not found.
  template <class Unoccluded, class Tinted>
  bool sample(const Unoccluded& unoccluded, const Tinted& is_tinted) {
    F share[kCorners] = {F(0.0f), F(0.0f), F(0.0f), F(0.0f)}; // of each corner; the sums are exact
    uint32_t count = 1;
    quads_[0][0] = area_.quad;
    for (uint32_t level = 0; count != 0; ++level) {
      const LightQuad* const quads = quads_[level % 2];
      for (uint32_t i = 0; i < count; ++i)
        ask_corners(quads[i], unoccluded);
      if (pairs_ != 0) test_pairs(unoccluded);
      if (is_tinted()) return false;
      LightQuad* const quarters = quads_[(level + 1) % 2];
      uint32_t quarter_count = 0;
      for (uint32_t i = 0; i < count; ++i)
        finish(quads[i], share, [&](const LightQuad& quarter) { quarters[quarter_count++] = quarter; });
      count = quarter_count;
    }
    ((share[0] + share[1]) + (share[2] + share[3])).store(area_.share.lane);
    return true;
  }

private:
  static constexpr uint32_t kCorners = AreaShadow<S>::kCorners;
  static constexpr uint32_t kMostPlaces = LightGrid::kMostPlaces;

  /// Lanes.
  struct Place {
    uint16_t asked, lit;
  };
  /// Pairs of some lanes with one place.
  struct Run {
    Place* place;
    uint32_t lanes, first;
  };

  /// Those at the corners of a quad, in the order of their numbers.
  struct Corners {
    Place* place[kCorners];
  };
  Corners corners_of(const LightQuad& q) {
    Place *const top = places_ + q.top * columns_, *const bottom = places_ + q.bottom * columns_;
    return {{top + q.left, top + q.right, bottom + q.left, bottom + q.right}};
  }

  template <class Unoccluded> void ask_corners(const LightQuad& q, const Unoccluded& unoccluded) {
    const Corners corners = corners_of(q);
    for (uint32_t i = 0; i < kCorners; ++i) {
      const uint32_t lanes = q.lanes & ~uint32_t(corners.place[i]->asked);
      if (lanes != 0) ask(*corners.place[i], lanes, unoccluded);
    }
  }
  template <class Unoccluded> void ask(Place& place, uint32_t lanes, const Unoccluded& unoccluded) {
    place.asked |= static_cast<uint16_t>(lanes);
    const auto count = static_cast<uint32_t>(__builtin_popcount(lanes));
    area_.rays_asked += count;
    const LightGrid::Place& on_grid = grid_.at(static_cast<uint32_t>(&place - places_));
    if (count >= tuning::kLeastSurfacesByThemselves) {
      place.lit |= static_cast<uint16_t>(test_place(on_grid, lanes, unoccluded));
      return;
    }
    S::lane_numbers(lanes).store_unaligned(lane_ + pairs_);
    F(on_grid.column).store_unaligned(column_ + pairs_);
    F(on_grid.row).store_unaligned(row_ + pairs_);
    F(on_grid.jitter_x).store_unaligned(jitter_x_ + pairs_);
    F(on_grid.jitter_y).store_unaligned(jitter_y_ + pairs_);
    runs_[run_count_++] = {&place, lanes, pairs_};
    pairs_ += count;
    if (pairs_ >= S::kLanes) test_pairs(unoccluded);
  }

  /// LightGrid::Place, by lane.
  struct Places {
    F column, row, jitter_x, jitter_y;
  };
  /// The light that comes from places; of it the ray. `of_surface(by lane)` is that of the lanes of the
  /// surfaces.
  template <class OfSurface>
  [[gnu::always_inline]] IncidentLight<S> aim(const V3<S>& to_middle, Places at,
                                              const OfSurface& of_surface) const {
    if (is_jittered()) {
      using module_areas::jitter;
      at.column = at.column + jitter<S>(of_surface(F::load(detail::kJitterX)) + at.jitter_x);
      at.row = at.row + jitter<S>(of_surface(F::load(detail::kJitterY)) + at.jitter_y);
    }
    IncidentLight<S> from_place;
    from_place.set_ray(to_middle + module_areas::offset_at<S>(light_, to_middle, at.column, at.row));
    return from_place;
  }

  /// Returns those of many lanes to which light comes from one place.
  template <class Unoccluded>
  [[gnu::noinline]] uint32_t test_place(const LightGrid::Place& place, uint32_t lanes,
                                        const Unoccluded& unoccluded) {
    ShadowRays& rays = *area_.to_place;
    const V3<S> to_middle = area_.to_middle.template load<S>();
    const IncidentLight<S> from_place =
        aim(to_middle, {F(place.column), F(place.row), F(place.jitter_x), F(place.jitter_y)},
            [](const F& of_lane) { return of_lane; });
    rays.rays.direction.template store<S>(from_place.direction);
    from_place.distance.store(rays.distance.lane);
    return unoccluded(rays.rays, lanes, rays.distance);
  }

  /// Tests as many pairs as there are lanes, or all.
  template <class Unoccluded> [[gnu::noinline]] void test_pairs(const Unoccluded& unoccluded) {
    const uint32_t tested = pairs_ < S::kLanes ? pairs_ : S::kLanes;
    const I lane = I::load(lane_);
    const RayPacket& points = area_.to_place->rays;
    const V3<S> origin = points.origin.template load<S>(), middle = area_.to_middle.template load<S>();
    const V3<S> to_middle = {S::pick(middle.x, lane), S::pick(middle.y, lane), S::pick(middle.z, lane)};
    const IncidentLight<S> from_place =
        aim(to_middle, {F::load(column_), F::load(row_), F::load(jitter_x_), F::load(jitter_y_)},
            [&](const F& of_lane) { return S::pick(of_lane, lane); });
    rays_.rays.origin.template store<S>(
        {S::pick(origin.x, lane), S::pick(origin.y, lane), S::pick(origin.z, lane)});
    rays_.rays.direction.template store<S>(from_place.direction);
    store_words<S>(rays_.rays.start_object, S::pick(load_words<S>(points.start_object), lane));
    from_place.distance.store(rays_.distance.lane);
    const uint32_t lit = unoccluded(rays_.rays, (1u << tested) - 1, rays_.distance);
    for (uint32_t i = 0; i < run_count_; ++i)
      runs_[i].place->lit |= static_cast<uint16_t>(S::spread(lit >> runs_[i].first, runs_[i].lanes));
    const Run last = runs_[run_count_ - 1];
    run_count_ = 0;
    pairs_ -= tested;
    if (pairs_ == 0) return;
    const uint32_t done = S::spread((1u << (S::kLanes - last.first)) - 1, last.lanes);
    runs_[run_count_++] = {last.place, last.lanes & ~done, 0};
    for (float* const numbers : {column_, row_, jitter_x_, jitter_y_})
      F::load(numbers + S::kLanes).store(numbers);
    I::load(lane_ + S::kLanes).store(lane_);
  }

  /// Adds the mean of a quad's corners where they agree, and divides it where not.
  template <class Push> void finish(const LightQuad& q, F (&share)[kCorners], const Push& push) {
    const Corners corners = corners_of(q);
    uint32_t lit[kCorners], any = 0, all = ~0u;
    for (uint32_t i = 0; i < kCorners; ++i) {
      lit[i] = corners.place[i]->lit;
      any |= lit[i];
      all &= lit[i];
    }
    uint32_t divided = 0;
    if (q.has_places_between())
      divided = q.level < light_.adaptive ? q.lanes : q.lanes & any & ~all & area_.is_visible;
    const uint32_t agreed = q.lanes & ~divided;
    if ((agreed & any) != 0)
      for (uint32_t i = 0; i < kCorners; ++i)
        share[i] = S::select(S::M::from_bits(lit[i] & agreed), share[i] + F(0.25f * q.weight), share[i]);
    if (divided != 0) q.divide(divided, push);
  }

  bool is_jittered() const { return (light_.kind_and_flags & light_flag::jitter) != 0; }

  const LightRecord& light_;
  AreaShadow<S>& area_;
  LightGrid& grid_;
  const uint32_t columns_;
  Place places_[kMostPlaces];
  LightQuad quads_[2][kMostPlaces]; ///< of a size each by turns: never more than 256
  // Pairs that are to be tested: of which places, and by pair its lane and where the place is.
  Run runs_[2 * S::kLanes];
  uint32_t run_count_ = 0, pairs_ = 0;
  alignas(64) int32_t lane_[2 * S::kLanes] = {};
  alignas(64) float column_[2 * S::kLanes] = {}, row_[2 * S::kLanes] = {};
  alignas(64) float jitter_x_[2 * S::kLanes] = {}, jitter_y_[2 * S::kLanes] = {};
  ShadowRays rays_;
};

/// Says where it is tried to sample an area in pairs, which is in vain if light comes tinted: not for some
/// packets after one to which it did.
class AreaTints {
public:
  bool are_unlikely() { return left_ == 0 || --left_ == 0; }
  void count(bool tinted) {
    if (tinted) left_ = kPackets;
  }

private:
  static constexpr uint32_t kPackets = 16;

  uint32_t left_ = 0;
};

} // namespace celltrace::kernel
