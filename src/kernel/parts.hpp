// Processing of a packet's lanes in parts. Rare code processes as many lanes at a time as Spu::rare_simd has,
// which are all lanes if code takes no local store. Kernel dialect.
#pragma once

#include "celltrace/spe/simd.hpp"
#include "kernel/math.hpp"

namespace celltrace::kernel {

/// True if one part has all of a packet's lanes.
template <class Spu> constexpr bool kOnePart = Spu::rare_simd::kLanes == kSimdLanes;

/// Returns the packet's `whole` if one part has all lanes, otherwise the result of `cut()`.
template <class Spu, class Whole, class Cut>
[[gnu::always_inline]] inline decltype(auto) whole_or(const Whole& whole, [[maybe_unused]] const Cut& cut) {
  if constexpr (kOnePart<Spu>)
    return (whole);
  else
    return cut();
}

/// Calls `visit(first)` for the first lane of each part.
template <class Spu, class Visit> [[gnu::always_inline]] inline void for_each_part(Visit visit) {
  for (uint32_t first = 0; first < kSimdLanes; first += Spu::rare_simd::kLanes)
    visit(first);
}

/// Returns the bits or values of the part that begins at lane `first`.
template <class Spu> uint32_t part_of(uint32_t lanes, uint32_t first) {
  return lanes >> first & ((1u << Spu::rare_simd::kLanes) - 1);
}
template <class Spu>
typename Spu::rare_simd::F part_of(const typename Spu::simd::F& numbers, [[maybe_unused]] uint32_t first) {
  if constexpr (kOnePart<Spu>)
    return numbers;
  else
    return Spu::rare_simd::part(numbers, first);
}
template <class Spu>
V3<typename Spu::rare_simd> part_of(const V3<typename Spu::simd>& vectors, uint32_t first) {
  return {part_of<Spu>(vectors.x, first), part_of<Spu>(vectors.y, first), part_of<Spu>(vectors.z, first)};
}

template <class Spu>
void set_part(typename Spu::simd::F& numbers, [[maybe_unused]] uint32_t first,
              const typename Spu::rare_simd::F& part) {
  if constexpr (kOnePart<Spu>)
    numbers = part;
  else
    Spu::rare_simd::set_part(numbers, first, part);
}
template <class Spu>
void set_part(V3<typename Spu::simd>& vectors, uint32_t first, const V3<typename Spu::rare_simd>& part) {
  set_part<Spu>(vectors.x, first, part.x);
  set_part<Spu>(vectors.y, first, part.y);
  set_part<Spu>(vectors.z, first, part.z);
}

/// Moves the lanes not in `lanes`, which must not be empty, to the point of the first lane in `lanes` if a
/// packet is one part: noise is computed faster if lanes are in one cell.
template <class Spu>
void move_idle_lanes([[maybe_unused]] V3<typename Spu::rare_simd>& points, [[maybe_unused]] uint32_t lanes) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  if constexpr (kOnePart<Spu>) {
    if (lanes == (1u << S::kLanes) - 1) return;
    const auto stay = S::M::from_bits(lanes);
    const auto move = [&](F& coordinate) {
      alignas(64) float of_lane[S::kLanes];
      coordinate.store(of_lane);
      coordinate = S::select(stay, coordinate, F(of_lane[__builtin_ctz(lanes)]));
    };
    move(points.x);
    move(points.y);
    move(points.z);
  }
}

/// Sets `result` to the results of `compute` for each part of `values`, which are numbers or vectors.
template <class Spu, class Result, class Compute, class... Values>
[[gnu::always_inline]] inline void by_parts(Result& result, Compute compute, const Values&... values) {
  for_each_part<Spu>(
      [&](uint32_t first) { set_part<Spu>(result, first, compute(part_of<Spu>(values, first)...)); });
}

} // namespace celltrace::kernel
