#include "strip_world.hpp"

#include "celltrace/spe/types.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <unordered_map>

using namespace celltrace;
using celltrace::test::StripWorld;
using Transport = StripWorld::Transport;

namespace {

constexpr std::uint32_t kHalf = 1u << 15;
constexpr std::uint32_t kNearlyAll = (1u << 16) - 1;

/// Visits every state that a world can reach, by depth-first search.
class Exploration {
public:
  explicit Exploration(const StripWorld& start) : most_words_(visit(start)) {}

  std::size_t states() const { return state_.size(); }
  unsigned fullest_mailbox() const { return fullest_mailbox_; }
  unsigned fullest_mailbox_at_end() const { return fullest_mailbox_at_end_; }
  /// Words that the nodes send on the most talkative of all ways to the end.
  unsigned most_words() const { return most_words_; }

private:
  struct State {
    bool left = false;
    unsigned most_words = 0; ///< from here to the end
  };

  unsigned visit(const StripWorld& world) {
    const auto [place, fresh] = state_.emplace(world.key(), State());
    if (!fresh) {
      if (!place->second.left) throw std::logic_error("the nodes can go round in circles");
      return place->second.most_words;
    }
    fullest_mailbox_ = std::max(fullest_mailbox_, world.fullest_mailbox());
    fullest_mailbox_at_end_ = std::max(fullest_mailbox_at_end_, world.fullest_mailbox_at_end());
    const std::string key = place->first;
    const auto steps = world.possible_steps();
    if (steps.empty() && !world.done()) throw std::logic_error("the nodes got stuck");
    State state{true, 0};
    for (const StripWorld::Step step : steps) {
      StripWorld next = world;
      next.take(step);
      const unsigned sent = next.words() - world.words();
      state.most_words = std::max(state.most_words, sent + visit(next));
    }
    state_[key] = state;
    return state.most_words;
  }

  std::unordered_map<std::string, State> state_;
  unsigned fullest_mailbox_ = 0;
  unsigned fullest_mailbox_at_end_ = 0;
  unsigned most_words_;
};

std::uint32_t sum(const std::vector<std::uint32_t>& strips) {
  return std::accumulate(strips.begin(), strips.end(), 0u);
}

/// What all frames together may send if `gifts` exchanges move units.
unsigned words_allowed(unsigned frames, std::size_t nodes, unsigned gifts) {
  return 8 * frames * static_cast<unsigned>(nodes) + 12 * gifts;
}
unsigned doorbells_allowed(unsigned frames, std::size_t nodes, unsigned gifts) {
  return 2 * frames * static_cast<unsigned>(nodes) + 4 * gifts;
}

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

TEST_CASE("no interleaving of two or three nodes loses a unit or overfills a mailbox") {
  const auto strips = GENERATE(as<std::vector<std::uint32_t>>{}, std::vector<std::uint32_t>{4, 0},
                               std::vector<std::uint32_t>{0, 3}, std::vector<std::uint32_t>{3, 0, 0},
                               std::vector<std::uint32_t>{0, 3, 0}, std::vector<std::uint32_t>{2, 0, 2},
                               std::vector<std::uint32_t>{1, 3, 0});
  const auto lambda = GENERATE(kHalf, kNearlyAll);
  const unsigned frames = strips.size() == 2 ? 3 : 1;
  const Exploration exploration(StripWorld({strips, lambda, frames, Transport::mailboxes}));
  CHECK(exploration.states() > 100);
  CHECK(exploration.fullest_mailbox() <= kInboundMailboxEntries);
  CHECK(exploration.fullest_mailbox_at_end() <= 3);
  CHECK(exploration.most_words() <= words_allowed(frames, strips.size(), frames * sum(strips)));
}

TEST_CASE("no interleaving loses a unit however late and in whatever order messages come") {
  struct Case {
    Transport transport;
    std::vector<std::uint32_t> strips;
    unsigned frames;
  };
  const auto [transport, strips, frames] =
      GENERATE(Case{Transport::late_doorbells, {3, 0}, 2}, Case{Transport::late_doorbells, {2, 2}, 2},
               Case{Transport::late_doorbells, {0, 0, 2}, 1}, Case{Transport::any_order, {5, 0}, 1},
               Case{Transport::any_order, {0, 2}, 2});
  const Exploration exploration(StripWorld({strips, kHalf, frames, transport}));
  CHECK(exploration.states() > 100);
  CHECK(exploration.most_words() <= words_allowed(frames, strips.size(), frames * sum(strips)));
}

TEST_CASE("random interleavings of 2 to 17 nodes over several frames lose no unit") {
  const auto transport = GENERATE(Transport::mailboxes, Transport::late_doorbells, Transport::any_order);
  for (unsigned seed = 0; seed < 1008; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const unsigned nodes = 2 + seed % 16;
    std::vector<std::uint32_t> strips(nodes);
    for (auto& units : strips)
      units = random() % 3 != 0 ? 0 : random() % 20;
    const std::uint32_t lambda = 1 + random() % kNearlyAll;
    StripWorld world({strips, lambda, 4, transport});
    REQUIRE_NOTHROW(run_at_random(world, nodes, random));
    CHECK(world.words() <= words_allowed(4, nodes, world.gifts()));
    CHECK(world.doorbells() <= doorbells_allowed(4, nodes, world.gifts()));
    CHECK(world.gifts() <= 4 * sum(strips));
    if (transport != Transport::mailboxes) continue;
    CHECK(world.fullest_mailbox() <= kInboundMailboxEntries);
    CHECK(world.fullest_mailbox_at_end() <= 3);
  }
}

TEST_CASE("units reach the far end of the chain") {
  std::mt19937 random(1);
  StripWorld world({{64, 0, 0, 0}, kHalf, 1, Transport::mailboxes});
  std::vector<StripWorld::Step> steps;
  while (!(steps = world.possible_steps()).empty())
    world.take(steps[random() % steps.size()]);
  REQUIRE(world.done());
  for (const UnitRange strip : world.strips())
    CHECK(strip.count >= 8);
}

TEST_CASE("an exchange parameter of 0 moves nothing") {
  std::mt19937 random(1);
  StripWorld world({{9, 0, 5}, 0, 2, Transport::mailboxes});
  run_at_random(world, 3, random);
  CHECK(world.strips()[0].count == 9);
  CHECK(world.strips()[1].count == 0);
  CHECK(world.strips()[2].count == 5);
  CHECK(world.words() == 0);
}

TEST_CASE("a dry node asks on the edge of colour 0 first, then waits") {
  const auto id = GENERATE(1u, 2u);
  StripNode node(id, 4);
  node.begin_frame(0, {0, 0}, kHalf);
  const StripAction ask = node.next_action();
  CHECK(ask.kind == StripAction::Kind::send_word);
  CHECK(ask.neighbour == (id == 1 ? 0u : 3u));
  CHECK(ask.doorbell == 1u << id);
  CHECK(strip_word::units(ask.word).empty());
  CHECK(strip_word::from_upper(ask.word) == (id == 1));
  CHECK(node.waiting());
  CHECK(node.next_action().kind == StripAction::Kind::none);
}

TEST_CASE("a node asks first on the edge that did not give the last time") {
  StripNode node(1, 3);
  node.begin_frame(0, {2, 0}, kHalf);
  CHECK(node.next_action().neighbour == 0);
  node.on_word(strip_word::make(0, 0, false, {0, 2}));
  std::uint32_t unit = 0;
  REQUIRE(node.take_unit(unit));
  CHECK(unit == 1);
  CHECK(node.next_action().neighbour == 2);
  node.on_word(strip_word::make(0, 0, true, {2, 2}));
  REQUIRE(node.take_unit(unit));
  CHECK(unit == 2);
  CHECK(node.next_action().neighbour == 0);
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

TEST_CASE("a node is idle when it was refused everywhere and its last unit is complete, and says so once") {
  StripNode node(0, 2);
  node.begin_frame(0, {3, 1}, kHalf);
  std::uint32_t unit = 0;
  REQUIRE(node.take_unit(unit));
  CHECK(unit == 3);
  CHECK(node.next_action().kind == StripAction::Kind::send_word);
  node.on_word(strip_word::make(0, 0, true, {4, 1}));
  CHECK(node.next_action().kind == StripAction::Kind::none);
  node.complete_unit();
  const StripAction report = node.next_action();
  CHECK(report.kind == StripAction::Kind::report_idle);
  CHECK(report.units == 1);
  CHECK(node.next_action().kind == StripAction::Kind::none);
}

TEST_CASE("a single node is idle without asking anyone") {
  StripNode node(0, 1);
  node.begin_frame(0, {0, 0}, kHalf);
  CHECK(node.next_action().kind == StripAction::Kind::report_idle);
}

TEST_CASE("a refused neighbour is rung once when there are units for it, and asks again without ringing") {
  StripNode node(1, 3);
  node.begin_frame(0, {0, 0}, kHalf);
  CHECK(node.next_action().neighbour == 0);
  node.on_word(strip_word::make(0, 0, true, {0, 0}));
  CHECK(node.next_action().neighbour == 2);
  node.on_word(strip_word::make(0, 0, false, {0, 4}));
  const StripAction ring = node.next_action();
  CHECK(ring.kind == StripAction::Kind::ring);
  CHECK(ring.neighbour == 2);
  CHECK(node.next_action().kind == StripAction::Kind::none);

  StripNode rung(2, 3);
  rung.begin_frame(0, {0, 0}, kHalf);
  rung.on_doorbell(ring.doorbell);
  CHECK(rung.next_action().doorbell != 0);
  rung.on_word(strip_word::make(0, 0, false, {0, 0}));
  CHECK(rung.next_action().kind == StripAction::Kind::report_idle);
  rung.on_doorbell(ring.doorbell);
  const StripAction invited = rung.next_action();
  CHECK(invited.kind == StripAction::Kind::send_word);
  CHECK(invited.doorbell == 0);
}

TEST_CASE("words of other frames are dropped or kept for their frame") {
  StripNode node(0, 2);
  node.begin_frame(3, {0, 6}, kHalf);
  node.on_word(strip_word::make(2, 0, true, {0, 0}));
  CHECK(node.next_action().kind == StripAction::Kind::none);
  CHECK(node.remaining().count == 6);
  node.end_frame();
  node.on_word(strip_word::make(3, 0, true, {0, 0}));
  node.on_word(strip_word::make(0, 0, true, {0, 0}));
  CHECK(node.next_action().kind == StripAction::Kind::none);
  node.begin_frame(4, {0, 6}, kHalf);
  CHECK(node.next_action().kind == StripAction::Kind::send_word);
  CHECK(node.remaining().count == 3);
}

TEST_CASE("a word that overtakes the one before it waits for it") {
  StripNode lower(0, 2), upper(1, 2);
  lower.begin_frame(0, {0, 2}, kHalf);
  upper.begin_frame(0, {2, 0}, kHalf);
  const std::uint32_t first = upper.next_action().word;
  lower.on_word(first);
  const std::uint32_t answer = lower.next_action().word;
  std::uint32_t unit = 0;
  REQUIRE(lower.take_unit(unit));
  const std::uint32_t question = lower.next_action().word;
  upper.on_word(question);
  CHECK(upper.remaining().empty());
  CHECK(upper.next_action().kind == StripAction::Kind::none);
  upper.on_word(answer);
  CHECK(upper.remaining().first == 1);
  CHECK(upper.remaining().count == 1);
  CHECK(upper.next_action().kind == StripAction::Kind::send_word);
}

TEST_CASE("a word keeps its fields at the ends of their ranges") {
  const std::uint32_t word = strip_word::make(7, 3, true, {strip_word::kMaxUnits - 1, strip_word::kMaxUnits});
  CHECK_FALSE(strip_word::from_ppe(word));
  CHECK(strip_word::parity(word) == 1);
  CHECK(strip_word::epoch(word) == 3);
  CHECK(strip_word::from_upper(word));
  CHECK(strip_word::units(word).first == strip_word::kMaxUnits - 1);
  CHECK(strip_word::units(word).count == strip_word::kMaxUnits);
}

TEST_CASE("the word that ends a frame is told from all others") {
  CHECK(strip_word::from_ppe(strip_word::frame_over(6)));
  CHECK(strip_word::epoch(strip_word::frame_over(6)) == 2);
  CHECK_FALSE(strip_word::from_ppe(strip_word::make(2, 1, true, {0, 0})));
}

TEST_CASE("even strips cover all units") {
  const auto strips = even_strips(11, 4);
  REQUIRE(strips.size() == 4);
  CHECK(strips[0].count == 3);
  CHECK(strips[3].first == 9);
  CHECK(strips[3].count == 2);
}
