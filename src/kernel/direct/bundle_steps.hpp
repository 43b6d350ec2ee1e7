// Steps of a bundle's traversal in direct memory, with a view of the scene from the point that all rays of
// the bundle pass through. Packets whose rays are in several octants are traversed as a whole. Kernel
// dialect.
#pragma once

#include "kernel/accel/bvh_traversal.hpp"
#include "kernel/direct/bundle_leaf_tests.hpp"
#include "kernel/direct/light_bundle.hpp"
#include "kernel/direct/mixed_rays.hpp"
#include "kernel/direct/origin_bundle.hpp"
#include "kernel/direct/pinhole_bundle.hpp"

namespace celltrace::kernel {

/// Extends BvhTraversal, which is `Search`.
template <class Search, class Spu> class DirectBundleSteps {
public:
  using S = typename Spu::simd;
  using F = typename S::F;

  /// Finds the closest hits of primary rays of `bundle`, just entered; query i belongs to packet i.
  void intersect_from_pinhole(RayQuery* queries, const PinholeBundle<S>& bundle) {
    for (uint32_t packet = 0; packet < kBundlePackets<Spu>; ++packet)
      search().tfar_[packet] = queries[packet].lanes != 0 ? Packets::kTfarSlack * kMaxHitDistance : -1.0f;
    bundle.shortening.store(shortening_);
    traverse_view(queries, bundle);
  }
  /// Finds the closest hits of `queries`, each with at least one lane; `bundle` has some of their packets.
  void intersect_from_origin(RayQuery* queries, uint32_t count, const OriginBundle<S>& bundle) {
    if (bundle.packets != 0) {
      bundle.shortening.store(shortening_);
      for_each_lane(bundle.packets, [&](uint32_t packet) {
        search().tfar_[packet] =
            Packets::tfar_of(queries[packet], queries[packet].lanes) * shortening_[packet];
      });
      traverse_view(queries, bundle);
    }
    search().intersect(queries, count, bundle.packets);
  }
  /// Answers queries of shadow rays toward the point `light`. Each query has at least one lane.
  void intersect_toward(RayQuery* queries, uint32_t count, const float (&light)[3]) {
    const LightBundle<S> bundle(light, queries, count);
    if (bundle.packets != 0) {
      (bundle.reach * F(Packets::kTfarSlack)).store(search().tfar_);
      search().begin(bundle.packets);
      traverse_view(queries, bundle);
    }
    search().intersect(queries, count, bundle.packets);
  }

  /// Answers a query of shadow rays that can hit objects of these leaves only.
  void intersect_leaves(RayQuery& query, const NodeLeaves* nodes, uint32_t count) {
    search().objects_.hit_filter().begin_packet();
    const MixedRays<S> rays(*query.rays);
    const F tfar = Packets::tfar(query);
    for (uint32_t n = 0; n < count && query.lanes != 0; ++n) {
      const NodeRecord& node = *search().objects_.scene().node(nodes[n].node);
      for (uint32_t left = nodes[n].leaves; left != 0; left &= left - 1) {
        const auto i = static_cast<uint32_t>(__builtin_ctz(left));
        const uint32_t hit = rays.hit_child(node.bounds, i, Packets::tnear(query), tfar) & query.lanes;
        if (hit != 0) search().packet_traversal_.test_objects({node.child[i], node.leaf[i]}, hit, query);
      }
    }
  }

  /// Traverses the BVH with nothing but the frustum of a bundle, until the frustum hits a leaf or a few nodes
  /// have been expanded. The rays need not exist yet. Returns false if the frustum hits no leaf, so that no
  /// ray hits anything. Otherwise intersect_from_pinhole() or intersect_from_origin() continues from there.
  /// The bundle must have packets.
  template <class Bundle> bool enter(const Bundle& bundle) {
    search().bundle_frustum_.set(bundle.all, bundle.octant);
    search().begin(bundle.packets);
    FrustumVisitor visitor = {search(), SlabOrder(bundle.octant), bundle.packets};
    NodeRef ref = {};
    traverse_nodes(visitor, ref, false);
    return visitor.found_leaf;
  }

protected:
  using LeafTests = BundleLeafTests<Spu>;

  explicit DirectBundleSteps(const FrameBlock& frame)
      : mixes_octants_(frame.object_count <= tuning::kMostObjectsOfMixedRays),
        mixes_always_(frame.object_count <= tuning::kMostObjectsWithoutFrusta) {}

  /// Traverses a packet with rays of several octants at once. Returns false, without a traversal, if that
  /// does not pay.
  bool intersect_mixed(RayQuery& query) {
    const RayPacket& rays = *query.rays;
    if (__builtin_popcount(query.lanes) < tuning::kLeastMixedRays || !mixes_octants_) return false;
    if (!mixes_always_) {
      const uint32_t octant = octant_of(rays, static_cast<uint32_t>(__builtin_ctz(query.lanes)));
      if ((query.lanes & ~lanes_in_octant<S>(rays, octant)) == 0) return false;
    }
    MixedStack<S> stack;
    MixedVisitor<Spu> visitor = {
        search().packet_traversal_, search().objects_, query, MixedRays<S>(rays), stack, query.lanes};
    NodeRef ref = search().root();
    traverse_nodes(visitor, ref);
    return true;
  }

  void end_view() {
    view_ = nullptr;
    reversed_ = false;
  }
  const BundleView<S>* view() const { return view_; }
  /// Returns true if all rays pass through one point, so that their frusta are tight.
  bool trusts_frusta() const { return view_ != nullptr; }
  uint32_t untrusted_at(const NodeRef& child) const { return child.is_leaf() ? incoherent_origins_ : 0; }
  void set_own_frustum(uint32_t packet, const RayQuery& query, Frustum<S>& frustum) {
    if (reversed_)
      frustum.set(bounds_of<S>(*query.rays, query.lanes), search().octant_);
    else
      search().frusta_.get(packet, frustum);
  }
  float shortening(uint32_t packet) const { return view_ != nullptr ? shortening_[packet] : 1.0f; }

  bool add_leaf(LeafTests& leaves, RayQuery* queries, const NodeRef& leaf, uint32_t& packets) {
    if (view_ == nullptr) return false;
    packets = leaves.add(queries, packets, leaf);
    return true;
  }
  void test_object(uint32_t self, uint32_t packets, RayQuery* queries) {
    if (queries[__builtin_ctz(packets)].hits != nullptr)
      search().objects_.test_closest_of_all(queries, packets, self);
    else
      search().objects_.test_occlusion_of_all(queries, packets, self);
  }
  /// Tests deferred triangles, unless the next entry is a leaf whose triangles can join them. If it is a
  /// node, hits should shorten tfar before the node is expanded.
  [[gnu::always_inline]] void test_deferred(LeafTests& leaves, RayQuery* queries, uint32_t bundled) {
    if (!leaves.has_deferred()) return;
    const auto& stack = search().packet_traversal_.stack();
    if (stack.size() != 0 && stack.top().ref.is_leaf() && leaves.has_room_for(stack.top().ref)) return;
    search().update_tfar(leaves.test(queries), queries);
    search().max_tfar_ = Search::Lanes::greatest_of(bundled, search().tfar_);
  }

private:
  using Packets = PacketTraversal<Spu>;

  Search& search() { return static_cast<Search&>(*this); }

  /// Traverses a bundle whose rays all pass through one point, with the bundle's frusta.
  void traverse_view(RayQuery* queries, const ViewBundle<S>& bundle) {
    for (uint32_t& misses : search().misses_)
      misses = 0;
    search().frusta_.set(bundle.bounds, bundle.octant);
    search().bundle_frustum_.set(bundle.all, bundle.octant);
    view_ = &bundle.view;
    incoherent_origins_ = bundle.incoherent;
    search().set_max_split_packets(bundle.density != 0.0f ? bundle.density : search().rays_of_frame_);
    search().octant_ = bundle.turned ? bundle.octant ^ 7 : bundle.octant;
    reversed_ = bundle.turned;
    search().traverse_bundle(queries, SlabOrder(bundle.octant), SlabOrder(search().octant_), bundle.packets);
  }

  /// The traversal of a bundle's frustum, for traverse_nodes(). The traversal ends at a leaf or when some
  /// nodes have been expanded, and leaves the next entries on the stack.
  struct FrustumVisitor {
    Search& traversal;
    const SlabOrder order;
    const uint32_t packets;
    uint32_t nodes = 0;      ///< number of expanded nodes
    bool found_leaf = false; ///< also true if there are too many nodes

    bool expand(NodeRef& ref) {
      ++nodes;
      ++traversal.objects_.counters().visits;
      SceneAccess<Spu>& scene = traversal.objects_.scene();
      auto& stack = traversal.packet_traversal_.stack();
      const NodeRecord& node = *scene.node(ref.child);
      alignas(16) float distance[4];
      const uint32_t first = stack.size();
      for_each_lane(traversal.bundle_frustum_.intersect(node.bounds, order, kMaxHitDistance, distance),
                    [&](uint32_t i) {
                      const NodeRef child = {node.child[i], node.leaf[i]};
                      scene.hint(child);
                      stack.push(first, {child, packets, distance[i], 0});
                    });
      return false;
    }
    void test(const NodeRef&) {}
    bool next(NodeRef& ref) {
      auto& stack = traversal.packet_traversal_.stack();
      if (stack.size() == 0) return false;
      ref = stack.top().ref;
      found_leaf = ref.is_leaf() || nodes == tuning::kMaxEnteredNodes;
      if (found_leaf) return false;
      stack.pop();
      return true;
    }
    static constexpr bool pauses() { return false; }
  };

  const bool mixes_octants_, mixes_always_;
  const BundleView<S>* view_ = nullptr; ///< null if the rays do not pass through one point
  uint32_t incoherent_origins_ = 0;     ///< ViewBundle::incoherent; undefined without a view
  bool reversed_ = false;               ///< the frusta are those of reversed rays
  /// By packet; see shortening(). Undefined for rays that do not pass through one point.
  alignas(64) float shortening_[kBundlePackets<Spu>] = {};
};

} // namespace celltrace::kernel
