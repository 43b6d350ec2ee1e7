// The two strategies of an SPU: one for direct memory, one for local store. Kernel dialect.
//
// Each algorithm of the kernel is written once. Code that depends on the kind of memory is in types and
// functions of a strategy, which have the same names in both: direct/strategy.hpp and local/strategy.hpp,
// each made of one file per room. Files that these two include name `Strategy<Spu>` and include neither of
// the two; programs include both (entry/strategies.hpp).
#pragma once

#include "kernel/tuning.hpp"

#include <type_traits>

namespace celltrace::kernel {

struct DirectStrategy; ///< effective addresses are pointers, and code takes no local store
struct LocalStrategy;  ///< data is moved by DMA, and local store for code is scarce

/// Selects the strategy that an SPU follows. Specialised for types that are no SPU.
template <class Spu> struct StrategyOf {
  using Type = std::conditional_t<Spu::direct_memory, DirectStrategy, LocalStrategy>;
};
template <class Spu> using Strategy = typename StrategyOf<Spu>::Type;

/// Returns the packets per side of a bundle.
constexpr uint32_t bundle_edge(bool direct) {
  return direct ? tuning::kBundleEdge : tuning::kBundleEdgeInLocalStore;
}
template <class Spu> constexpr uint32_t kBundleEdge = bundle_edge(Spu::direct_memory);
template <class Spu> constexpr uint32_t kBundlePackets = kBundleEdge<Spu>* kBundleEdge<Spu>;

/// Largest difference between the directions of a packet's rays that are traced together.
template <class Spu>
constexpr float kMaxPacketSpread =
    Spu::direct_memory ? tuning::kMaxPacketSpread : tuning::kMaxPacketSpreadInLocalStore;

/// A base class T if `kPresent`, else an empty one: for members that only some strategies have.
template <class T, bool kPresent> struct Present : T { using T::T; };
template <class T> struct Present<T, false> {
  template <class... Arguments> explicit Present(const Arguments&...) {}
};

} // namespace celltrace::kernel
