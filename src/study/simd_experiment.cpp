// Compares intersection of packets in SIMD lanes with intersection of one ray after the other.
#include "celltrace/emulator.hpp"
#include "celltrace/error.hpp"
#include "kernel/primitives/list.hpp"
#include "kernel/scalar_work.hpp"
#include "study/experiment.hpp"
#include "study/scalar_intersection.hpp"

#include <cmath>

namespace celltrace::study {

namespace {

using namespace kernel;
using S = EmulatedSpu::simd;

// Work counted in the SPU's code of scalar_intersection.hpp (spu-elf-g++ 9.3, -O2); its waits are
// estimated.
constexpr ScalarWork kScalarSphere = {19, 21, 14, 15, 1, 0, 88, 6};
constexpr ScalarWork kScalarTriangle = {43, 43, 17, 18, 4, 0, 147, 26};

/// Makes a packet of rays along z, half of which hit the object.
RayPacket make_packet() {
  RayPacket rays{};
  for (std::uint32_t lane = 0; lane < kSimdLanes; ++lane) {
    rays.origin.x.lane[lane] = 0.2f + 0.2f * static_cast<float>(lane % 4);
    rays.origin.y.lane[lane] = 0.2f + 0.2f * static_cast<float>(lane / 4);
    rays.origin.z.lane[lane] = -5;
    rays.direction.z.lane[lane] = 1;
    rays.start_object.lane[lane] = 0xFFFFFFFFu;
  }
  return rays;
}

ObjectRecord make_object(ObjectKind kind) {
  ObjectRecord object{};
  object.kind_and_flags = static_cast<std::uint32_t>(kind);
  const float sphere[4] = {0.2f, 0.2f, 0, 0.5f}, triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const float* const from = kind == ObjectKind::sphere ? sphere : triangle;
  std::copy(from, from + (kind == ObjectKind::sphere ? 4 : 9), object.geometry);
  return object;
}

struct Measured {
  double cycles_a_ray = 0;
  std::uint32_t hits = 0; ///< hits of a packet
};

constexpr int kPackets = 1000;

template <class Work> Measured measure(Work work) {
  std::uint32_t hits = 0;
  const EmulatedRun run = emulate(lockstep(1), [&](EmulatedSpu& spu) {
    for (int i = 0; i < kPackets; ++i)
      hits += work(spu);
  });
  if (!run.ok()) throw Error(run.report());
  return {static_cast<double>(run.cycles) / (kPackets * 16.0), hits / kPackets};
}

Measured in_lanes(ObjectKind kind) {
  const RayPacket rays = make_packet();
  const ObjectRecord object = make_object(kind);
  return measure([&](EmulatedSpu& spu) {
    spu.compute(scalar_work::kTest[static_cast<std::uint32_t>(kind)]);
    Crossings<S> crossings;
    crossings.clear();
    Primitives::dispatch(static_cast<std::uint32_t>(kind), [&](auto shape) {
      decltype(shape)::template intersect<S>(rays, object, {}, 0, &crossings);
    });
    return static_cast<std::uint32_t>(__builtin_popcount(crossings.near_hit.bits()));
  });
}

Measured one_by_one(ObjectKind kind) {
  const RayPacket rays = make_packet();
  const ObjectRecord object = make_object(kind);
  return measure([&](EmulatedSpu& spu) {
    std::uint32_t hits = 0;
    for (std::uint32_t lane = 0; lane < kSimdLanes; ++lane) {
      const ScalarRay ray = {
          {rays.origin.x.lane[lane], rays.origin.y.lane[lane], rays.origin.z.lane[lane]},
          {rays.direction.x.lane[lane], rays.direction.y.lane[lane], rays.direction.z.lane[lane]}};
      float distance[2];
      const bool hit = kind == ObjectKind::sphere
                           ? hits_sphere(ray, object.geometry, distance, [](float x) { return std::sqrt(x); })
                           : hits_triangle(ray, object.geometry, distance[0]);
      spu.compute(kind == ObjectKind::sphere ? kScalarSphere : kScalarTriangle);
      hits += hit ? 1 : 0;
    }
    return hits;
  });
}

} // namespace

Table study_simd(Laboratory& laboratory) {
  Table table{
      "simd",
      "Intersection in SIMD lanes and one ray after the other",
      "With SIMD intersection tests a picture took 43.68 s instead of 77.36 s (1.77 times as fast).",
      "",
      {{"object"}, {"scalar, cycles a ray", 1}, {"SIMD, cycles a ray", 1}, {"scalar / SIMD", 2}},
      {},
      {Chart::Kind::bars, "object", "cycles a ray", false, false, {}, {{"scalar", {}}, {"SIMD", {}}}}};
  const std::vector<std::pair<std::string, ObjectKind>> kinds = {{"sphere", ObjectKind::sphere},
                                                                 {"triangle", ObjectKind::triangle}};
  std::string ratios;
  laboratory.runner.each(1, [&](std::size_t) {
    for (const auto& [name, kind] : kinds) {
      const Measured scalar = one_by_one(kind), simd = in_lanes(kind);
      if (scalar.hits != simd.hits) throw Error("scalar and SIMD intersection of a " + name + " differ");
      const double ratio = scalar.cycles_a_ray / simd.cycles_a_ray;
      table.rows.push_back({name, scalar.cycles_a_ray, simd.cycles_a_ray, ratio});
      const auto index = static_cast<double>(table.chart.labels.size());
      table.chart.series[0].points.emplace_back(index, scalar.cycles_a_ray);
      table.chart.series[1].points.emplace_back(index, simd.cycles_a_ray);
      table.chart.labels.push_back(name);
      ratios += (ratios.empty() ? "" : ", ") + name + "s " + number(ratio, 2);
    }
  });
  table.here =
      "Times as fast in lanes: " + ratios +
      ". Sixteen rays in four quadwords hide the latency of each other's arithmetic as well as they share "
      "instructions.";
  return table;
}

} // namespace celltrace::study
