// The SIMD facade: the operations that `Spu::simd` offers to kernels. This header documents the facade.
// simd_host.hpp implements it over xsimd, backends/spu over the SPU's intrinsics.
//
// A ray packet is 4x4 rays, 16 lanes in structure-of-arrays form: four 128-bit vectors on an SPU, one 512-bit
// vector on AVX-512. Lane l is ray (l % 4, l / 4). Types, all plain values without alignment demands on the
// caller:
//
//   F    16 floats, implicitly from one float (splat); default construction leaves it indeterminate
//        F::load(const float*) / store(float*), 64-byte aligned; + - * / and unary -; < <= > >= == give M;
//        F::load_unaligned(const float*): from any float on
//   I    16 int32: I::splat, load, store; + - & |; == < give M; I::load_words(line, offsets): for each
//        lane the word at its offset, a multiple of 4 and taken modulo 128, of the 128 bytes at `line`;
//        ^ (exclusive or)
//   M    16 truth values: M::none(), all(), from_bits(uint32), bits() (lane l in bit l); & | !
//   F4   4 floats, one SPU quadword: splat, load, store (16-byte aligned); + - *; not_above_bits(a, b):
//        4 bits, lane 0 in bit 0, of a <= b; min max
//   U4   4 uint32, one SPU quadword: splat, load, store (16-byte aligned); & |; equal_bits(a, b) -> 4 bits,
//        lane 0 in bit 0
//
//   min max (of ordinary numbers), extremes(F, least, greatest) (of all lanes), abs, sqrt (of x >= 0),
//   join(F4, F4, F4, F4) -> F, lanes 0 to 3 first,
//   transpose_quads(F& a, b, c, d): of each four lanes 4q to 4q + 3, the 4x4 numbers with rows a to d,
//   select(M, a, b) = m ? a : b for F and I,
//   to_int (truncates), to_float, floor (all of |x| < 2^31; floor may give a 0 any sign),
//   bits_of / float_of (reinterpret), shift_left<n>, shift_right<n> (arithmetic)
//
// If memory is direct the facade also has, for tables and to gather lanes of several packets:
//
//   I::gather(const int32_t* table, I indices): for each lane the number in the table at its index,
//   store_unaligned() of F and I, to any address of a number,
//   pick(a, I lanes): for each lane of F or I, the lane of `a` whose number is in `lanes`,
//   lane_numbers(uint32 lanes) -> I, the numbers of the lanes whose bits are set, in the first lanes; then 0,
//   spread(uint32 bits, uint32 lanes): moves bit i of `bits` to the i-th bit that is set in `lanes`
//
// `Spu::rare_simd` is the facade for code that runs rarely. It has kLanes lanes: 16, or the 4 of one quadword
// if local store is short, and then rare code works on the lanes of a packet part by part. It has F, I and M
// with all operations above except load_words, extremes, join and transpose_quads; it has no F4 and U4. A
// facade of 4 lanes has part(F of Spu::simd, first), which returns lanes first to first + 3, and set_part(F&
// of Spu::simd, first, F), which replaces these lanes; `first` is a multiple of 4. Both facades have
//
//   sum_rows<rows>(const float* table, starts_of, factors_of, F (&sums)[channels]): for each lane, the sum of
//   some rows of the table, times factors. A row has four numbers for each channel, one after the other:
//   those of channel c are multiplied by the four factors of the row, and added up to sums[c]. The rows are
//   added up in their order, then the four numbers as (0 + 1) + (2 + 3). Up to 16 bytes behind the last row
//   may be read. starts_of(lane, uint32_t (&starts)[rows]) sets `starts` to the indices in the table at which
//   the rows of a lane start. Two lanes have the same starts if starts_of.keys(i), an aligned const
//   int32_t[kLanes], has equal numbers for both lanes, for each i below StartsOf::kKeys; some implementations
//   use the keys. Other implementations call starts_of.find_indices(look_up, int32_t (&)[rows][kLanes]),
//   which returns indices of all lanes' rows; starts_of.start(index) turns an index into a start.
//   find_indices may call look_up(const uint16_t* table, index_of, Numbers (&numbers)[n]), which sets lane l
//   of numbers[i] to the table's number at index_of(l, i). LookUp::Numbers is an I, whose operations emulated
//   machines do not count. factors_of(row, F (&factors)[4]) returns a row's four factors, and may be called
//   more than once.
//
// On the host every float operation is IEEE single precision, never fused, so that all widths and backends
// give the same bits. On the SPU division and sqrt are estimates refined to within 2 units in the last place,
// rounding is toward zero, and there are no infinities, NaNs and denormals: kernels may not depend on any of
// these.
#pragma once

#include <stdint.h>

namespace celltrace {

constexpr uint32_t kSimdLanes = 16;

/// The bit of each lane: lane l holds 1 << l.
alignas(64) constexpr int32_t simd_lane_bits[kSimdLanes] = {1,   2,   4,    8,    16,   32,   64,    128,
                                                            256, 512, 1024, 2048, 4096, 8192, 16384, 32768};

} // namespace celltrace
