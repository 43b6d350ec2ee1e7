// Shadow rays of many ray trees in full packets. Kernel dialect, where memory is direct.
//
// Of what a packet of secondary rays hits often few lanes send light on: others are dark, clear, or turned
// away from the light. Such points of all trees of a bundle wait here, by light, until they fill a packet.
#pragma once

#include "kernel/lights/incident_light.hpp"
#include "kernel/shading/ray_stack.hpp"
#include "kernel/tuning.hpp"

namespace celltrace::kernel {

/// Points of different trees, each of which sends light to its pixel's own.
struct QueuedPoints {
  VectorLanes point;
  WordLanes object;       ///< that each lies on
  VectorLanes light;      ///< that they send on if nothing is in the way
  WordLanes pixels;       ///< of the bundle, by lane
  RayInteriors interiors; ///< of the rays that have hit them, if these are wanted
};

template <class Spu> class ShadowQueue {
public:
  explicit ShadowQueue(Spu& spu) : packets_(spu.template allocate<QueuedPoints>(kLights)) { clear(); }

  /// Whether points wait that a light of the frame lights. Otherwise it has no queue, or so many are as well
  /// off by themselves.
  static bool takes(uint32_t light, uint32_t lanes) {
    return light < kLights && __builtin_popcount(lanes) < tuning::kLeastRaysByThemselves;
  }
  /// Adds some lanes of a packet of points. Calls `trace(packet)` once a packet is full. `interiors`: null if
  /// they are not wanted.
  template <class Trace>
  void add(uint32_t light, uint32_t lanes, const V3<typename Spu::simd>& points, const WordLanes& objects,
           const VectorLanes& colours, const WordLanes& pixels, const RayInteriors* interiors,
           const Trace& trace) {
    QueuedPoints& packet = packets_[light];
    VectorLanes point;
    point.template store<typename Spu::simd>(points);
    for_each_lane(lanes, [&](uint32_t lane) {
      const uint32_t to = count_[light]++;
      copy_lane(point, lane, packet.point, to);
      copy_lane(objects, lane, packet.object, to);
      copy_lane(colours, lane, packet.light, to);
      copy_lane(pixels, lane, packet.pixels, to);
      if (interiors != nullptr) copy_lane(*interiors, lane, packet.interiors, to);
      if (count_[light] < kSimdLanes) return;
      count_[light] = 0;
      trace(packet);
    });
  }
  /// Calls `trace(light, packet, lanes)` for what still waits.
  template <class Trace> void finish(const Trace& trace) {
    for (uint32_t light = 0; light < kLights; ++light) {
      const uint32_t left = count_[light];
      count_[light] = 0;
      if (left != 0) trace(light, packets_[light], (1u << left) - 1);
    }
  }
  /// Forgets all points.
  void clear() {
    for (uint32_t& count : count_)
      count = 0;
  }

private:
  /// Lights of a frame that have a queue: those of the lowest numbers.
  static constexpr uint32_t kLights = 8;

  QueuedPoints* packets_;   ///< by light
  uint32_t count_[kLights]; ///< of points that wait
};

} // namespace celltrace::kernel
