// A chain of StripNodes with a PPE, in which every message waits until the test delivers it.
#pragma once

#include "celltrace/balance/strip.hpp"
#include "celltrace/balance/strip_tally.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace celltrace::test {

class StripWorld {
public:
  /// What may overtake what on the way from one node to another.
  enum class Transport {
    mailboxes,      ///< nothing: a doorbell comes before any later word, as on the Cell
    late_doorbells, ///< doorbells come whenever the test likes, words in their order
    any_order,      ///< words also overtake each other
  };
  struct Config {
    std::vector<std::uint32_t> strips; ///< units per node at the start of the first frame
    std::uint32_t lambda;
    unsigned frames;
    Transport transport;
  };
  struct Step {
    enum Kind { lower_word, upper_word, ppe_word, lower_bell, upper_bell, start, work };
    static constexpr int kKinds = 7;
    unsigned node;
    Kind kind;
    unsigned place = 0; ///< of the word among those that wait
  };

  explicit StripWorld(Config config)
      : config_(std::move(config)), seats_(config_.strips.size()), tally_(0, 0),
        strips_(config_.strips.size()) {
    for (unsigned id = 0; id < count(); ++id)
      nodes_.emplace_back(id, count());
    strips_ = consecutive_strips(config_.strips);
    units_ = strips_.back().first + strips_.back().count;
    start_frame();
  }

  std::vector<Step> possible_steps() const {
    std::vector<Step> steps;
    for (unsigned node = 0; node < count(); ++node) {
      for (int kind = 0; kind < Step::kKinds; ++kind) {
        Step step{node, static_cast<Step::Kind>(kind)};
        for (; possible(step); ++step.place)
          steps.push_back(step);
      }
    }
    return steps;
  }
  void take(Step step) {
    switch (step.kind) {
    case Step::lower_word:
    case Step::upper_word:
      deliver_word(step.node, step.kind == Step::upper_word, step.place);
      break;
    case Step::ppe_word:
      leave_frame(step.node);
      break;
    case Step::lower_bell:
    case Step::upper_bell:
      deliver_bell(step.node, step.kind == Step::upper_bell);
      break;
    case Step::start:
      enter_frame(step.node);
      break;
    case Step::work:
      work(step.node);
      break;
    }
    act(step.node);
    finish_frame();
  }

  bool done() const { return frame_ == config_.frames; }
  /// The most words that a mailbox held at once, ever and while a frame that was complete was not over
  /// everywhere.
  unsigned fullest_mailbox() const { return fullest_mailbox_; }
  unsigned fullest_mailbox_at_end() const { return fullest_mailbox_at_end_; }
  const std::vector<UnitRange>& strips() const { return strips_; }
  /// Since the first frame began: what the nodes sent, and exchanges that moved units.
  unsigned words() const { return words_; }
  unsigned doorbells() const { return doorbells_; }
  unsigned gifts() const { return gifts_; }

  /// Equal for worlds that behave alike from now on.
  std::string key() const {
    std::string bytes(reinterpret_cast<const char*>(nodes_.data()), nodes_.size() * sizeof(StripNode));
    for (const Seat& seat : seats_) {
      for (const auto& queue : seat.words) {
        bytes += static_cast<char>(queue.size());
        for (const std::uint32_t word : queue)
          bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
      }
      bytes +=
          {static_cast<char>(seat.bell[0]), static_cast<char>(seat.bell[1]), static_cast<char>(seat.finish),
           static_cast<char>(seat.start), static_cast<char>(seat.working)};
    }
    bytes.append(taken_.begin(), taken_.end());
    bytes += static_cast<char>(frame_);
    bytes += static_cast<char>(finishing_);
    for (unsigned node = 0; node < count(); ++node)
      bytes += static_cast<char>(reported_[node]);
    return bytes;
  }

private:
  /// What lies in front of a node. Words and bells by the side they come from: 0 lower, 1 upper neighbour.
  struct Seat {
    std::array<std::vector<std::uint32_t>, 2> words;
    std::array<bool, 2> bell{};
    bool finish = false; ///< the PPE's word in the mailbox
    bool start = false;
    bool working = false; ///< a unit has been taken and not completed
  };

  unsigned count() const { return static_cast<unsigned>(seats_.size()); }

  bool possible(Step step) const {
    const Seat& seat = seats_[step.node];
    switch (step.kind) {
    case Step::lower_word:
    case Step::upper_word:
      return word_waits(seat, step.kind == Step::upper_word, step.place);
    default:
      return step.place == 0 && possible_at(step.node, step.kind);
    }
  }
  bool word_waits(const Seat& seat, unsigned side, unsigned place) const {
    return place < seat.words[side].size() && (place == 0 || config_.transport == Transport::any_order);
  }
  bool possible_at(unsigned node, Step::Kind kind) const {
    const Seat& seat = seats_[node];
    switch (kind) {
    case Step::ppe_word:
      return seat.finish;
    case Step::lower_bell:
      return seat.bell[0];
    case Step::upper_bell:
      return seat.bell[1];
    case Step::start:
      return seat.start;
    case Step::work:
      return seat.working || !nodes_[node].remaining().empty();
    default:
      return false;
    }
  }

  /// A node that cares for its mailbox empties it first.
  void enter_frame(unsigned node) {
    seats_[node].start = false;
    for (unsigned side = 0; config_.transport == Transport::mailboxes && side < 2; ++side) {
      while (!seats_[node].words[side].empty())
        deliver_word(node, side, 0);
    }
    nodes_[node].begin_frame(frame_, strips_[node], config_.lambda);
  }
  void deliver_word(unsigned node, unsigned side, unsigned place) {
    Seat& seat = seats_[node];
    if (config_.transport == Transport::mailboxes) {
      for (unsigned each = 0; each < 2; ++each)
        deliver_bell(node, each);
    }
    const auto at = seat.words[side].begin() + place;
    const std::uint32_t word = *at;
    seat.words[side].erase(at);
    const std::uint32_t before = nodes_[node].remaining().count;
    nodes_[node].on_word(word);
    if (nodes_[node].remaining().count > before) ++gifts_;
  }
  void deliver_bell(unsigned node, unsigned side) {
    if (!seats_[node].bell[side]) return;
    seats_[node].bell[side] = false;
    const unsigned neighbour = side == 0 ? node - 1 : node + 1;
    nodes_[node].on_doorbell(1u << neighbour % 32);
  }
  void work(unsigned node) {
    Seat& seat = seats_[node];
    if (seat.working) {
      nodes_[node].complete_unit();
      seat.working = false;
      return;
    }
    std::uint32_t unit = 0;
    if (!nodes_[node].take_unit(unit)) throw std::logic_error("no unit where one remained");
    if (unit >= units_ || taken_[unit]++ != 0) throw std::logic_error("a unit was taken twice");
    seat.working = true;
  }

  void act(unsigned node) {
    for (;;) {
      const StripAction action = nodes_[node].next_action();
      if (action.kind == StripAction::Kind::none) return;
      if (action.kind == StripAction::Kind::report_idle) {
        tally_.report(node, action.units);
        reported_[node] = static_cast<int>(action.units);
        continue;
      }
      send(node, action);
    }
  }
  void send(unsigned node, const StripAction& action) {
    if (action.neighbour != node + 1 && action.neighbour + 1 != node)
      throw std::logic_error("not a neighbour");
    Seat& to = seats_.at(action.neighbour);
    const unsigned side = action.neighbour > node ? 0 : 1;
    if (action.doorbell != 0) {
      if (action.doorbell != 1u << node % 32) throw std::logic_error("wrong doorbell");
      to.bell[side] = true;
      ++doorbells_;
    }
    if (action.kind == StripAction::Kind::send_word) {
      if (strip_word::from_ppe(action.word)) throw std::logic_error("word of the PPE");
      to.words[side].push_back(action.word);
      ++words_;
      measure_mailbox(to);
    }
  }
  void measure_mailbox(const Seat& seat) {
    const auto words = static_cast<unsigned>(seat.words[0].size() + seat.words[1].size() + seat.finish);
    fullest_mailbox_ = std::max(fullest_mailbox_, words);
    if (finishing_) fullest_mailbox_at_end_ = std::max(fullest_mailbox_at_end_, words);
  }

  void start_frame() {
    tally_ = StripTally(count(), units_);
    taken_.assign(units_, 0);
    reported_.assign(count(), -1);
    for (Seat& seat : seats_)
      seat.start = true;
    finishing_ = false;
  }
  void finish_frame() {
    if (finishing_ || done() || !tally_.frame_complete()) return;
    finishing_ = true;
    for (const char taken : taken_) {
      if (taken != 1) throw std::logic_error("a unit was lost");
    }
    for (Seat& seat : seats_) {
      if (seat.working) throw std::logic_error("the frame ended before its last unit was complete");
      seat.finish = true;
      measure_mailbox(seat);
    }
    strips_ = tally_.next_strips();
  }
  /// The node reads the PPE's word. The last one makes the PPE start the next frame.
  void leave_frame(unsigned node) {
    seats_[node].finish = false;
    nodes_[node].end_frame();
    for (const Seat& seat : seats_) {
      if (seat.finish) return;
    }
    ++frame_;
    if (!done()) start_frame();
  }

  Config config_;
  std::vector<StripNode> nodes_;
  std::vector<Seat> seats_;
  StripTally tally_;
  std::vector<UnitRange> strips_;
  std::uint32_t units_ = 0;
  unsigned frame_ = 0;
  bool finishing_ = false;
  std::vector<char> taken_;
  std::vector<int> reported_;
  unsigned fullest_mailbox_ = 0;
  unsigned fullest_mailbox_at_end_ = 0;
  unsigned words_ = 0;
  unsigned doorbells_ = 0;
  unsigned gifts_ = 0;
};

} // namespace celltrace::test
