// Balancing the rows of a frame between the nodes of a chain while it is being rendered: the generalized
// dimension exchange of Xu and Lau, run asynchronously and in pairs by whoever runs out of work. The state
// machine of one node, without clock, thread or transport. Freestanding C++17 (kernel dialect).
//
// A node owns the rows [first, first + count) that it has not taken yet. Remaining rows are ordered along the
// chain: every row of node i lies before every row of node j > i; the gaps between them have been taken.
//
// An exchange on the edge between two neighbours is one word from each to the other; the k-th word of one
// pairs with the k-th word of the other. A word is the sender's remaining rows. From the two words both
// compute the same new boundary: if exactly one of them is empty it gets floor(lambda * remaining) rows of
// the other, those that lie next to it; otherwise nothing moves. The words order everything that matters, so
// that no row is lost or given twice however they are delayed.
//
// - A node asks when it is dry: one edge at a time, edges of colour 0 (those above an even node) first. It
//   rings the neighbour's doorbell, sends its word and waits for the neighbour's. It stays dry until that
//   word has come, so what it said remains true. A word from a neighbour that asked at the same moment is
//   as good as an answer.
// - A node that is asked answers at once; the exchange is complete on its side.
// - A node that saw its neighbour go away empty-handed rings the neighbour's doorbell as soon as it has rows
//   to give. A doorbell invites a dry node that was refused to ask on that edge again; at any other time it
//   means nothing, so that late, merged and superfluous doorbells do no harm. An invited question is not
//   rung for, or two dry nodes could keep each other busy.
// - A dry node that was refused on every edge is idle and reports the rows it has completed. Rows may still
//   come by an invitation; then it reports again. The frame is complete when every node has reported and
//   the reports add up.
//
// A node gives away at most all but one of its rows, and takes that one before it asks: frames end.
//
// Transport. Words go from node to node in order (Cell: inbound mailbox) and wear the frame's epoch, so that
// words that outlived their frame are dropped, and words of a neighbour that is a frame ahead are kept until
// begin_frame(). Doorbells are bits that merge (Cell: signal notification 2 in logical-OR mode). If a
// doorbell is delivered before any later word of the same node, and doorbells that have been delivered are
// handed in before each word, a node that reads nothing has at most 2 words under way from each neighbour
// during a frame, and 1 once the frame is complete: with the two questions of the next frame, or with the
// PPE's word that ends this one, the four entries of a mailbox suffice. This holds if the PPE starts a frame
// only after every node has left the one before; a frame that is broken off early also needs every mailbox
// drained before the next one starts.
#pragma once

#include <stdint.h>

namespace celltrace {

/// Consecutive rows [first, first + count).
struct RowRange {
  uint32_t first;
  uint32_t count;

  constexpr bool empty() const { return count == 0; }
};

/// The 32-bit words of the mailboxes: the word of an exchange, and words of the PPE, which are told apart by
/// bit 31.
///   31 from the PPE | 30..29 epoch | 28 sender is the upper neighbour | 27..14 remaining | 13..0 first row
namespace strip_word {

/// Rows are numbered 0 .. kMaxRows - 1.
constexpr uint32_t kMaxRows = (1u << 14) - 1;
/// Epochs are numbers modulo this.
constexpr uint32_t kEpochs = 4;
constexpr uint32_t kFromPpe = 1u << 31;

constexpr uint32_t make(uint32_t epoch, bool from_upper, RowRange rows) {
  return (epoch & (kEpochs - 1)) << 29 | (from_upper ? 1u << 28 : 0u) | rows.count << 14 | rows.first;
}
constexpr bool from_ppe(uint32_t word) {
  return (word & kFromPpe) != 0;
}
constexpr uint32_t epoch(uint32_t word) {
  return word >> 29 & (kEpochs - 1);
}
constexpr bool from_upper(uint32_t word) {
  return (word >> 28 & 1u) != 0;
}
constexpr RowRange rows(uint32_t word) {
  return {word & kMaxRows, word >> 14 & kMaxRows};
}

} // namespace strip_word

/// Rows that a dry node gets of a neighbour that has `remaining`. `lambda`: the exchange parameter in units
/// of 2^-16.
constexpr uint32_t strip_gift(uint32_t remaining, uint32_t lambda) {
  return remaining * lambda >> 16;
}

/// What the owner of a StripNode has to do next.
struct StripAction {
  enum class Kind : uint32_t {
    none,        ///< nothing: take a row, or wait for a word or a doorbell
    send_word,   ///< ring the neighbour with `doorbell` unless that is 0, and then send it `word`
    ring,        ///< ring the neighbour with `doorbell`
    report_idle, ///< tell the PPE that this node is idle and has completed `rows` in this frame
  };
  Kind kind;
  uint32_t neighbour; ///< id of the node to address
  uint32_t word;
  uint32_t doorbell; ///< bits to OR into the neighbour's doorbell register
  uint32_t rows;
};

/// Node `id` of a chain of `count` nodes. Not thread safe; copyable.
class StripNode {
public:
  /// `id` < `count`. No frame is under way.
  StripNode(uint32_t id, uint32_t count) : id_(id), lambda_(0), epoch_(kNoFrame), taken_(0), completed_(0) {
    reported_ = kNeverReported;
    rows_ = RowRange{0, 0};
    edges_[kLower] = make_edge(id != 0);
    edges_[kUpper] = make_edge(id + 1 != count);
  }

  /// Starts a frame with the rows this node has at first. `epoch`: the frame's number modulo 4, the same for
  /// all nodes. `lambda`: exchange parameter in units of 2^-16, 0..65535; 0 never moves a row. Words of this
  /// frame that came early are handled now.
  void begin_frame(uint32_t epoch, RowRange rows, uint32_t lambda) {
    epoch_ = epoch & (strip_word::kEpochs - 1);
    lambda_ = lambda;
    rows_ = rows;
    taken_ = 0;
    completed_ = 0;
    reported_ = kNeverReported;
    for (Edge& edge : edges_)
      begin_frame_on(edge);
  }
  /// Leaves the frame: nothing is sent any more, and its words are dropped from now on.
  void end_frame() {
    epoch_ = kNoFrame;
    rows_ = RowRange{0, 0};
    for (Edge& edge : edges_) {
      edge.question = Question::open;
      edge.has_answer = 0;
      edge.neighbour_hungry = 0;
    }
  }

  /// Takes the first remaining row. False: there is none at the moment.
  bool take_row(uint32_t& row) {
    if (rows_.empty()) return false;
    row = rows_.first;
    ++rows_.first;
    --rows_.count;
    ++taken_;
    return true;
  }
  /// The row taken last is complete. Until then the node may look for more rows, but is not idle.
  void complete_row() { ++completed_; }

  /// A word of a neighbour, strip_word::from_ppe() being false. Call next_action() until it is `none`
  /// afterwards.
  void on_word(uint32_t word) {
    Edge& edge = edges_[strip_word::from_upper(word) ? kUpper : kLower];
    if (!edge.exists) return;
    if (strip_word::epoch(word) != epoch_) {
      edge.early_word = word;
      edge.has_early_word = 1;
      return;
    }
    exchange(edge, strip_word::rows(word));
  }
  /// The bits of the doorbell register. Call next_action() until it is `none` afterwards.
  void on_doorbell(uint32_t bits) {
    for (uint32_t side = 0; side < 2; ++side) {
      Edge& edge = edges_[side];
      const bool rung = (bits >> (neighbour(side) & 31u) & 1u) != 0;
      if (rung && edge.question == Question::refused) edge.question = Question::invited;
    }
  }

  /// What to do next; the node counts it as done. Answers come first, so that no neighbour waits for our
  /// questions.
  StripAction next_action() {
    for (uint32_t side = 0; side < 2; ++side) {
      if (edges_[side].has_answer) return answer(side);
    }
    for (uint32_t side = 0; side < 2; ++side) {
      if (edges_[side].neighbour_hungry && can_give()) return ring(side);
    }
    if (in_frame() && rows_.empty() && !waiting()) return next_action_when_dry();
    return nothing();
  }

  RowRange remaining() const { return rows_; }
  /// Rows completed in this frame.
  uint32_t completed() const { return completed_; }
  bool in_frame() const { return epoch_ != kNoFrame; }
  /// A question of ours is unanswered.
  bool waiting() const {
    return edges_[kLower].question == Question::waiting || edges_[kUpper].question == Question::waiting;
  }

private:
  static constexpr uint32_t kLower = 0;
  static constexpr uint32_t kUpper = 1;
  static constexpr uint32_t kNoFrame = strip_word::kEpochs;
  static constexpr uint32_t kNeverReported = ~0u;

  /// What became of our question on an edge since we ran dry. A node that has rows has no questions: all are
  /// open.
  enum class Question : uint32_t { open, waiting, refused, invited };

  struct Edge {
    uint32_t exists;
    Question question;
    uint32_t neighbour_hungry; ///< it was refused, and has not been rung since
    uint32_t has_answer;
    uint32_t answer;
    uint32_t has_early_word;
    uint32_t early_word;
  };

  static Edge make_edge(bool exists) { return {exists ? 1u : 0u, Question::open, 0, 0, 0, 0, 0}; }
  static StripAction nothing() { return {StripAction::Kind::none, 0, 0, 0, 0}; }

  uint32_t neighbour(uint32_t side) const { return side == kLower ? id_ - 1 : id_ + 1; }
  uint32_t own_doorbell() const { return 1u << (id_ & 31u); }
  bool can_give() const { return strip_gift(rows_.count, lambda_) != 0; }
  /// We are the upper neighbour of our lower one.
  uint32_t own_word(const Edge& edge) const {
    return strip_word::make(epoch_, &edge == &edges_[kLower], rows_.empty() ? RowRange{0, 0} : rows_);
  }

  void begin_frame_on(Edge& edge) {
    edge.question = Question::open;
    edge.neighbour_hungry = 0;
    edge.has_answer = 0;
    const bool early = edge.has_early_word && strip_word::epoch(edge.early_word) == epoch_;
    edge.has_early_word = 0;
    if (early) exchange(edge, strip_word::rows(edge.early_word));
  }

  /// The neighbour's word of an exchange has come; ours was sent with our question, or is sent as the answer.
  void exchange(Edge& edge, RowRange other) {
    if (edge.question != Question::waiting) {
      edge.answer = own_word(edge);
      edge.has_answer = 1;
    }
    const uint32_t moved = settle(edge, other);
    edge.neighbour_hungry = other.empty() && moved == 0 ? 1u : 0u;
  }
  /// Moves the boundary as the neighbour does. Returns the number of rows that changed hands.
  uint32_t settle(Edge& edge, RowRange other) {
    if (rows_.empty()) return receive(edge, other);
    return other.empty() ? give(edge) : 0;
  }
  uint32_t receive(Edge& edge, RowRange other) {
    const uint32_t moved = strip_gift(other.count, lambda_);
    if (moved == 0) {
      edge.question = Question::refused;
      return 0;
    }
    const bool from_tail = &edge == &edges_[kLower];
    rows_ = RowRange{from_tail ? other.first + other.count - moved : other.first, moved};
    for (Edge& each : edges_)
      each.question = Question::open;
    return moved;
  }
  uint32_t give(const Edge& edge) {
    const uint32_t moved = strip_gift(rows_.count, lambda_);
    if (&edge == &edges_[kLower]) rows_.first += moved;
    rows_.count -= moved;
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
    const uint32_t colour_0 = (id_ & 1u) == 0 ? kUpper : kLower;
    const uint32_t in_turn[2] = {colour_0, 1u - colour_0};
    for (uint32_t side : in_turn) {
      if (edges_[side].exists && edges_[side].question == Question::open) return ask(side, own_doorbell());
    }
    for (uint32_t side : in_turn) {
      if (edges_[side].question == Question::invited) return ask(side, 0);
    }
    return taken_ == completed_ && reported_ != completed_ ? report() : nothing();
  }
  StripAction ask(uint32_t side, uint32_t doorbell) {
    edges_[side].question = Question::waiting;
    return {StripAction::Kind::send_word, neighbour(side), own_word(edges_[side]), doorbell, 0};
  }
  StripAction report() {
    reported_ = completed_;
    return {StripAction::Kind::report_idle, 0, 0, 0, completed_};
  }

  uint32_t id_;
  uint32_t lambda_;
  uint32_t epoch_;
  RowRange rows_;
  uint32_t taken_;
  uint32_t completed_;
  uint32_t reported_;
  Edge edges_[2];
};

} // namespace celltrace
