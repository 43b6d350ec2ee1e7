// Which shadow rays are walked from surface to surface where memory is direct. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/shading/ray_stack.hpp"

namespace celltrace::kernel {

/// The lanes that Traversal's mark_translucent() has marked.
template <class S> uint32_t marked_lanes(const VectorLanes& marks) {
  using F = typename S::F;
  return (F::load(marks.x.lane) > F(0.0f)).bits();
}

/// The lanes whose rays have come into something with an interior, if they are not those of the camera.
inline uint32_t lanes_inside(const RayInteriors* node) {
  uint32_t inside = 0;
  if (node != nullptr)
    for (uint32_t lane = 0; lane < kSimdLanes; ++lane)
      inside |= static_cast<uint32_t>(node->interior_depth.lane[lane] != 0) << lane;
  return inside;
}

/// Says whether it pays to find out which shadow rays cross something translucent, so that others need not be
/// walked (ShadowWalk): not where many do. Rays that start inside, of which nearly all may, are counted
/// apart.
class ShadowMarking {
public:
  /// The lanes of a packet that are walked without asking. `inside`: those that start there.
  uint32_t walked_at_once(uint32_t lanes, uint32_t inside) {
    return outside_.walked_at_once(lanes & ~inside) | inside_.walked_at_once(lanes & inside);
  }
  /// Counts the lanes among those `asked` that are marked.
  void count(uint32_t asked, uint32_t inside, uint32_t marked) {
    outside_.count(asked & ~inside, marked);
    inside_.count(asked & inside, marked);
  }

private:
  class Share {
  public:
    uint32_t walked_at_once(uint32_t lanes) {
      const float most = tuning::kMostMarked * static_cast<float>(asked_);
      if (lanes == 0 || static_cast<float>(marked_) <= most) return 0;
      return ++packets_ % kPacketsByAsked != 0 ? lanes : 0;
    }
    void count(uint32_t asked, uint32_t marked) {
      asked_ += static_cast<uint32_t>(__builtin_popcount(asked));
      marked_ += static_cast<uint32_t>(__builtin_popcount(asked & marked));
      if (asked_ < kRemembered) return;
      asked_ /= 2;
      marked_ /= 2;
    }

  private:
    /// Of so many packets one is asked nevertheless: where the next ones are it may be otherwise.
    static constexpr uint32_t kPacketsByAsked = 32;
    static constexpr uint32_t kRemembered = 8192; ///< lanes

    uint32_t asked_ = 0, marked_ = 0, packets_ = 0;
  };

  Share outside_, inside_;
};

} // namespace celltrace::kernel
