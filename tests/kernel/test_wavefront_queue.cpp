// The mechanism of wavefront queues, with kinds of work that only note what they are asked to do.
#include "direct_spu.hpp"
#include "kernel/direct/wavefront_queue.hpp"
#include "lanes.hpp"
#include "soups.hpp"

#include <catch2/catch.hpp>

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

struct Work {
  std::uint32_t key;
  std::vector<std::uint32_t> numbers;
};
using Done = std::vector<Work>;

/// Lanes that bring a number each.
template <std::uint32_t kAllKeys, std::uint32_t kCapacity, bool kOldest = false, bool kMixed = false>
struct Numbers : WorkKind {
  using Source = WordLanes;
  static constexpr std::uint32_t kKeys = kAllKeys, kPackets = kCapacity;
  static constexpr bool kOldestFirst = kOldest, kMixesKeys = kMixed;

  WordLanes number;
  std::uint32_t begun; ///< bits of lanes that have come since begin()

  void begin() { begun = 0; }
  void put(const WordLanes& from, std::uint32_t lanes, std::uint32_t to) {
    for_each_lane(lanes, [&](std::uint32_t lane) {
      REQUIRE(to < kSimdLanes);
      begun |= 1u << to;
      copy_lane(from, lane, number, to++);
    });
  }
  const WordLanes& source() const { return number; }
  std::size_t run(std::uint32_t key, std::uint32_t lanes, Done& done) const {
    REQUIRE(lanes == begun);
    done.push_back({key, {}});
    for_each_lane(lanes, [&](std::uint32_t lane) { done.back().numbers.push_back(number.lane[lane]); });
    return done.back().numbers.size();
  }
};

/// A queue, and all that has been pushed into it.
template <class Kind> struct Pushed {
  std::vector<Kind> packets = std::vector<Kind>(Kind::kPackets);
  WavefrontQueue<Kind> queue{packets.data()};
  Random random{21};
  std::uint32_t next = 0;
  std::vector<std::vector<std::uint32_t>> of_key = std::vector<std::vector<std::uint32_t>>(Kind::kKeys);
  Done done;

  void push(std::uint32_t key, std::uint32_t lanes) {
    WordLanes numbers = {};
    for_each_lane(lanes, [&](std::uint32_t lane) {
      of_key[key].push_back(next);
      numbers.lane[lane] = next++;
    });
    queue.push(key, lanes, numbers, done);
  }
  void push_some() { push(random.below(Kind::kKeys), random.word() & random.word() & 0xFFFF); }
  /// The numbers that have been worked on, in the order of the work.
  std::vector<std::uint32_t> worked(std::uint32_t key) const {
    std::vector<std::uint32_t> all;
    for (const Work& work : done)
      if (work.key == key) all.insert(all.end(), work.numbers.begin(), work.numbers.end());
    return all;
  }
};

} // namespace

TEST_CASE(
    "A queue runs the body for each packet that is full, with lanes in their order, and flushes the rest") {
  Pushed<Numbers<3, 3>> pushed;
  for (int round = 0; round < 10; ++round) {
    for (int step = 0; step < 200; ++step) {
      pushed.push_some();
      CHECK(pushed.queue.has_room());
      CHECK_FALSE(pushed.queue.has_full());
    }
    for (const Work& work : pushed.done)
      REQUIRE(work.numbers.size() == kSimdLanes);
    pushed.queue.flush(pushed.done);
    REQUIRE(pushed.queue.empty());
    for (std::uint32_t key = 0; key < 3; ++key) {
      REQUIRE(pushed.worked(key) == pushed.of_key[key]);
      pushed.of_key[key].clear();
    }
    pushed.done.clear();
    pushed.queue.flush(pushed.done);
    REQUIRE(pushed.done.empty());
  }
}

TEST_CASE("A queue takes apart lanes that fill one packet and begin another") {
  Pushed<Numbers<1, 1>> pushed;
  pushed.push(0, 0x0FFF);
  CHECK(pushed.done.empty());
  pushed.push(0, 0xFFFF);
  REQUIRE(pushed.done.size() == 1);
  pushed.queue.flush(pushed.done);
  REQUIRE(pushed.done.size() == 2);
  CHECK(pushed.done[1].numbers.size() == 12);
  CHECK(pushed.worked(0) == pushed.of_key[0]);
}

TEST_CASE("Full packets wait where there is room, and come before others: the oldest first") {
  Pushed<Numbers<1, 5, true>> pushed;
  while (pushed.queue.has_room())
    pushed.push_some();
  CHECK(pushed.next >= 4 * kSimdLanes);
  CHECK(pushed.done.empty());
  REQUIRE(pushed.queue.has_full());
  CHECK(pushed.queue.run_next(pushed.done) == kSimdLanes);
  CHECK(pushed.queue.has_room());
  for (int step = 0; step < 500; ++step) {
    if (pushed.queue.has_room()) pushed.push_some();
    if (pushed.queue.has_full() && pushed.random.below(3) == 0) pushed.queue.run_next(pushed.done);
  }
  pushed.queue.flush(pushed.done);
  CHECK(pushed.queue.empty());
  CHECK(pushed.worked(0) == pushed.of_key[0]);
}

TEST_CASE("The youngest of full packets comes first, and rests of several keys run together") {
  Pushed<Numbers<4, 12, false, true>> pushed;
  for (std::uint32_t key = 0; key < 4; ++key)
    pushed.push(key, 0xFFFF);
  for (const std::uint32_t lanes : {0x0003u, 0x01FFu, 0x007Fu, 0xF000u})
    pushed.push(lanes % 4 == 3 ? lanes == 0x0003 ? 0 : lanes == 0x01FF ? 1 : 2 : 3, lanes);
  for (std::uint32_t key = 4; key-- != 0;) {
    pushed.queue.run_next(pushed.done);
    CHECK(pushed.done.back().key == key);
  }
  CHECK_FALSE(pushed.queue.has_full());
  // Nine lanes, and with them the two of key 0; the seven of key 2 have no room, the four of key 3 do not
  // either.
  CHECK(pushed.queue.run_next(pushed.done) == 15);
  CHECK(pushed.queue.run_next(pushed.done) == 7);
  CHECK(pushed.queue.empty());
}

TEST_CASE("A queue gives each lane once whatever its order, and forgets all if it is told to") {
  Pushed<Numbers<8, 20, false, true>> pushed;
  for (int round = 0; round < 20; ++round) {
    std::set<std::uint32_t> inside;
    const std::uint32_t first = pushed.next;
    for (int step = 0; step < 300; ++step)
      if (pushed.queue.has_room() && pushed.random.below(3) != 0)
        pushed.push_some();
      else if (!pushed.queue.empty())
        pushed.queue.run_next(pushed.done);
    if (round % 4 == 3) {
      pushed.queue.clear();
      CHECK(pushed.queue.empty());
    } else {
      pushed.queue.flush(pushed.done);
      for (const Work& work : pushed.done)
        for (const std::uint32_t number : work.numbers)
          REQUIRE(inside.insert(number).second);
      CHECK(inside.size() == pushed.next - first);
    }
    pushed.done.clear();
  }
}
