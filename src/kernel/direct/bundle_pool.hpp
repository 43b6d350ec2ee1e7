// Rays of a bundle that leave their packets, and the light that these rays bring to the bundle's pixels.
// Kernel dialect, for direct memory.
//
// Primary rays are sorted by the materials that they hit if that pays; secondary rays, shadow rays from their
// hits, and secondary rays without a hit are gathered into full packets.
#pragma once

#include "kernel/direct/bundle_queues.hpp"
#include "kernel/direct/hit_sorting.hpp"
#include "kernel/program/pixel_sampler.hpp"
#include "kernel/shading/lighting.hpp"
#include "records/light_feature.hpp"

namespace celltrace::kernel {

template <class Spu> class BundlePool {
public:
  using S = typename Spu::simd;
  using F = typename S::F;

  /// Allocates memory. `samples` receive the transparency of each sample, unless `samples` is null.
  BundlePool(Spu& spu, SampleBundle<Spu>* samples)
      : rays(room_for<PooledRays>(spu)), hits(room_for<EndingHits>(spu)),
        shadows(room_for<ShadowPoints>(spu)), skies(room_for<SkyRays>(spu)), samples_(samples), sorter_(spu),
        light_(spu.template allocate<VectorLanes>(kPackets)) {}

  WavefrontQueue<PooledRays> rays;
  WavefrontQueue<EndingHits> hits;
  WavefrontQueue<ShadowPoints> shadows;
  WavefrontQueue<SkyRays> skies;
  FloatLanes transparency; ///< transparency along the rays that are being traced

  /// Returns true if rays stay in the lanes of their pixels.
  static constexpr bool has_own_lanes(const FrameBlock& frame) {
    return (frame.light_features & light_feature::jitter) != 0;
  }
  /// Sorts the members of a bundle, with their rays' hits. The members stay as they are if first hits are
  /// wanted by pixel.
  template <class Member> void sort(SceneAccess<Spu>& scene, const FrameBlock& frame, Member* members) {
    for (uint32_t i = 0; i < kPackets; ++i)
      with_ray_[i] = members[i].lanes;
    sorted_ = 0;
    if (frame.object_count <= tuning::kObjectsInCoreCache &&
        (frame.light_features & light_feature::first_hits) == 0 && !has_own_lanes(frame))
      sorted_ = sorter_.sort(scene, members);
  }
  /// Returns the lanes of a member's pixels that have a ray.
  uint32_t with_ray(uint32_t member) const { return with_ray_[member]; }

  /// Begins the trees of a bundle, without light so far.
  void begin() {
    for_each_lane(sorted_, [&](uint32_t member) { set_dark(member); });
  }
  /// Begins the tree of a member; `pixels` receives the pixels of its rays.
  void begin_tree(uint32_t member, WordLanes& pixels) {
    if (is_sorted(member)) {
      pixels = sorter_.places(member);
      return;
    }
    set_dark(member);
    for (uint32_t lane = 0; lane < kSimdLanes; ++lane)
      pixels.lane[lane] = member * kSimdLanes + lane;
  }
  void reset_transparency() { F(0.0f).store(transparency.lane); }

  /// Stores the colours of a member's primary rays, which need no tree.
  void put(uint32_t member, uint32_t lanes, const VectorLanes& seen) {
    if (is_sorted(member)) return add_tree(sorter_.places(member), lanes, seen);
    light_[member] = seen;
    if (samples_ != nullptr) samples_->at[member].transparency = transparency;
  }
  /// Stores the light of a member's tree. Some of its light may have been stored already.
  void put_tree(uint32_t member, uint32_t lanes, const VectorLanes& seen) {
    if (is_sorted(member)) return add_tree(sorter_.places(member), lanes, seen);
    VectorLanes all;
    all.template store<S>(light_[member].template load<S>() + seen.template load<S>());
    put(member, lanes, all);
  }
  /// Adds the light of a tree of rays that have left their packets.
  void add_tree(const WordLanes& pixels, uint32_t lanes, const VectorLanes& seen) {
    add(pixels, lanes, seen);
    if (samples_ == nullptr) return;
    for_each_lane(lanes, [&](uint32_t lane) {
      samples_->at[pixels.lane[lane] / kSimdLanes].transparency.lane[pixels.lane[lane] % kSimdLanes] +=
          transparency.lane[lane];
    });
  }
  void add(const WordLanes& pixels, uint32_t lanes, const VectorLanes& light) {
    for_each_lane(lanes, [&](uint32_t lane) {
      VectorLanes& sum = light_[pixels.lane[lane] / kSimdLanes];
      const uint32_t to = pixels.lane[lane] % kSimdLanes;
      sum.x.lane[to] += light.x.lane[lane];
      sum.y.lane[to] += light.y.lane[lane];
      sum.z.lane[to] += light.z.lane[lane];
    });
  }
  /// Adds the unoccluded light that a round has gathered for a member's primary rays.
  void add(uint32_t member, uint32_t lanes, const LightRound& round) {
    if (!is_sorted(member)) return; // light_of() adds it
    VectorLanes more;
    more.template store<S>(round.template sum<S>());
    add(sorter_.places(member), lanes, more);
  }
  /// Returns the light of a member's pixels, with a round's light as in add().
  V3<S> light_of(uint32_t member, uint32_t lanes, const LightRound& round) const {
    const V3<S> seen = light_[member].template load<S>();
    if (is_sorted(member) || lanes == 0) return seen;
    return select<S>(S::M::from_bits(lanes), seen + round.template sum<S>(), seen);
  }

  void drop() {
    rays.clear();
    hits.clear();
    shadows.clear();
    skies.clear();
  }

private:
  static constexpr uint32_t kPackets = kBundlePackets<Spu>;

  template <class Kind> static Kind* room_for(Spu& spu) {
    return spu.template allocate<Kind>(Kind::kPackets);
  }
  /// Returns true if the rays of a member belong to other pixels.
  bool is_sorted(uint32_t member) const { return (sorted_ >> member & 1) != 0; }
  void set_dark(uint32_t member) { light_[member].template store<S>({F(0.0f), F(0.0f), F(0.0f)}); }

  SampleBundle<Spu>* samples_;
  HitSorter<Spu> sorter_;
  VectorLanes* light_; ///< index: member; light of its pixels
  uint32_t with_ray_[kPackets];
  uint32_t sorted_ = 0; ///< members whose rays have been sorted
};

} // namespace celltrace::kernel
