#include "strip_world.hpp"

#include "celltrace/spe/types.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <unordered_map>

using namespace celltrace;
using celltrace::test::StripWorld;
using Doorbells = StripWorld::Doorbells;

namespace {

constexpr std::uint32_t kHalf = 1u << 15;
constexpr std::uint32_t kNearlyAll = (1u << 16) - 1;

/// Visits every state that a world can reach, by depth-first search.
class Exploration {
public:
  explicit Exploration(const StripWorld& start) { visit(start); }

  std::size_t states() const { return state_.size(); }
  unsigned fullest_mailbox() const { return fullest_mailbox_; }
  unsigned fullest_mailbox_at_end() const { return fullest_mailbox_at_end_; }

private:
  enum class Mark : char { on_path, left };

  void visit(const StripWorld& world) {
    const auto [place, fresh] = state_.emplace(world.key(), Mark::on_path);
    if (!fresh) {
      if (place->second == Mark::on_path) throw std::logic_error("the nodes can go round in circles");
      return;
    }
    fullest_mailbox_ = std::max(fullest_mailbox_, world.fullest_mailbox());
    fullest_mailbox_at_end_ = std::max(fullest_mailbox_at_end_, world.fullest_mailbox_at_end());
    const std::string key = place->first;
    const auto steps = world.possible_steps();
    if (steps.empty() && !world.done()) throw std::logic_error("the nodes got stuck");
    for (const StripWorld::Step step : steps) {
      StripWorld next = world;
      next.take(step);
      visit(next);
    }
    state_[key] = Mark::left;
  }

  std::unordered_map<std::string, Mark> state_;
  unsigned fullest_mailbox_ = 0;
  unsigned fullest_mailbox_at_end_ = 0;
};

/// Takes random steps to the end. Every node and kind of step has its own likelihood, so that some are very
/// slow.
void run_at_random(StripWorld& world, unsigned nodes, std::mt19937& random) {
  std::vector<double> likelihood(nodes * StripWorld::Step::kKinds);
  for (double& each : likelihood)
    each = std::pow(10.0, -static_cast<double>(random() % 4));
  for (unsigned taken = 0;; ++taken) {
    const auto steps = world.possible_steps();
    if (steps.empty()) break;
    if (taken > 200'000) throw std::logic_error("the frame does not end");
    std::vector<double> weights;
    for (const auto& step : steps)
      weights.push_back(likelihood[step.node * StripWorld::Step::kKinds + step.kind]);
    world.take(steps[std::discrete_distribution<std::size_t>(weights.begin(), weights.end())(random)]);
  }
  if (!world.done()) throw std::logic_error("the nodes got stuck");
}

} // namespace

TEST_CASE("no interleaving of two or three nodes loses a row or overfills a mailbox") {
  const auto strips = GENERATE(as<std::vector<std::uint32_t>>{}, std::vector<std::uint32_t>{4, 0},
                               std::vector<std::uint32_t>{0, 3}, std::vector<std::uint32_t>{3, 0, 0},
                               std::vector<std::uint32_t>{0, 3, 0}, std::vector<std::uint32_t>{2, 0, 2},
                               std::vector<std::uint32_t>{1, 3, 0});
  const auto lambda = GENERATE(kHalf, kNearlyAll);
  const unsigned frames = strips.size() == 2 ? 3 : 1;
  const Exploration exploration(StripWorld({strips, lambda, frames, Doorbells::before_later_words}));
  CHECK(exploration.states() > 100);
  CHECK(exploration.fullest_mailbox() <= kInboundMailboxEntries);
  CHECK(exploration.fullest_mailbox_at_end() <= 3);
}

TEST_CASE("no interleaving loses a row however late the doorbells are") {
  const auto strips = GENERATE(as<std::vector<std::uint32_t>>{}, std::vector<std::uint32_t>{3, 0},
                               std::vector<std::uint32_t>{2, 2}, std::vector<std::uint32_t>{0, 0, 2});
  const unsigned frames = strips.size() == 2 ? 2 : 1;
  const Exploration exploration(StripWorld({strips, kHalf, frames, Doorbells::any_time}));
  CHECK(exploration.states() > 100);
}

TEST_CASE("random interleavings of up to 17 nodes over several frames lose no row") {
  const auto doorbells = GENERATE(Doorbells::before_later_words, Doorbells::any_time);
  for (unsigned seed = 0; seed < 1000; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const unsigned nodes = 2 + random() % 16;
    std::vector<std::uint32_t> strips(nodes);
    for (auto& rows : strips)
      rows = random() % 3 != 0 ? 0 : random() % 20;
    const std::uint32_t lambda = 1 + random() % kNearlyAll;
    StripWorld world({strips, lambda, 4, doorbells});
    REQUIRE_NOTHROW(run_at_random(world, nodes, random));
    if (doorbells == Doorbells::any_time) continue;
    CHECK(world.fullest_mailbox() <= kInboundMailboxEntries);
    CHECK(world.fullest_mailbox_at_end() <= 3);
  }
}

TEST_CASE("rows reach the far end of the chain") {
  std::mt19937 random(1);
  StripWorld world({{64, 0, 0, 0}, kHalf, 1, Doorbells::before_later_words});
  std::vector<StripWorld::Step> steps;
  while (!(steps = world.possible_steps()).empty())
    world.take(steps[random() % steps.size()]);
  REQUIRE(world.done());
  for (const RowRange strip : world.strips())
    CHECK(strip.count >= 8);
}

TEST_CASE("an exchange parameter of 0 moves nothing") {
  std::mt19937 random(1);
  StripWorld world({{9, 0, 5}, 0, 2, Doorbells::before_later_words});
  run_at_random(world, 3, random);
  CHECK(world.strips()[0].count == 9);
  CHECK(world.strips()[1].count == 0);
  CHECK(world.strips()[2].count == 5);
}

TEST_CASE("a dry node asks on the edge of colour 0 first, then waits") {
  const auto id = GENERATE(1u, 2u);
  StripNode node(id, 4);
  node.begin_frame(0, {0, 0}, kHalf);
  const StripAction ask = node.next_action();
  CHECK(ask.kind == StripAction::Kind::send_word);
  CHECK(ask.neighbour == (id == 1 ? 0u : 3u));
  CHECK(ask.doorbell == 1u << id);
  CHECK(strip_word::rows(ask.word).empty());
  CHECK(strip_word::from_upper(ask.word) == (id == 1));
  CHECK(node.waiting());
  CHECK(node.next_action().kind == StripAction::Kind::none);
}

TEST_CASE("both sides of an exchange compute the same boundary") {
  StripNode lower(0, 2), upper(1, 2);
  lower.begin_frame(2, {10, 8}, kHalf);
  upper.begin_frame(2, {0, 0}, kHalf);
  lower.on_word(upper.next_action().word);
  CHECK(lower.remaining().first == 10);
  CHECK(lower.remaining().count == 4);
  upper.on_word(lower.next_action().word);
  CHECK(upper.remaining().first == 14);
  CHECK(upper.remaining().count == 4);
}

TEST_CASE("a node is idle when it was refused everywhere and its last row is complete, and says so once") {
  StripNode node(0, 2);
  node.begin_frame(0, {3, 1}, kHalf);
  std::uint32_t row = 0;
  REQUIRE(node.take_row(row));
  CHECK(row == 3);
  CHECK(node.next_action().kind == StripAction::Kind::send_word);
  node.on_word(strip_word::make(0, true, {4, 1}));
  CHECK(node.next_action().kind == StripAction::Kind::none);
  node.complete_row();
  const StripAction report = node.next_action();
  CHECK(report.kind == StripAction::Kind::report_idle);
  CHECK(report.rows == 1);
  CHECK(node.next_action().kind == StripAction::Kind::none);
}

TEST_CASE("a single node is idle without asking anyone") {
  StripNode node(0, 1);
  node.begin_frame(0, {0, 0}, kHalf);
  CHECK(node.next_action().kind == StripAction::Kind::report_idle);
}

TEST_CASE("a refused neighbour is rung once when there are rows for it, and asks again without ringing") {
  StripNode node(1, 3);
  node.begin_frame(0, {0, 0}, kHalf);
  CHECK(node.next_action().neighbour == 0);
  node.on_word(strip_word::make(0, true, {0, 0}));
  CHECK(node.next_action().neighbour == 2);
  node.on_word(strip_word::make(0, false, {0, 4}));
  const StripAction ring = node.next_action();
  CHECK(ring.kind == StripAction::Kind::ring);
  CHECK(ring.neighbour == 2);
  CHECK(node.next_action().kind == StripAction::Kind::none);

  StripNode rung(2, 3);
  rung.begin_frame(0, {0, 0}, kHalf);
  rung.on_doorbell(ring.doorbell);
  CHECK(rung.next_action().doorbell != 0);
  rung.on_word(strip_word::make(0, false, {0, 0}));
  CHECK(rung.next_action().kind == StripAction::Kind::report_idle);
  rung.on_doorbell(ring.doorbell);
  const StripAction invited = rung.next_action();
  CHECK(invited.kind == StripAction::Kind::send_word);
  CHECK(invited.doorbell == 0);
}

TEST_CASE("words of other frames are dropped or kept for their frame") {
  StripNode node(0, 2);
  node.begin_frame(3, {0, 6}, kHalf);
  node.on_word(strip_word::make(2, true, {0, 0}));
  CHECK(node.next_action().kind == StripAction::Kind::none);
  CHECK(node.remaining().count == 6);
  node.end_frame();
  node.on_word(strip_word::make(3, true, {0, 0}));
  node.on_word(strip_word::make(0, true, {0, 0}));
  CHECK(node.next_action().kind == StripAction::Kind::none);
  node.begin_frame(4, {0, 6}, kHalf);
  CHECK(node.next_action().kind == StripAction::Kind::send_word);
  CHECK(node.remaining().count == 3);
}

TEST_CASE("a word keeps its fields at the ends of their ranges") {
  const std::uint32_t word = strip_word::make(7, true, {strip_word::kMaxRows - 1, strip_word::kMaxRows});
  CHECK_FALSE(strip_word::from_ppe(word));
  CHECK(strip_word::epoch(word) == 3);
  CHECK(strip_word::from_upper(word));
  CHECK(strip_word::rows(word).first == strip_word::kMaxRows - 1);
  CHECK(strip_word::rows(word).count == strip_word::kMaxRows);
}

TEST_CASE("even strips cover all rows") {
  const auto strips = even_strips(11, 4);
  REQUIRE(strips.size() == 4);
  CHECK(strips[0].count == 3);
  CHECK(strips[3].first == 9);
  CHECK(strips[3].count == 2);
}
