// Sequences of a ray's crossings with an object. Kernel dialect.
#pragma once

#include "kernel/primitives/crossings.hpp"

#include <type_traits>

namespace celltrace::kernel {

/// Hands out the crossings of a packet's rays with one object in the order of their distance, one pair of
/// each ray at a time. Shapes whose crossings are roots of a polynomial find all at once. If
/// `kIsIncremental`, the shape finds the first pairs, and is asked for further pairs until there are none.
template <class S, bool kIsIncremental> class CrossingSequence {
public:
  using F = typename S::F;

  /// Returns the place for the shape's pairs.
  Crossings<S>* pairs() { return pairs_; }
  /// Begins with the `count` pairs that the shape has stored; if `is_incremental`, the shape may find more.
  void begin(uint32_t count, bool is_incremental) {
    count_ = count;
    next_ = 0;
    may_continue_ = kIsIncremental && is_incremental;
    if constexpr (kIsIncremental) further_.found = 0;
  }

  /// Advances to the next pair of any ray. Returns false if there is none. `find_after(after, crossings)`
  /// finds each ray's next pair beyond `after`, which is kEveryCrossing for rays that need none.
  template <class FindAfter> bool next(const FindAfter& find_after) {
    while (next_ < count_) {
      const Crossings<S>& c = pairs_[next_++];
      if ((c.near_hit | c.far_hit).bits() == 0) continue;
      if constexpr (kIsIncremental) remember(c);
      return true;
    }
    if constexpr (kIsIncremental) return may_continue_ && find_next(find_after);
    return false;
  }
  /// Returns the current pair, which the caller may change.
  Crossings<S>& current() { return pairs_[next_ - 1]; }
  /// Ends the search for crossings of some rays.
  void end(uint32_t lanes) {
    if constexpr (kIsIncremental) further_.lanes &= ~lanes;
  }

private:
  /// Most pairs of a ray; rays with more are assumed to leave the object.
  static constexpr uint32_t kMostPairs = 256;

  struct Further {
    uint32_t lanes = 0; ///< rays that may have more pairs
    uint32_t found = 0; ///< number of pairs after the first ones
    FloatLanes after;   ///< the farthest crossing of each ray that was handed out
  };
  struct Nothing {};

  void remember(const Crossings<S>& c) {
    further_.lanes = (c.near_hit | c.far_hit).bits();
    S::select(c.far_hit, c.far, c.near).store(further_.after.lane);
  }
  template <class FindAfter> bool find_next(const FindAfter& find_after) {
    if (further_.lanes == 0 || ++further_.found == kMostPairs) return false;
    Crossings<S>& c = pairs_[0];
    const auto active = S::M::from_bits(further_.lanes);
    S::select(active, F::load(further_.after.lane), F(kEveryCrossing)).store(further_.after.lane);
    find_after(further_.after, c);
    const F after = F::load(further_.after.lane);
    c.near_hit =
        c.near_hit & active & (c.near > after); // the search ends though shapes may find this crossing again
    c.far_hit = c.far_hit & active & (c.far > after);
    next_ = 1;
    if ((c.near_hit | c.far_hit).bits() == 0) return false;
    remember(c);
    return true;
  }

  Crossings<S> pairs_[kMaxCrossingPairs];
  uint32_t count_ = 0, next_ = 0;
  bool may_continue_ = false;
  std::conditional_t<kIsIncremental, Further, Nothing> further_;
};

} // namespace celltrace::kernel
