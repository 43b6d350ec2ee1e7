// Agglomerative clustering of a few references into the four children of a node: the two clusters whose union
// adds least to the SAH cost are merged, until four are left (Walter, Bala, Kulkarni and Pingali, Fast
// Agglomerative Clustering for Rendering, 2008). Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/direct/build_bvh_bounds.hpp"
#include "kernel/tuning.hpp"

namespace celltrace::kernel::bvh {

constexpr uint32_t kChildren = 4;

/// A cluster is a set of references. For so few of them the cost of every pair of clusters is kept.
template <class S> class Clusters {
public:
  static constexpr uint32_t kMaxReferences = tuning::kMostClusteredReferences;

  /// Reorders the references of `range` by cluster, and describes the clusters. The range has more than
  /// kChildren references, and at most kMaxReferences.
  CELLTRACE_ONE_COPY static void make(Reference* references, const Range<S>& range,
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
      bounds_[i] = LaneAabb<S>::of(references[i]);
      references_[i] = 1u << i;
      weight_[i] = references[i].weight;
      cost_[i] = bounds_[i].area() * static_cast<float>(weight_[i]);
    }
    for (uint32_t i = 1; i < count; ++i)
      for (uint32_t j = 0; j < i; ++j)
        measure_union(i, j);
  }

  /// Computes the cost that merging clusters i > j would add.
  void measure_union(uint32_t i, uint32_t j) {
    LaneAabb<S> bounds = bounds_[i];
    bounds.grow(bounds_[j]);
    added_[i][j] = bounds.area() * static_cast<float>(weight_[i] + weight_[j]) - cost_[i] - cost_[j];
  }

  void merge_best() {
    // Conditional moves in place of branches, which would be mispredicted.
    float least = added_[1][0];
    uint32_t best = kMaxReferences;
    for (uint32_t i = 2; i < count_; ++i)
      for (uint32_t j = 0; j < i; ++j) {
        const bool less = added_[i][j] < least;
        least = less ? added_[i][j] : least;
        best = less ? i * kMaxReferences + j : best;
      }
    const uint32_t into = best % kMaxReferences, from = best / kMaxReferences;
    bounds_[into].grow(bounds_[from]);
    references_[into] |= references_[from];
    weight_[into] += weight_[from];
    cost_[into] = bounds_[into].area() * static_cast<float>(weight_[into]);
    const uint32_t last = --count_;
    if (from != last) {
      bounds_[from] = bounds_[last];
      references_[from] = references_[last];
      weight_[from] = weight_[last];
      cost_[from] = cost_[last];
    }
    if (count_ == kChildren) return;
    for (uint32_t i = 0; i < count_; ++i) {
      if (i != into) measure_union(i > into ? i : into, i > into ? into : i);
      if (from != last && i != from) {
        const uint32_t high = i > from ? i : from, low = i > from ? from : i;
        if (i != into) added_[high][low] = added_[last][i];
      }
    }
  }

  void collect(Reference* references, const Range<S>& range, Range<S> (&clusters)[kChildren]) const {
    Reference original[kMaxReferences];
    for (uint32_t i = 0; i < range.count(); ++i)
      copy<S>(references[i], original[i]);
    uint32_t place = 0;
    for (uint32_t c = 0; c < kChildren; ++c) {
      clusters[c] = {range.begin + place, 0, weight_[c], bounds_[c]};
      for (uint32_t remaining = references_[c]; remaining != 0; remaining &= remaining - 1)
        copy<S>(original[__builtin_ctz(remaining)], references[place++]);
      clusters[c].end = range.begin + place;
    }
  }

  uint32_t count_;
  LaneAabb<S> bounds_[kMaxReferences];
  float cost_[kMaxReferences];
  uint32_t references_[kMaxReferences]; ///< of each cluster, a bit each
  uint32_t weight_[kMaxReferences];
  float added_[kMaxReferences][kMaxReferences]; ///< cost of merging i and j, i > j
};

} // namespace celltrace::kernel::bvh
