// Few references into four clusters, bottom up: the two whose union adds least to the expected cost become
// one (Walter, Bala, Kulkarni and Pingali, Fast agglomerative clustering for rendering, 2008). Kernel
// dialect.
#pragma once

#include "kernel/direct/build_bvh_bounds.hpp"

namespace celltrace::kernel::bvh {

constexpr uint32_t kChildren = 4;

template <class S> class Clusters {
public:
  static constexpr uint32_t kMaxReferences = 8;

  /// Orders the references of `range`, of which there are more than kChildren, and kMaxReferences at most, by
  /// cluster.
  [[gnu::noinline]] static void make(Reference* references, const Range<S>& range,
                                     Range<S> (&clusters)[kChildren]) {
    Clusters work;
    work.start(references + range.begin, range.count());
    while (work.count_ > kChildren)
      work.merge_best();
    work.collect(references + range.begin, range, clusters);
  }

private:
  void start(const Reference* references, uint32_t count) {
    count_ = count;
    for (uint32_t i = 0; i < count; ++i) {
      box_[i] = LaneAabb<S>::of(references[i]);
      members_[i] = 1u << i;
      weight_[i] = references[i].weight;
      cost_[i] = box_[i].area() * static_cast<float>(weight_[i]);
    }
    for (uint32_t i = 1; i < count; ++i)
      for (uint32_t j = 0; j < i; ++j)
        join(i, j);
  }

  /// What it costs to have clusters i > j in one.
  void join(uint32_t i, uint32_t j) {
    LaneAabb<S> box = box_[i];
    box.grow(box_[j]);
    added_[i][j] = box.area() * static_cast<float>(weight_[i] + weight_[j]) - cost_[i] - cost_[j];
  }

  void merge_best() {
    // Branches would be guesses.
    float least = added_[1][0];
    uint32_t best = kMaxReferences;
    for (uint32_t i = 2; i < count_; ++i)
      for (uint32_t j = 0; j < i; ++j) {
        const bool less = added_[i][j] < least;
        least = less ? added_[i][j] : least;
        best = less ? i * kMaxReferences + j : best;
      }
    const uint32_t into = best % kMaxReferences, from = best / kMaxReferences;
    box_[into].grow(box_[from]);
    members_[into] |= members_[from];
    weight_[into] += weight_[from];
    cost_[into] = box_[into].area() * static_cast<float>(weight_[into]);
    const uint32_t last = --count_;
    if (from != last) {
      box_[from] = box_[last];
      members_[from] = members_[last];
      weight_[from] = weight_[last];
      cost_[from] = cost_[last];
    }
    if (count_ == kChildren) return;
    for (uint32_t i = 0; i < count_; ++i) {
      if (i != into) join(i > into ? i : into, i > into ? into : i);
      if (from != last && i != from) {
        const uint32_t high = i > from ? i : from, low = i > from ? from : i;
        if (i != into) added_[high][low] = added_[last][i];
      }
    }
  }

  void collect(Reference* references, const Range<S>& range, Range<S> (&clusters)[kChildren]) const {
    Reference as_given[kMaxReferences];
    for (uint32_t i = 0; i < range.count(); ++i)
      copy<S>(references[i], as_given[i]);
    uint32_t place = 0;
    for (uint32_t c = 0; c < kChildren; ++c) {
      clusters[c] = {range.begin + place, 0, weight_[c], box_[c]};
      for (uint32_t members = members_[c]; members != 0; members &= members - 1)
        copy<S>(as_given[__builtin_ctz(members)], references[place++]);
      clusters[c].end = range.begin + place;
    }
  }

  uint32_t count_;
  LaneAabb<S> box_[kMaxReferences];
  float cost_[kMaxReferences];
  uint32_t members_[kMaxReferences]; ///< a bit each
  uint32_t weight_[kMaxReferences];
  float added_[kMaxReferences][kMaxReferences]; ///< [i][j], i > j
};

} // namespace celltrace::kernel::bvh
