// How an SPU goes about what depends on its memory: one strategy where memory is direct, one in local store.
// Kernel dialect.
//
// Each algorithm of the kernel is written once. What differs are types and functions of a strategy, which has
// the same ones in either: direct/strategy.hpp and local/strategy.hpp, both of a file for each room. What the
// two include names `Strategy<Spu>` and includes neither; programs include both (entry/strategies.hpp).
#pragma once

#include "kernel/tuning.hpp"

#include <type_traits>

namespace celltrace::kernel {

struct DirectStrategy; ///< an effective address is a pointer, and code takes no local store
struct LocalStrategy;  ///< data comes by DMA, and local store is short of code

/// The strategy that an SPU follows. Specialised for what is no SPU.
template <class Spu> struct StrategyOf {
  using Type = std::conditional_t<Spu::direct_memory, DirectStrategy, LocalStrategy>;
};
template <class Spu> using Strategy = typename StrategyOf<Spu>::Type;

/// Packets a side of a bundle, if memory is `direct` or not.
constexpr uint32_t bundle_edge(bool direct) {
  return direct ? tuning::kBundleEdge : tuning::kBundleEdgeInLocalStore;
}
template <class Spu> constexpr uint32_t kBundleEdge = bundle_edge(Spu::direct_memory);
template <class Spu> constexpr uint32_t kBundlePackets = kBundleEdge<Spu>* kBundleEdge<Spu>;

/// The most that directions of a packet's rays differ by which are traced at once.
template <class Spu>
constexpr float kMaxPacketSpread =
    Spu::direct_memory ? tuning::kMaxPacketSpread : tuning::kMaxPacketSpreadInLocalStore;

/// A T, or nothing: for members that only some have.
template <class T, bool kPresent> struct Present : T { using T::T; };
template <class T> struct Present<T, false> {
  template <class... Arguments> explicit Present(const Arguments&...) {}
};

} // namespace celltrace::kernel
