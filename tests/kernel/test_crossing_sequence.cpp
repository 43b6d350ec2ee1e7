// Crossings of rays with objects in the order in which they are handed out.
#include "kernel/primitives/crossing_sequence.hpp"
#include "lanes.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

F all(float value) {
  return F(value);
}

Crossings<Simd> pair(float near, float far, std::uint32_t near_hit, std::uint32_t far_hit) {
  Crossings<Simd> c;
  c.clear();
  c.near = all(near);
  c.far = all(far);
  c.near_hit = M::from_bits(near_hit);
  c.far_hit = M::from_bits(far_hit);
  return c;
}

float lane_of(const F& values, unsigned lane) {
  FloatLanes lanes;
  values.store(lanes.lane);
  return lanes.lane[lane];
}

/// Crosses each ray at every whole distance up to the number of its lane.
struct Steps {
  mutable unsigned asked = 0;

  void operator()(const FloatLanes& after, Crossings<Simd>& c) const {
    ++asked;
    FloatLanes near;
    std::uint32_t hit = 0;
    for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
      near.lane[lane] = std::floor(after.lane[lane]) + 1;
      if (near.lane[lane] <= static_cast<float>(lane)) hit |= 1u << lane;
    }
    c.clear();
    c.near = F::load(near.lane);
    c.near_hit = M::from_bits(hit);
  }
};

} // namespace

TEST_CASE("Pairs that a shape finds at once are handed out in turn, but for those of no ray") {
  CrossingSequence<Simd, false> sequence;
  sequence.pairs()[0] = pair(1, 2, 0, 0);
  sequence.pairs()[1] = pair(3, 4, 0x1, 0x8000);
  sequence.begin(2, false);
  const auto never = [](const FloatLanes&, Crossings<Simd>&) { FAIL("nothing goes on"); };
  REQUIRE(sequence.next(never));
  CHECK(lane_of(sequence.current().near, 0) == 3);
  CHECK(sequence.current().far_hit.bits() == 0x8000);
  CHECK(!sequence.next(never));

  sequence.begin(1, true); // its first pair has no crossing
  CHECK(!sequence.next(never));
}

TEST_CASE("A shape that goes on is asked for each ray's next crossings until there are none") {
  CrossingSequence<Simd, true> sequence;
  sequence.pairs()[0] = pair(0.5f, 0.75f, 0xFFFF, 0xFFFF);
  sequence.begin(1, true);
  const Steps steps;
  REQUIRE(sequence.next(steps));
  for (unsigned round = 1; round < kSimdLanes; ++round) {
    REQUIRE(sequence.next(steps));
    CHECK(sequence.current().near_hit.bits() == (0xFFFFu & ~((1u << round) - 1)));
    CHECK(lane_of(sequence.current().near, 15) == static_cast<float>(round));
    sequence.current().near_hit = M::none(); // a condition of CSG refuses them: they go on all the same
  }
  CHECK(!sequence.next(steps));
  CHECK(!sequence.next(steps));
}

TEST_CASE("Rays that have what they want are not asked again") {
  CrossingSequence<Simd, true> sequence;
  sequence.pairs()[0] = pair(0, 0, 0xFFFF, 0);
  sequence.begin(1, true);
  const Steps steps;
  REQUIRE(sequence.next(steps));
  sequence.end(0xFF00);
  REQUIRE(sequence.next(steps));
  CHECK(sequence.current().near_hit.bits() == 0x00FE);
  sequence.end(0x00FF);
  const unsigned asked = steps.asked;
  CHECK(!sequence.next(steps));
  CHECK(steps.asked == asked);

  // A shape that does not go on is asked for nothing.
  sequence.pairs()[0] = pair(0, 0, 0xFFFF, 0);
  sequence.begin(1, false);
  CHECK(sequence.next(steps));
  CHECK(!sequence.next(steps));
  CHECK(steps.asked == asked);
}

TEST_CASE("A shape that finds the same crossing again, or ever more, comes to an end") {
  CrossingSequence<Simd, true> sequence;
  sequence.pairs()[0] = pair(1, 1, 0xFFFF, 0);
  sequence.begin(1, true);
  const auto same = [](const FloatLanes&, Crossings<Simd>& c) { c = pair(1, 0.5f, 0xFFFF, 0xFFFF); };
  CHECK(sequence.next(same));
  CHECK(!sequence.next(same));

  sequence.pairs()[0] = pair(1, 1, 0x1, 0);
  sequence.begin(1, true);
  unsigned rounds = 0;
  const auto endless = [](const FloatLanes& after, Crossings<Simd>& c) {
    c = pair(after.lane[0] + 1, 0, 0xFFFF, 0);
  };
  while (sequence.next(endless) && rounds < 1000) {
    CHECK(sequence.current().near_hit.bits() == 0x1);
    ++rounds;
  }
  CHECK(rounds == 256);
}
