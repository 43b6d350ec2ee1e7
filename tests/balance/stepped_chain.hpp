// The sequential twin of SPEs that exchange work: a chain of StripNodes whose mailboxes are queues, and whose
// messages arrive at once. Does what WorkExchange does, a step at a time.
#pragma once

#include "work_report.hpp"

#include "celltrace/balance/strip.hpp"
#include "celltrace/balance/strip_tally.hpp"

#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

namespace celltrace::test {

class SteppedChain {
public:
  /// What a node has sent since it was made.
  struct Sent {
    std::uint32_t words = 0; ///< to neighbours
    std::uint32_t doorbells = 0;
    std::uint32_t reports = 0; ///< to the PPE
  };

  explicit SteppedChain(std::uint32_t nodes) {
    for (std::uint32_t id = 0; id < nodes; ++id)
      seats_.emplace_back(id, nodes);
  }

  // The steps. Each returns what the node reports to the PPE meanwhile: numbers of completed units.
  using Reports = std::vector<std::uint32_t>;

  Reports begin_frame(std::uint32_t node, std::uint32_t epoch, UnitRange units, std::uint32_t lambda) {
    Seat& seat = seats_[node];
    seat.report = WorkReport{};
    seat.taken = false;
    read_mailbox(seat);
    seat.node.begin_frame(epoch, units, lambda);
    return act(seat);
  }
  Reports poll(std::uint32_t node) {
    Seat& seat = seats_[node];
    read_mailbox(seat);
    read_doorbell(seat);
    return act(seat);
  }
  /// Something has to be there, be it only a doorbell that means nothing.
  Reports wait(std::uint32_t node) {
    Reports reports = act(seats_[node]);
    if (!seats_[node].node.remaining().empty()) return reports;
    const Reports more = poll(node);
    reports.insert(reports.end(), more.begin(), more.end());
    return reports;
  }
  /// `answer`: the unit + 1, or 0.
  Reports take_unit(std::uint32_t node, std::uint32_t& answer) {
    Seat& seat = seats_[node];
    std::uint32_t unit = 0;
    seat.taken = seat.node.take_unit(unit);
    answer = seat.taken ? unit + 1 : 0;
    return seat.taken && seat.node.remaining().empty() ? act(seat) : Reports();
  }
  void complete_unit(std::uint32_t node) {
    Seat& seat = seats_[node];
    seat.node.complete_unit();
    seat.taken = false;
    ++seat.report.units;
  }
  void end_frame(std::uint32_t node) { seats_[node].node.end_frame(); }

  /// It has a unit that is not complete.
  bool at_work(std::uint32_t node) const { return seats_[node].taken; }
  bool is_dry(std::uint32_t node) const { return seats_[node].node.remaining().empty(); }
  const WorkReport& report(std::uint32_t node) const { return seats_[node].report; }
  const Sent& sent(std::uint32_t node) const { return seats_[node].sent; }

private:
  struct Seat {
    Seat(std::uint32_t id, std::uint32_t nodes) : node(id, nodes) {}

    StripNode node;
    std::deque<std::uint32_t> mailbox;
    std::uint32_t doorbell = 0;
    bool taken = false;
    WorkReport report{};
    Sent sent;
  };

  static void read_doorbell(Seat& seat) {
    if (seat.doorbell != 0) seat.node.on_doorbell(std::exchange(seat.doorbell, 0));
  }
  static void read_mailbox(Seat& seat) {
    for (; !seat.mailbox.empty(); seat.mailbox.pop_front()) {
      read_doorbell(seat);
      const std::uint32_t before = seat.node.remaining().count;
      seat.node.on_word(seat.mailbox.front());
      const std::uint32_t after = seat.node.remaining().count;
      if (after <= before) continue;
      ++seat.report.exchanges;
      seat.report.units_received += after - before;
    }
  }
  Reports act(Seat& seat) {
    Reports reports;
    for (;;) {
      const StripAction action = seat.node.next_action();
      if (action.kind == StripAction::Kind::none) break;
      if (action.kind == StripAction::Kind::report_idle) {
        reports.push_back(action.units);
        ++seat.sent.reports;
        continue;
      }
      Seat& neighbour = seats_[action.neighbour];
      neighbour.doorbell |= action.doorbell;
      seat.sent.doorbells += action.doorbell != 0;
      if (action.kind != StripAction::Kind::send_word) continue;
      neighbour.mailbox.push_back(action.word);
      ++seat.sent.words;
    }
    return reports;
  }

  std::vector<Seat> seats_;
};

} // namespace celltrace::test
