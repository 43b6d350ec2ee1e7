// Balances the work of a frame between the nodes of a chain while the work is being done, by the generalized
// dimension exchange of Xu and Lau. It runs asynchronously: a node that runs out of work starts an exchange
// with a neighbour. StripNode is the state machine of one node, without clock, thread or transport.
// Freestanding C++17 (kernel dialect).
//
// Work comes in numbered units, which should cost about the same. A node owns the units [first, first +
// count), which it has not taken yet. Remaining units are ordered along the chain: every unit of node i lies
// before every unit of node j > i; units in the gaps between nodes have been taken.
//
// An exchange on the edge between two neighbours is one word from each neighbour to the other; the k-th word
// of one neighbour pairs with the k-th word of the other. A word says which units the sender has left. From
// the two words both nodes compute the same new boundary: if exactly one node is empty, it gets the nearest
// floor(lambda * remaining) units of the other; otherwise nothing moves. Because of the pairing no unit is
// lost or given twice, however words are delayed.
//
// - A node that is dry (has no units) asks on one edge at a time: first on its edge of colour 0 (the edge
//   above an even node), later first on the edge that did not give the last time. The node rings the
//   neighbour's doorbell, sends its word and waits for the neighbour's word. It stays dry until the
//   neighbour's word has come, so its own word remains true. A word from a neighbour that asked at the same
//   moment counts as an answer.
// - A node that is asked answers at once; the exchange is complete on its side.
// - A node that refused a neighbour rings the neighbour's doorbell as soon as it has units to give. A
//   doorbell invites a dry node that was refused to ask on this edge again. At any other time a doorbell is
//   ignored, so that late, merged and superfluous doorbells do no harm. A node that asks by invitation does
//   not ring, or two dry nodes could keep each other busy.
// - A dry node that was refused on every edge is idle and reports the number of units it has completed. It
//   reports again later if units come by an invitation. The frame is complete when every node has reported
//   and the reports add up.
//
// A node keeps at least one of its units, and takes this unit before it asks, so that frames end. In a frame
// of u units, n nodes send at most 4 n + 8 g words for g <= u exchanges that move units, and no more
// doorbells than words.
//
// Transport. Words and doorbells may come late and in any order. A word carries the parity of its number on
// its edge, which suffices because a neighbour is never more than one word ahead. It also carries the epoch
// of its frame: a word of an earlier frame is dropped, and a word from a neighbour that is a frame ahead is
// kept until begin_frame(). No word may take longer than two frames. A doorbell is a bit (Cell: signal
// notification 2 in logical-OR mode); unread doorbells of one sender merge.
//
// The four entries of a mailbox suffice if words keep their order (Cell: inbound mailbox), if a doorbell is
// delivered before any later word of the same node, and if the owner passes delivered doorbells to
// on_doorbell() before each word. Then at most 2 words from each neighbour wait for a node during a frame,
// and 1 once the frame is complete, besides the two questions of the next frame, or the PPE's word that ends
// this frame. Besides, the PPE must start a frame only after every node has left the frame before; after a
// frame that was broken off, every mailbox must be drained before the next frame starts.
#pragma once

#include <stdint.h>

namespace celltrace {

/// Consecutive units [first, first + count).
struct UnitRange {
  uint32_t first;
  uint32_t count;

  constexpr bool empty() const { return count == 0; }
};

/// The 32-bit words of the mailboxes: a word of an exchange, or the PPE's word that ends a frame, whose
/// `first` is kMaxUnits.
///   31 parity | 30..29 epoch | 28 sender is the upper neighbour | 27..14 remaining | 13..0 first unit
namespace strip_word {

/// Units are numbered 0 .. kMaxUnits - 1.
constexpr uint32_t kMaxUnits = (1u << 14) - 1;
/// Number of epochs: the epoch of a frame is its number modulo kEpochs.
constexpr uint32_t kEpochs = 4;

constexpr uint32_t make(uint32_t epoch, uint32_t parity, bool from_upper, UnitRange units) {
  return (parity & 1u) << 31 | (epoch & (kEpochs - 1)) << 29 | (from_upper ? 1u << 28 : 0u) |
         units.count << 14 | units.first;
}
constexpr uint32_t frame_over(uint32_t epoch) {
  return make(epoch, 0, false, {kMaxUnits, 0});
}
constexpr bool from_ppe(uint32_t word) {
  return (word & kMaxUnits) == kMaxUnits;
}
constexpr uint32_t parity(uint32_t word) {
  return word >> 31;
}
constexpr uint32_t epoch(uint32_t word) {
  return word >> 29 & (kEpochs - 1);
}
constexpr bool from_upper(uint32_t word) {
  return (word >> 28 & 1u) != 0;
}
constexpr UnitRange units(uint32_t word) {
  return {word & kMaxUnits, word >> 14 & kMaxUnits};
}

} // namespace strip_word

/// Returns the units that a dry node gets from a neighbour that has `remaining`. `lambda`: the exchange
/// parameter in units of 2^-16.
constexpr uint32_t strip_gift(uint32_t remaining, uint32_t lambda) {
  return remaining * lambda >> 16;
}

/// The next thing that the owner of a StripNode has to do.
struct StripAction {
  enum class Kind : uint32_t {
    none,        ///< nothing to send: take a unit, or wait for a word or a doorbell
    send_word,   ///< send the neighbour `word`; before, unless `doorbell` is 0, ring the neighbour with it
    ring,        ///< ring the neighbour with `doorbell`
    report_idle, ///< tell the PPE that this node is idle and has completed `units` in this frame
  };
  Kind kind;
  uint32_t neighbour; ///< id of the node to send to or to ring
  uint32_t word;
  uint32_t doorbell; ///< bits to OR into the neighbour's doorbell register
  uint32_t units;
};

/// Node `id` of a chain of `count` nodes. Not thread safe; copyable.
class StripNode {
public:
  /// Makes a node outside of any frame. `id` < `count`.
  StripNode(uint32_t id, uint32_t count)
      : id_(id), lambda_(0), epoch_(kNoFrame), in_frame_(0), taken_(0), completed_(0),
        reported_(kNeverReported) {
    units_ = UnitRange{0, 0};
    edges_[kLower] = make_edge(id != 0);
    edges_[kUpper] = make_edge(id + 1 != count);
  }

  /// Starts a frame. `epoch`: the frame's number modulo 4, the same for all nodes. `units`: the units that
  /// this node has at first. `lambda`: exchange parameter in units of 2^-16, 0..65535; 0: no node asks and no
  /// unit moves, so that kMaxUnits does not apply. Handles words of this frame that came early.
  void begin_frame(uint32_t epoch, UnitRange units, uint32_t lambda) {
    epoch_ = epoch & (strip_word::kEpochs - 1);
    in_frame_ = 1;
    lambda_ = lambda;
    units_ = units;
    first_side_ = (id_ & 1u) == 0 ? kUpper : kLower;
    taken_ = 0;
    completed_ = 0;
    reported_ = kNeverReported;
    for (Edge& edge : edges_)
      begin_frame_on(edge);
  }
  /// Leaves the frame: from now on the node sends nothing and drops words of this frame.
  void end_frame() {
    in_frame_ = 0;
    units_ = UnitRange{0, 0};
    for (Edge& edge : edges_) {
      edge.question = Question::open;
      edge.has_answer = 0;
      edge.neighbour_hungry = 0;
      edge.has_early_word = 0;
    }
  }

  /// Takes the first remaining unit. Returns false if there is none at the moment.
  bool take_unit(uint32_t& unit) {
    if (units_.empty()) return false;
    unit = units_.first;
    ++units_.first;
    --units_.count;
    ++taken_;
    return true;
  }
  /// Counts the unit that was taken last as completed. Until then the node may ask for units, but does not
  /// report that it is idle.
  void complete_unit() { ++completed_; }

  /// Handles a word of a neighbour; strip_word::from_ppe(word) must be false. Call next_action() afterwards
  /// until it returns `none`.
  void on_word(uint32_t word) {
    Edge& edge = edges_[strip_word::from_upper(word) ? kUpper : kLower];
    if (!edge.exists) return;
    if (!in_frame_) {
      if (may_be_next(strip_word::epoch(word))) keep(edge, word);
    } else if (strip_word::epoch(word) == epoch_) {
      on_word_of_frame(edge, word);
    }
  }
  /// Handles the bits of the doorbell register. Call next_action() afterwards until it returns `none`.
  void on_doorbell(uint32_t bits) {
    for (uint32_t side = 0; side < 2; ++side) {
      Edge& edge = edges_[side];
      const bool rung = (bits >> (neighbour(side) & 31u) & 1u) != 0;
      if (rung && edge.question == Question::refused) edge.question = Question::invited;
    }
  }

  /// Returns the next action, which the caller must carry out. Answers come first, so that no neighbour waits
  /// for this node's questions.
  StripAction next_action() {
    for (uint32_t side = 0; side < 2; ++side) {
      if (edges_[side].has_answer) return answer(side);
    }
    for (uint32_t side = 0; side < 2; ++side) {
      if (edges_[side].neighbour_hungry && can_give()) return ring(side);
    }
    if (in_frame() && units_.empty() && !waiting()) return next_action_when_dry();
    return nothing();
  }

  UnitRange remaining() const { return units_; }
  /// Returns the number of units completed in this frame.
  uint32_t completed() const { return completed_; }
  bool in_frame() const { return in_frame_ != 0; }
  /// Returns true if a question of this node is unanswered.
  bool waiting() const {
    return edges_[kLower].question == Question::waiting || edges_[kUpper].question == Question::waiting;
  }

private:
  static constexpr uint32_t kLower = 0;
  static constexpr uint32_t kUpper = 1;
  static constexpr uint32_t kNoFrame = strip_word::kEpochs;
  static constexpr uint32_t kNeverReported = ~0u;

  /// The state of this node's question on an edge since it ran dry. On a node that has units all questions
  /// are open.
  enum class Question : uint32_t { open, waiting, refused, invited };

  struct Edge {
    uint32_t exists;
    Question question;
    uint32_t neighbour_hungry; ///< this node refused the neighbour, and has not rung it since
    uint32_t has_answer;
    uint32_t answer;
    uint32_t sent;     ///< words sent in this frame
    uint32_t received; ///< words received in order in this frame
    uint32_t has_early_word;
    uint32_t early_word; ///< the word after the next word; between frames, a word of the next frame
  };

  static Edge make_edge(bool exists) { return {exists ? 1u : 0u, Question::open, 0, 0, 0, 0, 0, 0, 0}; }
  static StripAction nothing() { return {StripAction::Kind::none, 0, 0, 0, 0}; }

  uint32_t neighbour(uint32_t side) const { return side == kLower ? id_ - 1 : id_ + 1; }
  uint32_t own_doorbell() const { return 1u << (id_ & 31u); }
  bool can_give() const { return strip_gift(units_.count, lambda_) != 0; }
  bool may_be_next(uint32_t epoch) const {
    return epoch_ == kNoFrame || epoch == ((epoch_ + 1) & (strip_word::kEpochs - 1));
  }
  /// Returns this node's next word on the edge. The node is the upper neighbour of its lower neighbour.
  uint32_t next_word(Edge& edge) {
    return strip_word::make(epoch_, edge.sent++, &edge == &edges_[kLower],
                            units_.empty() ? UnitRange{0, 0} : units_);
  }

  void begin_frame_on(Edge& edge) {
    edge.question = Question::open;
    edge.neighbour_hungry = 0;
    edge.has_answer = 0;
    edge.sent = 0;
    edge.received = 0;
    const bool early = edge.has_early_word && strip_word::epoch(edge.early_word) == epoch_;
    edge.has_early_word = 0;
    if (early) on_word_of_frame(edge, edge.early_word);
  }

  static void keep(Edge& edge, uint32_t word) {
    edge.early_word = word;
    edge.has_early_word = 1;
  }
  void on_word_of_frame(Edge& edge, uint32_t word) {
    if (strip_word::parity(word) != (edge.received & 1u)) return keep(edge, word);
    for (;;) {
      exchange(edge, strip_word::units(word));
      if (!edge.has_early_word) return;
      edge.has_early_word = 0;
      word = edge.early_word;
    }
  }
  /// Handles the neighbour's next word. Makes this node's word as the answer, unless it was already sent as a
  /// question.
  void exchange(Edge& edge, UnitRange other) {
    ++edge.received;
    if (edge.question != Question::waiting) {
      edge.answer = next_word(edge);
      edge.has_answer = 1;
    }
    const uint32_t moved = settle(edge, other);
    edge.neighbour_hungry = other.empty() && moved == 0 ? 1u : 0u;
  }
  /// Moves the boundary between this node and its neighbour, which moves it, too. Returns the number of units
  /// that changed hands.
  uint32_t settle(Edge& edge, UnitRange other) {
    if (units_.empty()) return receive(edge, other);
    return other.empty() ? give(edge) : 0;
  }
  uint32_t receive(Edge& edge, UnitRange other) {
    const uint32_t moved = strip_gift(other.count, lambda_);
    if (moved == 0) {
      edge.question = Question::refused;
      return 0;
    }
    const bool from_tail = &edge == &edges_[kLower];
    first_side_ = from_tail ? kUpper : kLower;
    units_ = UnitRange{from_tail ? other.first + other.count - moved : other.first, moved};
    for (Edge& each : edges_)
      each.question = Question::open;
    return moved;
  }
  uint32_t give(const Edge& edge) {
    const uint32_t moved = strip_gift(units_.count, lambda_);
    if (&edge == &edges_[kLower]) units_.first += moved;
    units_.count -= moved;
    return moved;
  }

  StripAction answer(uint32_t side) {
    edges_[side].has_answer = 0;
    return {StripAction::Kind::send_word, neighbour(side), edges_[side].answer, 0, 0};
  }
  StripAction ring(uint32_t side) {
    edges_[side].neighbour_hungry = 0;
    return {StripAction::Kind::ring, neighbour(side), 0, own_doorbell(), 0};
  }
  StripAction next_action_when_dry() {
    const uint32_t in_turn[2] = {first_side_, 1u - first_side_};
    for (uint32_t side : in_turn) {
      if (may_ask(side, Question::open)) return ask(side, own_doorbell());
    }
    for (uint32_t side : in_turn) {
      if (may_ask(side, Question::invited)) return ask(side, 0);
    }
    return taken_ == completed_ && reported_ != completed_ ? report() : nothing();
  }
  bool may_ask(uint32_t side, Question question) const {
    return edges_[side].exists && edges_[side].question == question && lambda_ != 0;
  }
  StripAction ask(uint32_t side, uint32_t doorbell) {
    edges_[side].question = Question::waiting;
    return {StripAction::Kind::send_word, neighbour(side), next_word(edges_[side]), doorbell, 0};
  }
  StripAction report() {
    reported_ = completed_;
    return {StripAction::Kind::report_idle, 0, 0, 0, completed_};
  }

  uint32_t id_;
  uint32_t lambda_;
  uint32_t epoch_; ///< epoch of this frame or the last one; kNoFrame before the first
  uint32_t in_frame_;
  UnitRange units_;
  uint32_t first_side_; ///< side of the edge on which the node asks next
  uint32_t taken_;
  uint32_t completed_;
  uint32_t reported_;
  Edge edges_[2];
};

} // namespace celltrace
