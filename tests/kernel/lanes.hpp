// Between the sixteen lanes of a packet and the doubles that tests calculate with.
#pragma once

#include "celltrace/scene.hpp"
#include "direct_spu.hpp"
#include "kernel/packet.hpp"
#include "kernel/primitives/list.hpp"

#include <random>

#include <glm/geometric.hpp>

namespace celltrace::test {

using Simd = DirectSpu::simd;
using F = Simd::F;
using M = Simd::M;
using Vec = kernel::V3<Simd>;

inline F load(const kernel::FloatLanes& lanes) {
  return F::load(lanes.lane);
}
inline kernel::FloatLanes lanes_of(const F& values) {
  kernel::FloatLanes lanes;
  values.store(lanes.lane);
  return lanes;
}
inline kernel::VectorLanes lanes_of(const Vec& values) {
  kernel::VectorLanes lanes;
  lanes.store<Simd>(values);
  return lanes;
}
/// The first two crossings of a packet with an object without further records.
inline kernel::Crossings<Simd> intersect(const kernel::RayPacket& rays, const kernel::ObjectRecord& object,
                                         std::uint32_t self) {
  kernel::Crossings<Simd> crossings[kernel::kMaxCrossingPairs];
  kernel::Primitives::dispatch(object.kind_and_flags & kernel::object_flag::kind_mask, [&](auto shape) {
    decltype(shape)::template intersect<Simd>(rays, object, {}, self, crossings);
  });
  return crossings[0];
}
inline Vec3 at(const kernel::VectorLanes& v, unsigned lane) {
  return {v.x.lane[lane], v.y.lane[lane], v.z.lane[lane]};
}
inline void set(kernel::VectorLanes& v, unsigned lane, const Vec3& value) {
  v.x.lane[lane] = static_cast<float>(value.x);
  v.y.lane[lane] = static_cast<float>(value.y);
  v.z.lane[lane] = static_cast<float>(value.z);
}

/// A number of repetitions, fewer where sanitizers or emulated processors make each of them slow.
constexpr int times(int repetitions) {
#ifdef CELLTRACE_SLOW_BUILD
  return repetitions / 16;
#else
  return repetitions;
#endif
}

/// Reproducible random numbers.
class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  unsigned below(unsigned bound) { return std::uniform_int_distribution<unsigned>(0, bound - 1)(engine_); }
  std::uint32_t word() { return static_cast<std::uint32_t>(engine_()); }
  Vec3 point(double reach) {
    return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 p = point(1);
      const double length = glm::length(p);
      if (length > 0.1 && length <= 1) return p / length;
    }
  }

private:
  std::mt19937 engine_;
};

} // namespace celltrace::test
