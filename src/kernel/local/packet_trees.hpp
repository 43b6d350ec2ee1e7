// The ray trees of a bundle in local store: each packet of primary rays has its own tree, traced one after
// another. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/program/bundle_tracer.hpp"

namespace celltrace::kernel {

template <class Tracer, class Spu> class PacketTrees {
protected:
  using S = typename Spu::simd;

  /// Primary rays share memory with the later shadow rays.
  struct PrimaryRays {
    template <class Member> static RayPacket& of(Member& member) { return member.to_light.rays; }
  };

  PacketTrees(const Spu&, const SampleBundle<Spu>*) {}

  template <class Put, class Fill>
  [[gnu::always_inline]] bool search(uint32_t column, uint32_t row, const Put&, const Fill&) {
    all().place(column, row);
    all().find_hits(
        [&](RayQuery* queries) { all().shadows_.traversal().intersect(queries, kBundlePackets<Spu>); },
        [] {});
    return true;
  }

  static void begin_trees() {}
  static void hint(uint32_t) {}
  template <class Member> static constexpr bool shade_end(const Member&) { return false; }
  static constexpr bool has_hit_points(const void*) { return false; }
  template <class Member> void begin_tree(const Member& member) {
    if (all().samples_ != nullptr)
      all().tracer_.add_transparency_to(all().samples_->at[member.number].transparency);
  }
  CELLTRACE_ONE_COPY uint32_t take_hits() { return all().tracer_.take_hits(); }
  static constexpr uint32_t defer_ends(uint32_t) { return 0; }
  template <class Member> void store_tree(Member& member) {
    copy_packet<Spu>(all().tracer_.light(), member.shaded.seen);
  }
  static void end_tree() {}
  template <class Stopped> static constexpr bool finish(const Stopped&) { return true; }
  static void drop() {}

  static constexpr bool defer_light(uint32_t, uint32_t, const VectorLanes&) { return false; }
  template <class Member> void add_deferred_light(Member& member) {
    const LightRound round = LightRound::from(all().frame_, 0, member.light);
    round.template add_to<S>(member.shaded.seen, member.hit);
  }

  template <class Member> static uint32_t lanes_with_ray(const Member& member) { return member.lanes; }
  template <class Member> static V3<S> light_of(const Member& member) {
    return member.shaded.seen.template load<S>();
  }

private:
  Tracer& all() { return static_cast<Tracer&>(*this); }
};

} // namespace celltrace::kernel
