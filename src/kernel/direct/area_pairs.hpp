// Sampling of area lights in pairs of a place and a surface that needs it. Kernel dialect, for direct memory.
//
// For the small quads of a light's grid, only few surfaces of a packet need a given place. Therefore all
// places that quads of one size need are gathered, and pairs of a surface and a place fill packets. These
// packets are tested together: an object is read once for many packets, and no packet waits for the result of
// another. The body of a WavefrontQueue would test one packet at a time (soft.pov takes 0.82 of its time by
// sixteen).
#pragma once

#include "kernel/lights/area_shadow.hpp"
#include "kernel/tuning.hpp"
#include "records/light.hpp"

namespace celltrace::kernel {

/// Positions of a light's places on its grid, in rows. The first kKept of them are computed once, on first
/// use.
class LightGrid {
public:
  struct Place {
    float column, row, jitter_x, jitter_y;
  };

  static bool has_room_for(const LightRecord& light) { return light.columns * light.rows <= kMostPlaces; }
  /// Most places of a light. Larger: AreaPairs takes more of the stack; smaller: more lights are sampled one
  /// place at a time.
  static constexpr uint32_t kMostPlaces = 41 * 41;

  /// Sets the light whose places are used from now on.
  void set(const LightRecord& light) {
    if (light.columns == columns_) return; // a place's numbers do not depend on the number of rows
    columns_ = light.columns;
    for (Place& place : places_)
      place.column = kUnknown;
  }
  Place at(uint32_t number) {
    if (number >= kKept) return made(number);
    Place& place = places_[number];
    if (place.column == kUnknown) place = made(number);
    return place;
  }

private:
  /// Number of places that are kept. Larger: less local store is left for others; smaller: places of more
  /// lights are computed again for each packet.
  static constexpr uint32_t kKept = 17 * 17;
  static constexpr float kUnknown = -1.0f;

  Place made(uint32_t number) const {
    const LightPlace on_grid = {number % columns_, number / columns_};
    const module_areas::PlaceJitter jitter(on_grid);
    return {static_cast<float>(on_grid.column), static_cast<float>(on_grid.row), jitter.x, jitter.y};
  }

  uint32_t columns_ = 0;
  Place places_[kKept];
};

/// Tints of the light that comes through translucent objects, by place and lane.
template <class S> class AreaTints {
public:
  /// Forgets all tints.
  void begin(uint32_t places) {
    for (uint32_t i = 0; i < places; ++i)
      lanes_[i] = 0;
    count_ = 0;
  }
  /// Sets the tint of a lane without one. Returns false if there is no room for the tint.
  bool set(uint32_t place, uint32_t lane, const VectorLanes& from, uint32_t from_lane) {
    if (lanes_[place] == 0) {
      if (count_ == kMost) return false;
      numbers_[place] = static_cast<uint16_t>(count_++);
    }
    lanes_[place] |= static_cast<uint16_t>(1u << lane);
    VectorLanes& to = tints_[numbers_[place]];
    to.x.lane[lane] = from.x.lane[from_lane];
    to.y.lane[lane] = from.y.lane[from_lane];
    to.z.lane[lane] = from.z.lane[from_lane];
    return true;
  }
  uint32_t lanes(uint32_t place) const { return lanes_[place]; }
  /// Returns the tints of lanes; a lane without a tint has white if it is lit, and black if not.
  [[gnu::always_inline]] V3<S> of(uint32_t place, uint32_t lit) const {
    using F = typename S::F;
    const F white = S::select(S::M::from_bits(lit), F(1.0f), F(0.0f));
    if (lanes_[place] == 0) return {white, white, white};
    return select<S>(S::M::from_bits(lanes_[place]), tints_[numbers_[place]].template load<S>(),
                     {white, white, white});
  }

private:
  /// Capacity in places, 192 bytes each. If more places are tinted, the light is sampled place by place.
  static constexpr uint32_t kMost = 512;

  uint32_t count_ = 0;
  uint16_t lanes_[LightGrid::kMostPlaces], numbers_[LightGrid::kMostPlaces];
  VectorLanes tints_[kMost];
};

/// Samples an area light. If `kTinted`, translucent objects may tint the light.
template <class Spu, bool kTinted> class AreaPairs {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;

  /// Returns true if a light can be sampled: it is not parallel, and does not have too many places.
  static bool can_sample(const LightRecord& light) {
    return LightGrid::has_room_for(light) && !is_parallel(light);
  }

  AreaPairs(const LightRecord& light, LightGrid& grid, AreaShadow<S>& area)
      : light_(light), area_(area), grid_(grid), columns_(light.columns) {
    grid_.set(light);
    const uint32_t places = light.columns * light.rows;
    if constexpr (kTinted) tints_.begin(places);
    for (uint32_t i = 0; i < places; ++i)
      lit_[i] = 0;
    for (uint32_t first = 0; first < places; first += S::kLanes) {
      I::splat(0).store(wanted_ + first);
      I::splat(0).store(queued_ + first);
    }
  }

  /// Finds the share of a light whose sampling has begun. `test(queries, count)` leaves in each query the
  /// lanes that all light reaches. If light may be tinted, it leaves the lanes that some light reaches, and
  /// changes the queries' lights from white to their tints. `count` is at most kMostPackets. Returns false,
  /// without a share, if too many places are tinted.
  template <class Test> bool sample(const Test& test) {
    F share[kCorners] = {F(0.0f), F(0.0f), F(0.0f), F(0.0f)}; // one for each corner; the sums are exact
    uint32_t count = 1;
    quads_[0][0] = area_.quad;
    for (uint32_t level = 0; count + block_count_ != 0; ++level) {
      const LightQuad* const quads = quads_[level % 2];
      for (uint32_t i = 0; i < count; ++i)
        want_corners(quads[i]);
      for (uint32_t i = 0; i < block_count_; ++i)
        want_between(blocks_[i]);
      queue_wanted(test);
      if (packet_count() != 0) test_packets(test);
      if (is_full_) {
        area_.is_tinted = 0;
        return false;
      }
      for (uint32_t i = 0; i < block_count_; ++i)
        add_block(blocks_[i], share);
      block_count_ = 0;
      LightQuad* const quarters = quads_[(level + 1) % 2];
      uint32_t quarter_count = 0;
      for (uint32_t i = 0; i < count; ++i)
        finish(quads[i], share, [&](const LightQuad& quarter) { quarters[quarter_count++] = quarter; });
      count = quarter_count;
    }
    ((share[0] + share[1]) + (share[2] + share[3])).store(area_.share.lane);
    return true;
  }
  /// Returns the lanes of the surfaces in a packet of pairs, for tests.
  const int32_t* surface_lanes(uint32_t packet) const { return lane_ + packet * S::kLanes; }

private:
  static constexpr uint32_t kCorners = AreaShadow<S>::kCorners;
  static constexpr uint32_t kMostPlaces = LightGrid::kMostPlaces;
  static constexpr uint32_t kMostPackets = tuning::kMostAreaPackets;
  static constexpr uint32_t kMostPairs = kMostPackets * S::kLanes;
  static constexpr uint32_t kSlack = S::kLanes; ///< vectors are stored at any offset

  /// Pairs of some lanes with one place.
  struct Run {
    uint32_t place, lanes, first;
  };

  /// The numbers of the places at the corners of a quad, in the order of LightQuad::corner().
  struct Corners {
    uint32_t place[kCorners];
  };
  Corners corners_of(const LightQuad& q) const {
    const uint32_t top = q.top * columns_, bottom = q.bottom * columns_;
    return {{top + q.left, top + q.right, bottom + q.left, bottom + q.right}};
  }

  void want_corners(const LightQuad& q) {
    for (const uint32_t place : corners_of(q).place)
      wanted_[place] |= q.lanes;
  }
  /// Marks the places between the corners of a divided quad of 3 x 3 places as wanted.
  void want_between(const LightQuad& q) {
    int32_t* const first = wanted_ + q.top * columns_ + q.left;
    const uint32_t places[] = {1, columns_, columns_ + 1, columns_ + 2, 2 * columns_ + 1};
    for (const uint32_t place : places)
      first[place] |= q.lanes;
  }
  /// Queues pairs for places that are wanted and were not queued yet.
  template <class Test> void queue_wanted(const Test& test) {
    const uint32_t places = columns_ * light_.rows;
    for (uint32_t first = 0; first < places; first += S::kLanes) {
      const I wanted = I::load(wanted_ + first), lanes = wanted ^ I::load(queued_ + first);
      const uint32_t unqueued = ~(lanes == I::splat(0)).bits() & 0xFFFF;
      if (unqueued == 0) continue;
      wanted.store(queued_ + first);
      WordLanes by_place;
      store_words<S>(by_place, lanes);
      for_each_lane(unqueued, [&](uint32_t i) { queue(first + i, by_place.lane[i], test); });
    }
  }
  template <class Test> void queue(uint32_t place, uint32_t lanes, const Test& test) {
    const auto count = static_cast<uint32_t>(__builtin_popcount(lanes));
    area_.ray_count += count;
    if (pair_count_ + count > kMostPairs) test_packets(test);
    const LightGrid::Place on_grid = grid_.at(place);
    S::lane_numbers(lanes).store_unaligned(lane_ + pair_count_);
    F(on_grid.column).store_unaligned(column_ + pair_count_);
    F(on_grid.row).store_unaligned(row_ + pair_count_);
    F(on_grid.jitter_x).store_unaligned(jitter_x_ + pair_count_);
    F(on_grid.jitter_y).store_unaligned(jitter_y_ + pair_count_);
    runs_[run_count_++] = {place, lanes, pair_count_};
    pair_count_ += count;
  }
  static constexpr uint32_t packets_of(uint32_t pairs) { return (pairs + S::kLanes - 1) / S::kLanes; }
  uint32_t packet_count() const { return packets_of(pair_count_); }

  /// LightGrid::Place in each lane.
  struct Places {
    F column, row, jitter_x, jitter_y;
  };
  /// Returns the light from places, with nothing but its rays. `of_surface(lanes)` selects values by the
  /// pairs' surfaces.
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

  /// Tests all pairs that are queued.
  template <class Test> [[gnu::noinline]] void test_packets(const Test& test) {
    aim_pairs();
    test(queries_, packet_count());
    if constexpr (kTinted) take_tints();
    take_pairs();
    run_count_ = pair_count_ = 0;
  }
  void aim_pairs() {
    // The last lanes have no pair, and may have any values.
    I::splat(0).store_unaligned(lane_ + pair_count_);
    for (float* const numbers : {column_, row_, jitter_x_, jitter_y_})
      F(0.0f).store_unaligned(numbers + pair_count_);
    const RayPacket& points = area_.to_place->rays;
    const V3<S> origin = points.origin.template load<S>(), middle = area_.to_middle.template load<S>();
    const I start_object = load_words<S>(points.start_object);
    for (uint32_t first = 0, i = 0; first < pair_count_; first += S::kLanes, ++i) {
      const I lane = I::load(lane_ + first);
      const auto of_pair = [&](const V3<S>& v) -> V3<S> {
        return {S::pick(v.x, lane), S::pick(v.y, lane), S::pick(v.z, lane)};
      };
      const IncidentLight<S> from_place = aim(of_pair(middle),
                                              {F::load(column_ + first), F::load(row_ + first),
                                               F::load(jitter_x_ + first), F::load(jitter_y_ + first)},
                                              [&](const F& of_lane) { return S::pick(of_lane, lane); });
      WordLanes objects;
      store_words<S>(objects, S::pick(start_object, lane));
      make_shadow_rays(of_pair(origin), objects, from_place, rays_[i].rays, rays_[i].distance);
      const uint32_t left = pair_count_ - first;
      make_query(i, left < S::kLanes ? (1u << left) - 1 : 0xFFFF);
    }
  }
  void make_query(uint32_t i, uint32_t lanes) {
    VectorLanes* light = &area_.light();
    if constexpr (kTinted) {
      light = &transmittance_[i];
      light->template store<S>({F(1.0f), F(1.0f), F(1.0f)});
    }
    queries_[i] = {&rays_[i].rays, nullptr, &rays_[i].distance, light, lanes};
  }
  /// Stores the tints of places, and leaves in the queries only the lanes that all light reaches.
  void take_tints() {
    uint32_t tinted[kMostPackets], any = 0; // lanes
    for (uint32_t i = 0; i < packet_count(); ++i) {
      const V3<S> tint = transmittance_[i].template load<S>();
      const F zero(0.0f), one(1.0f);
      const uint32_t lit = ((tint.x == one) & (tint.y == one) & (tint.z == one)).bits();
      const uint32_t dark = ((tint.x == zero) & (tint.y == zero) & (tint.z == zero)).bits();
      tinted[i] = queries_[i].lanes & ~(lit | dark);
      queries_[i].lanes &= lit;
      any |= tinted[i];
    }
    if (any == 0) return;
    for (uint32_t i = 0; i < run_count_; ++i) {
      const Run& run = runs_[i];
      const auto end = run.first + static_cast<uint32_t>(__builtin_popcount(run.lanes));
      for (uint32_t pair = run.first; pair < end; ++pair) {
        const uint32_t packet = pair / S::kLanes, lane = pair % S::kLanes;
        if ((tinted[packet] >> lane & 1) == 0) continue;
        const auto surface = static_cast<uint32_t>(lane_[pair]);
        is_full_ = !tints_.set(run.place, surface, transmittance_[packet], lane) || is_full_;
      }
    }
  }
  /// Stores the lit lanes of the pairs' places.
  void take_pairs() {
    const uint32_t last = packets_of(pair_count_);
    for (uint32_t i = 0; i < run_count_; ++i) {
      const Run& run = runs_[i];
      const uint32_t packet = run.first / S::kLanes, next = packet + 1;
      const uint32_t lit = queries_[packet].lanes | (next < last ? queries_[next].lanes << S::kLanes : 0);
      lit_[run.place] |= static_cast<uint16_t>(S::spread(lit >> run.first % S::kLanes, run.lanes));
    }
  }

  /// Adds the mean of a quad's corners in lanes where these agree, and divides the quad in other lanes.
  template <class Push> void finish(const LightQuad& q, F (&share)[kCorners], const Push& push) {
    const Corners corners = corners_of(q);
    uint32_t lit[kCorners], any = 0, all = ~0u;
    for (uint32_t i = 0; i < kCorners; ++i) {
      lit[i] = lit_[corners.place[i]];
      any |= lit[i];
      all &= lit[i];
    }
    const uint32_t tinted = lanes_tinted_at(corners.place) & q.lanes;
    uint32_t divided = 0;
    if (q.has_places_between()) {
      divided = q.level < light_.adaptive ? q.lanes : q.lanes & any & ~all & area_.is_visible;
      if constexpr (kTinted)
        if (tinted != 0 && q.level >= light_.adaptive)
          divided = (divided & ~tinted) | (disagreement(corners, lit) & tinted);
    }
    const uint32_t agreed = q.lanes & ~divided;
    for (uint32_t i = 0; i < kCorners; ++i)
      share[i] =
          S::select(S::M::from_bits(lit[i] & agreed & ~tinted), share[i] + F(0.25f * q.weight), share[i]);
    if constexpr (kTinted)
      if ((agreed & tinted) != 0) {
        V3<S> sum = tints_.of(corners.place[0], lit[0]);
        for (uint32_t i = 1; i < kCorners; ++i)
          sum = sum + tints_.of(corners.place[i], lit[i]);
        add_tinted(sum * F(0.25f * q.weight), agreed & tinted);
      }
    if (divided == 0) return;
    if (q.right == q.left + 2 && q.bottom == q.top + 2)
      blocks_[block_count_++] = {q.left,  q.top,   q.right, q.bottom, static_cast<uint16_t>(divided),
                                 q.level, q.weight};
    else
      q.divide(divided, push);
  }
  /// Returns the lanes with a tint at some of the places.
  template <uint32_t kCount> uint32_t lanes_tinted_at(const uint32_t (&places)[kCount]) const {
    uint32_t tinted = 0;
    if constexpr (kTinted)
      for (const uint32_t place : places)
        tinted |= tints_.lanes(place);
    return tinted;
  }
  /// Returns the lanes in which neighbouring corners differ so much that the quad has to be divided.
  uint32_t disagreement(const Corners& corners, const uint32_t (&lit)[kCorners]) const {
    constexpr uint32_t kRound[] = {0, 1, 3, 2};
    const V3<S> whole = area_.whole.template load<S>();
    uint32_t differ = 0;
    V3<S> before = tints_.of(corners.place[2], lit[2]);
    for (const uint32_t corner : kRound) {
      const V3<S> next = tints_.of(corners.place[corner], lit[corner]);
      const F difference = absolute_sum<S>((before - next) * whole);
      differ |= (difference > F(AreaShadow<S>::kTolerance)).bits();
      before = next;
    }
    return differ;
  }
  /// Adds a part of the whole light to the tinted light.
  void add_tinted(const V3<S>& part, uint32_t lanes) {
    const F zero(0.0f);
    const V3<S> none = {zero, zero, zero};
    const V3<S> before = select<S>(S::M::from_bits(area_.is_tinted), area_.more.template load<S>(), none);
    const V3<S> added = part * area_.whole.template load<S>();
    area_.more.template store<S>(before + select<S>(S::M::from_bits(lanes), added, none));
    area_.is_tinted |= lanes;
  }
  /// Adds the means of the quarters of a quad of 3 x 3 places.
  void add_block(const LightQuad& q, F (&share)[kCorners]) {
    constexpr uint32_t kPlaces = 9;
    constexpr float kTimes[kPlaces] = {1.0f, 2.0f, 1.0f, 2.0f, 4.0f, 2.0f, 1.0f, 2.0f, 1.0f};
    constexpr uint32_t kShares[kPlaces] = {0, 1, 2, 3, 0,
                                           1, 2, 3, 2}; // so that no sum waits for the previous one
    const uint32_t begin = q.top * columns_ + q.left;
    const uint32_t places[kPlaces] = {begin,
                                      begin + 1,
                                      begin + 2,
                                      begin + columns_,
                                      begin + columns_ + 1,
                                      begin + columns_ + 2,
                                      begin + 2 * columns_,
                                      begin + 2 * columns_ + 1,
                                      begin + 2 * columns_ + 2};
    const float weight = 0.0625f * q.weight;
    const uint32_t tinted = lanes_tinted_at(places) & q.lanes;
    for (uint32_t i = 0; i < kPlaces; ++i) {
      const auto lit = S::M::from_bits(lit_[places[i]] & q.lanes & ~tinted);
      F& sum = share[kShares[i]];
      sum = S::select(lit, sum + F(kTimes[i] * weight), sum);
    }
    if constexpr (kTinted)
      if (tinted != 0) {
        V3<S> sum = tints_.of(places[0], lit_[places[0]]);
        for (uint32_t i = 1; i < kPlaces; ++i)
          sum = sum + tints_.of(places[i], lit_[places[i]]) * F(kTimes[i]);
        add_tinted(sum * F(weight), tinted);
      }
  }

  bool is_jittered() const { return (light_.kind_and_flags & light_flag::jitter) != 0; }

  const LightRecord& light_;
  AreaShadow<S>& area_;
  LightGrid& grid_;
  [[no_unique_address]] Present<AreaTints<S>, kTinted> tints_;
  const uint32_t columns_;
  bool is_full_ = false; ///< true if there was no room for all tints
  // By place: lanes that want it, are queued for it, and are lit. Places beyond the last one are unused.
  alignas(64) int32_t wanted_[kMostPlaces + kSlack], queued_[kMostPlaces + kSlack];
  uint16_t lit_[kMostPlaces];
  LightQuad quads_[2][kMostPlaces];   ///< in turn: quads of one size, and of the next
  LightQuad blocks_[kMostPlaces / 4]; ///< quads of 3 x 3 places that are to be divided
  uint32_t block_count_ = 0;
  // Pairs to be tested: runs with one place each, and by pair the lane and the position of the place.
  Run runs_[kMostPackets * S::kLanes];
  uint32_t run_count_ = 0, pair_count_ = 0;
  alignas(64) int32_t lane_[kMostPairs + kSlack];
  alignas(64) float column_[kMostPairs + kSlack], row_[kMostPairs + kSlack];
  alignas(64) float jitter_x_[kMostPairs + kSlack], jitter_y_[kMostPairs + kSlack];
  ShadowRays rays_[kMostPackets];
  VectorLanes transmittance_[kMostPackets]; ///< by packet, the result for white light; with tints
  RayQuery queries_[kMostPackets];
};

} // namespace celltrace::kernel
