// Steps of a bundle's traversal in local store: each packet is tested against an object that has been
// fetched. Kernel dialect.
#pragma once

#include "kernel/accel/bvh_traversal.hpp"

namespace celltrace::kernel {

template <class Search, class Spu> class LocalBundleSteps {
public:
  using S = typename Spu::simd;

protected:
  struct LeafTests {
    template <class Objects> LeafTests(const Objects&, const void*) {}
  };

  explicit LocalBundleSteps(const FrameBlock&) {}

  static constexpr bool intersect_mixed(const RayQuery&) { return false; }

  static void end_view() {}
  static constexpr const void* view() { return nullptr; }
  /// Returns false, as fetching an object costs more than testing the rays.
  static constexpr bool trusts_frusta() { return false; }
  static constexpr uint32_t untrusted_at(const NodeRef&) { return 0; }
  [[gnu::always_inline]] void set_own_frustum(uint32_t packet, const RayQuery&, Frustum<S>& frustum) {
    search().frusta_.get(packet, frustum);
  }
  static constexpr float shortening(uint32_t) { return 1.0f; }

  static constexpr bool add_leaf(const LeafTests&, const RayQuery*, const NodeRef&, uint32_t) {
    return false;
  }
  [[gnu::always_inline]] void test_object(uint32_t self, uint32_t packets, RayQuery* queries) {
    auto& objects = search().objects_;
    for_each_lane(packets, [&](uint32_t packet) {
      RayQuery& query = queries[packet];
      if (query.hits != nullptr) {
        objects.test_closest(*query.rays, self, *query.hits);
      } else if (query.lanes != 0) {
        objects.hit_filter().begin_packet();
        query.lanes &= ~objects.occluded(*query.rays, self, query.lanes, *query.distance, *query.light);
      }
    });
  }
  static void test_deferred(const LeafTests&, const RayQuery*, uint32_t) {}

private:
  Search& search() { return static_cast<Search&>(*this); }
};

} // namespace celltrace::kernel
