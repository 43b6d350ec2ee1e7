// A kernel that applies every operation of the SIMD facade to blocks of operands.
#pragma once

#include "celltrace/spe/simd.hpp"
#include "celltrace/spe/types.hpp"

namespace celltrace::test {

struct alignas(128) FacadeBlock {
  // operands
  float a[16], b[16];
  int32_t i[16], j[16];
  uint32_t m, n; ///< masks
  uint32_t pad[14];
  uint32_t p[4], q[4];
  uint32_t pad_words[8];
  // results
  float sum[16], difference[16], product[16], quotient[16], negative[16];
  float least[16], most[16], magnitude[16], root[16], chosen[16];
  float splat[16], from_int[16], reinterpreted[16], joined[16];
  float transposed[4][16];
  float unaligned[16];
  float row_sums[2][16], equal_row_sums[2][16];
  int32_t int_sum[16], int_difference[16], int_and[16], int_or[16], int_chosen[16];
  float floor[16];
  int32_t to_int[16], bits[16], left_1[16], left_23[16], right_1[16], right_23[16], int_splat[16];
  int32_t of_line[16];
  uint32_t u4_and[4], u4_or[4], u4_splat[4];
  uint32_t u4_equal, u4_equal_self;
  uint32_t less, less_equal, greater, greater_equal, equal;
  uint32_t int_equal, int_less;
  uint32_t mask_and, mask_or, mask_not, mask_none, mask_all, mask_same;
  float least_of_all, greatest_of_all;
  // where memory is direct
  alignas(128) float picked[16];
  float stored[32];
  int32_t int_picked[16], int_stored[32], lane_numbers[16], gathered[16];
  uint32_t spread;
};
static_assert(sizeof(FacadeBlock) % 128 == 0, "crosses DMA");

struct alignas(16) FacadeTask {
  ea_t blocks;
  uint32_t count;
  uint32_t pad;
};

template <class S> void apply_facade(FacadeBlock& x) {
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;
  using U4 = typename S::U4;
  const F a = F::load(x.a);
  const F b = F::load(x.b);
  (a + b).store(x.sum);
  (a - b).store(x.difference);
  (a * b).store(x.product);
  (a / b).store(x.quotient);
  (-a).store(x.negative);
  S::min(a, b).store(x.least);
  S::max(a, b).store(x.most);
  S::extremes(a, x.least_of_all, x.greatest_of_all);
  S::abs(a).store(x.magnitude);
  S::sqrt(S::abs(a)).store(x.root);
  F(x.a[3]).store(x.splat);
  using F4 = typename S::F4;
  S::join(F4::load(x.a), F4::load(x.b), F4::load(x.a + 12), F4::load(x.b + 4)).store(x.joined);
  F rows[4] = {a, b, a + b, a - b};
  S::transpose_quads(rows[0], rows[1], rows[2], rows[3]);
  for (int row = 0; row < 4; ++row)
    rows[row].store(x.transposed[row]);
  F::load_unaligned(x.a + 5).store(x.unaligned);
  x.less = (a < b).bits();
  x.less_equal = (a <= b).bits();
  x.greater = (a > b).bits();
  x.greater_equal = (a >= b).bits();
  x.equal = (a == b).bits();
  S::floor(a).store(x.floor);
  S::to_int(a).store(x.to_int);
  S::bits_of(a).store(x.bits);

  const I i = I::load(x.i);
  const I j = I::load(x.j);
  (i + j).store(x.int_sum);
  (i - j).store(x.int_difference);
  (i & j).store(x.int_and);
  (i | j).store(x.int_or);
  I::splat(x.i[5]).store(x.int_splat);
  x.int_equal = (i == j).bits();
  x.int_less = (i < j).bits();
  S::to_float(i).store(x.from_int);
  S::float_of(S::bits_of(b)).store(x.reinterpreted);
  S::template shift_left<1>(i).store(x.left_1);
  S::template shift_left<23>(i).store(x.left_23);
  S::template shift_right<1>(i).store(x.right_1);
  // The first line of the block: a, and behind it b.
  I::load_words(&x, S::template shift_left<2>(i)).store(x.of_line);
  S::template shift_right<23>(i).store(x.right_23);

  const M m = M::from_bits(x.m);
  const M n = M::from_bits(x.n);
  x.mask_same = m.bits();
  x.mask_and = (m & n).bits();
  x.mask_or = (m | n).bits();
  x.mask_not = (!m).bits();
  x.mask_none = M::none().bits();
  x.mask_all = M::all().bits();
  S::select(m, a, b).store(x.chosen);
  S::select(n, i, j).store(x.int_chosen);

  const U4 p = U4::load(x.p);
  const U4 q = U4::load(x.q);
  (p & q).store(x.u4_and);
  (p | q).store(x.u4_or);
  U4::splat(x.p[2]).store(x.u4_splat);
  x.u4_equal = equal_bits(p, q);
  x.u4_equal_self = equal_bits(p, p);
}

/// What there is where memory is direct.
template <class S> void apply_direct_facade(FacadeBlock& x) {
  using F = typename S::F;
  using I = typename S::I;
  const F a = F::load(x.a);
  const I i = I::load(x.i), lanes = I::load(x.j) & I::splat(15);
  S::pick(a, lanes).store(x.picked);
  S::pick(i, lanes).store(x.int_picked);
  S::lane_numbers(x.m).store(x.lane_numbers);
  x.spread = S::spread(x.n, x.m);
  I::gather(x.i, lanes).store(x.gathered);
  a.store_unaligned(x.stored + 5);
  i.store_unaligned(x.int_stored + 3);
}

/// Where the rows of each lane start in the 32 numbers a and b, or those of lane 0 for all.
struct RowStarts {
  const int32_t* of_lane;
  bool equal;

  static constexpr uint32_t kKeys = 1;
  const int32_t* keys(uint32_t) const {
    alignas(64) static constexpr int32_t kSame[16] = {};
    return equal ? kSame : of_lane;
  }
  void operator()(uint32_t lane, uint32_t (&starts)[2]) const {
    const uint32_t start = static_cast<uint32_t>(of_lane[equal ? 0 : lane]) & 15;
    starts[0] = start;
    starts[1] = (start * 7 + 3) & 15;
  }
  template <class LookUp, uint32_t kLanes>
  void find_indices(const LookUp& look_up, int32_t (&indices)[2][kLanes]) const {
    static constexpr uint16_t kMultiples[16] = {0,    256,  512,  768,  1024, 1280, 1536, 1792,
                                                2048, 2304, 2560, 2816, 3072, 3328, 3584, 3840};
    typename LookUp::Numbers numbers[2];
    look_up(
        kMultiples,
        [this](uint32_t lane, uint32_t row) {
          uint32_t starts[2];
          (*this)(lane, starts);
          return starts[row];
        },
        numbers);
    for (uint32_t row = 0; row < 2; ++row)
      numbers[row].store(indices[row]);
  }
  static uint32_t start(uint32_t multiple) { return multiple / 256; }
};

template <class S> void apply_rare_facade(FacadeBlock& x) {
  using F = typename S::F;
  for (uint32_t first = 0; first < kSimdLanes; first += S::kLanes) {
    const F a = F::load(x.a + first), b = F::load(x.b + first);
    const auto sum = [&](const RowStarts& starts, float(&results)[2][16]) {
      const auto factors_of = [&](uint32_t row, F(&factors)[4]) {
        const F all[2][4] = {{a, b, a + b, F(2.0f)}, {b, F(-3.0f), a - b, a}};
        for (uint32_t i = 0; i < 4; ++i)
          factors[i] = all[row][i];
      };
      F sums[2];
      S::template sum_rows<2>(x.a, starts, factors_of, sums);
      for (uint32_t channel = 0; channel < 2; ++channel)
        sums[channel].store(results[channel] + first);
    };
    sum({x.i + first, false}, x.row_sums);
    sum({x.i, true}, x.equal_row_sums);
  }
}

template <class Spu> void facade(Spu& spu, ea_t argument) {
  FacadeTask* task = spu.template allocate<FacadeTask>();
  FacadeBlock* block = spu.template allocate<FacadeBlock>();
  spu.get(task, argument, sizeof *task, 0);
  spu.wait_all(1);
  for (uint32_t k = 0; k < task->count; ++k) {
    const ea_t at = task->blocks + k * sizeof(FacadeBlock);
    spu.get(block, at, sizeof *block, 0);
    spu.wait_all(1);
    apply_facade<typename Spu::simd>(*block);
    apply_rare_facade<typename Spu::rare_simd>(*block);
    if constexpr (Spu::direct_memory) apply_direct_facade<typename Spu::simd>(*block);
    spu.put(block, at, sizeof *block, 0);
    spu.wait_all(1);
  }
}

} // namespace celltrace::test
