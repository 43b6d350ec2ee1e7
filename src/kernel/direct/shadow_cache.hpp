// The shadow cache: objects that occluded shadow rays just now. Kernel dialect.
#pragma once

#include <cstdint>

namespace celltrace::kernel {

/// The opaque objects that occluded shadow rays of a packet toward the previous place of a light: they
/// probably do so again (Haines and Greenberg, The light buffer, 1986), and a test costs less than a
/// traversal.
class ShadowCache {
public:
  bool recording = false; ///< true if occluders are to be added

  /// Adds an object, in place of the oldest one if there is no room.
  void add(uint32_t object) {
    for (uint32_t i = 0; i < count_; ++i)
      if (objects_[i] == object) return;
    objects_[next_] = object;
    next_ = (next_ + 1) % kMost;
    if (count_ < kMost) ++count_;
  }
  void forget() { count_ = next_ = 0; }
  /// Keeps the objects for which `occlude(object)` returns true. None is added meanwhile.
  template <class Occlude> void test(Occlude occlude) {
    ShadowCache kept;
    kept.recording = recording;
    recording = false;
    for (uint32_t i = 0; i < count_; ++i)
      if (occlude(objects_[i])) kept.add(objects_[i]);
    *this = kept;
  }

private:
  static constexpr uint32_t kMost = 8;
  uint32_t objects_[kMost], count_ = 0, next_ = 0;
};

} // namespace celltrace::kernel
