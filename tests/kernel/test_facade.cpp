// Every operation of the SIMD facade on every SPU type against plain C++.
#include "celltrace/spe/program.hpp"
#include "facade_probe.hpp"
#include "lanes.hpp"
#include "machines.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace celltrace {
SpeProgram facade_program(); // made by the build
}

using namespace celltrace;
using namespace celltrace::test;

namespace {

/// Numbers that conversions and comparisons are likely to get wrong, or any.
float awkward(Random& random) {
  static constexpr float kSpecial[] = {0.0f,        -0.0f,      1.0f,        -1.0f,         0.5f,
                                       -0.5f,       1.5f,       -1.5f,       1e-20f,        1e20f,
                                       0.99999994f, 8388607.5f, -8388608.0f, 2147483520.0f, -2147483520.0f};
  const unsigned pick = random.below(3 * std::size(kSpecial));
  if (pick < std::size(kSpecial)) return kSpecial[pick];
  return static_cast<float>(random.uniform(-1, 1) * std::pow(10.0, random.uniform(-6, 6)));
}

std::vector<FacadeBlock> operands() {
  Random random(1);
  std::vector<FacadeBlock> blocks(500);
  for (FacadeBlock& x : blocks) {
    std::memset(&x, 0xA5, sizeof x);
    for (int l = 0; l < 16; ++l) {
      x.a[l] = awkward(random);
      x.b[l] = random.below(4) == 0 ? x.a[l] : awkward(random);
      if (x.b[l] == 0) x.b[l] = 3;
      x.i[l] = static_cast<int32_t>(random.word()) >> random.below(31);
      x.j[l] = random.below(4) == 0 ? x.i[l] : static_cast<int32_t>(random.word());
    }
    x.m = random.word() & 0xFFFF;
    x.n = random.word() & 0xFFFF;
    for (int l = 0; l < 4; ++l) {
      x.p[l] = random.word();
      x.q[l] = random.below(2) == 0 ? x.p[l] : random.word();
    }
  }
  return blocks;
}

std::uint32_t bits(float value) {
  std::uint32_t word;
  std::memcpy(&word, &value, 4);
  return word;
}

template <class Expected> bool same_floats(const float (&actual)[16], Expected expected) {
  for (int l = 0; l < 16; ++l)
    if (bits(actual[l]) != bits(expected(l))) return false;
  return true;
}
template <class Expected> bool same_ints(const int32_t (&actual)[16], Expected expected) {
  for (int l = 0; l < 16; ++l)
    if (actual[l] != static_cast<int32_t>(expected(l))) return false;
  return true;
}
template <class Test> std::uint32_t mask_of(Test test, int lanes = 16) {
  std::uint32_t mask = 0;
  for (int l = 0; l < lanes; ++l)
    mask |= static_cast<std::uint32_t>(test(l)) << l;
  return mask;
}
std::uint32_t word(int32_t value) {
  return static_cast<std::uint32_t>(value);
}

void check_floats(const FacadeBlock& x) {
  CHECK(same_floats(x.sum, [&](int l) { return x.a[l] + x.b[l]; }));
  CHECK(same_floats(x.difference, [&](int l) { return x.a[l] - x.b[l]; }));
  CHECK(same_floats(x.product, [&](int l) { return x.a[l] * x.b[l]; }));
  CHECK(same_floats(x.quotient, [&](int l) { return x.a[l] / x.b[l]; }));
  CHECK(same_floats(x.negative, [&](int l) { return -x.a[l]; }));
  CHECK(same_floats(x.magnitude, [&](int l) { return std::fabs(x.a[l]); }));
  CHECK(same_floats(x.root, [&](int l) { return std::sqrt(std::fabs(x.a[l])); }));
  CHECK(same_floats(x.splat, [&](int) { return x.a[3]; }));
  CHECK(same_floats(x.reinterpreted, [&](int l) { return x.b[l]; }));
  CHECK(same_floats(x.from_int, [&](int l) { return static_cast<float>(x.i[l]); }));
  CHECK(same_floats(x.chosen, [&](int l) { return (x.m >> l & 1) != 0 ? x.a[l] : x.b[l]; }));
  // The sign of a zero is open.
  for (int l = 0; l < 16; ++l) {
    CHECK(x.least[l] == std::min(x.a[l], x.b[l]));
    CHECK(x.most[l] == std::max(x.a[l], x.b[l]));
  }
  CHECK(x.least_of_all == *std::min_element(x.a, x.a + 16));
  CHECK(x.greatest_of_all == *std::max_element(x.a, x.a + 16));
  CHECK(same_floats(x.joined, [&](int l) {
    const float* const quads[4] = {x.a, x.b, x.a + 12, x.b + 4};
    return quads[l / 4][l % 4];
  }));
  CHECK(same_floats(x.unaligned, [&](int l) { return l < 11 ? x.a[l + 5] : x.b[l - 11]; }));
  for (int row = 0; row < 4; ++row)
    CHECK(same_floats(x.transposed[row], [&](int l) {
      const float* const rows[4] = {x.a, x.b, x.sum, x.difference};
      return rows[l % 4][l / 4 * 4 + row];
    }));
}

void check_row_sums(const FacadeBlock& x) {
  const auto sum = [&](int channel, int l, int lane_of_starts) {
    std::uint32_t starts[2];
    RowStarts{x.i, false}(static_cast<std::uint32_t>(lane_of_starts), starts);
    const float a = x.a[l], b = x.b[l];
    const float factors[2][4] = {{a, b, a + b, 2.0f}, {b, -3.0f, a - b, a}};
    const auto number = [&](std::uint32_t at) { return at < 16 ? x.a[at] : x.b[at - 16]; };
    float four[4];
    for (unsigned k = 0; k < 4; ++k) {
      const std::uint32_t at = 4 * static_cast<unsigned>(channel) + k;
      four[k] = number(starts[0] + at) * factors[0][k] + number(starts[1] + at) * factors[1][k];
    }
    return (four[0] + four[1]) + (four[2] + four[3]);
  };
  for (int channel = 0; channel < 2; ++channel) {
    CHECK(same_floats(x.row_sums[channel], [&](int l) { return sum(channel, l, l); }));
    CHECK(same_floats(x.equal_row_sums[channel], [&](int l) { return sum(channel, l, 0); }));
  }
}

void check_ints(const FacadeBlock& x) {
  CHECK(same_ints(x.int_sum, [&](int l) { return word(x.i[l]) + word(x.j[l]); }));
  CHECK(same_ints(x.int_difference, [&](int l) { return word(x.i[l]) - word(x.j[l]); }));
  CHECK(same_ints(x.int_and, [&](int l) { return word(x.i[l]) & word(x.j[l]); }));
  CHECK(same_ints(x.int_or, [&](int l) { return word(x.i[l]) | word(x.j[l]); }));
  CHECK(same_ints(x.int_chosen, [&](int l) { return (x.n >> l & 1) != 0 ? x.i[l] : x.j[l]; }));
  CHECK(same_ints(x.int_splat, [&](int) { return x.i[5]; }));
  // The sign of 0 may be any.
  float floors[16];
  std::transform(x.floor, x.floor + 16, floors, [](float f) { return f + 0.0f; });
  CHECK(same_floats(floors, [&](int l) {
    const bool fits = std::fabs(x.a[l]) < 2147483648.0f;
    return fits ? std::floor(x.a[l]) + 0.0f : floors[l];
  }));
  CHECK(same_ints(x.to_int, [&](int l) {
    const bool fits = std::fabs(x.a[l]) < 2147483648.0f;
    return fits ? static_cast<int32_t>(x.a[l]) : x.to_int[l];
  }));
  CHECK(same_ints(x.bits, [&](int l) { return bits(x.a[l]); }));
  CHECK(same_ints(x.left_1, [&](int l) { return word(x.i[l]) << 1; }));
  CHECK(same_ints(x.left_23, [&](int l) { return word(x.i[l]) << 23; }));
  CHECK(same_ints(x.right_1, [&](int l) { return x.i[l] >> 1; }));
  CHECK(same_ints(x.right_23, [&](int l) { return x.i[l] >> 23; }));
  CHECK(same_ints(x.of_line, [&](int l) {
    const std::uint32_t at = word(x.i[l]) % 32;
    return bits(at < 16 ? x.a[at] : x.b[at - 16]);
  }));
}

void check_masks(const FacadeBlock& x) {
  CHECK(x.less == mask_of([&](int l) { return x.a[l] < x.b[l]; }));
  CHECK(x.less_equal == mask_of([&](int l) { return x.a[l] <= x.b[l]; }));
  CHECK(x.greater == mask_of([&](int l) { return x.a[l] > x.b[l]; }));
  CHECK(x.greater_equal == mask_of([&](int l) { return x.a[l] >= x.b[l]; }));
  CHECK(x.equal == mask_of([&](int l) { return x.a[l] == x.b[l]; }));
  CHECK(x.int_equal == mask_of([&](int l) { return x.i[l] == x.j[l]; }));
  CHECK(x.int_less == mask_of([&](int l) { return x.i[l] < x.j[l]; }));
  CHECK(x.mask_same == x.m);
  CHECK(x.mask_and == (x.m & x.n));
  CHECK(x.mask_or == (x.m | x.n));
  CHECK(x.mask_not == (~x.m & 0xFFFF));
  CHECK(x.mask_none == 0);
  CHECK(x.mask_all == 0xFFFF);
}

void check_quadwords(const FacadeBlock& x) {
  for (int l = 0; l < 4; ++l) {
    CHECK(x.u4_and[l] == (x.p[l] & x.q[l]));
    CHECK(x.u4_or[l] == (x.p[l] | x.q[l]));
    CHECK(x.u4_splat[l] == x.p[2]);
  }
  CHECK(x.u4_equal == mask_of([&](int l) { return x.p[l] == x.q[l]; }, 4));
  CHECK(x.u4_equal_self == 0xF);
}

void check_direct(const FacadeBlock& x) {
  std::vector<int> lanes;
  for (int l = 0; l < 16; ++l)
    if ((x.m >> l & 1) != 0) lanes.push_back(l);
  const int count = static_cast<int>(lanes.size());
  CHECK(same_floats(x.picked, [&](int l) { return x.a[x.j[l] & 15]; }));
  CHECK(same_ints(x.int_picked, [&](int l) { return x.i[x.j[l] & 15]; }));
  CHECK(same_ints(x.gathered, [&](int l) { return x.i[x.j[l] & 15]; }));
  CHECK(same_ints(x.lane_numbers, [&](int l) { return l < count ? lanes[l] : 0; }));
  std::uint32_t spread = 0;
  for (int k = 0; k < count; ++k)
    spread |= (x.n >> k & 1) << lanes[k];
  CHECK(x.spread == spread);
  CHECK(std::memcmp(x.stored + 5, x.a, sizeof x.a) == 0);
  CHECK(std::memcmp(x.int_stored + 3, x.i, sizeof x.i) == 0);
}

} // namespace

TEST_CASE("The SIMD facade computes on every SPU type what plain C++ does") {
  for (const auto& machine : machines()) {
    std::vector<FacadeBlock> blocks = operands();
    const FacadeTask task = {to_ea(blocks.data()), static_cast<uint32_t>(blocks.size()), 0};
    machine->start(0, facade_program(), to_ea(&task));
    machine->wait(0);
    INFO(machine->spu_key());
    for (const FacadeBlock& x : blocks) {
      check_floats(x);
      check_row_sums(x);
      check_ints(x);
      check_masks(x);
      if (machine->direct_memory()) check_direct(x);
      check_quadwords(x);
    }
  }
}
