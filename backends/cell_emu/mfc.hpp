// The memory flow controller of one SPE: checks commands, queues them, and moves their data later, in an
// order that fences and barriers allow.
//
// Commands of the queue complete in any order, except that a fenced command follows all earlier ones of its
// tag, a barriered one also precedes all later ones of its tag, and mfc_barrier, mfceieio and mfcsync follow
// everything earlier and precede everything later. A list that stopped at a notify element stays in the queue
// until it is acknowledged; the other commands of its tag go on.
#pragma once

#include "backends/cell_emu/bus.hpp"
#include "backends/cell_emu/counters.hpp"
#include "backends/cell_emu/mfc_command.hpp"
#include "backends/cell_emu/tag_groups.hpp"
#include "backends/cell_emu/transfer_timing.hpp"

#include <array>
#include <optional>
#include <string>

namespace celltrace::cell_emu {

/// Thread safety: belongs to the thread of its SPE. Every member that may move data throws SpeError when a
/// command, or an element of a list, breaks a rule; `read_...` members also when the channel would stall for
/// ever.
class Mfc {
public:
  Mfc(unsigned spe, Bus& bus, ProblemState& problem_state, Counters& counters);
  ~Mfc();
  Mfc(const Mfc&) = delete;
  Mfc& operator=(const Mfc&) = delete;

  /// Executes an immediate command, queues any other; makes room first if the queue is full.
  void issue(const MfcCommand& command);
  unsigned free_entries() const { return kMfcQueueEntries - queued_; }

  /// Moves the oldest command that may move, or a list up to its next stop. False if there is none.
  bool advance();
  /// Moves all commands that may move.
  void drain();
  /// The end of the kernel: moves everything; a list that is still stopped is an error.
  void finish();

  std::uint32_t tag_mask() const { return tag_groups_.mask(); }
  void write_tag_mask(std::uint32_t mask);
  void write_tag_update(std::uint32_t request);
  bool tag_status_available() const { return tag_groups_.available(); }
  /// Moves what the request needs, and what is overdue.
  std::uint32_t read_tag_status();

  bool list_stall_status_available() const { return stalled_tags_ != 0; }
  std::uint32_t read_list_stall_status();
  void acknowledge_list_stall(std::uint32_t tag);

  bool atomic_status_available() const { return atomic_status_.has_value(); }
  std::uint32_t read_atomic_status();

  /// Bytes moved so far.
  std::uint64_t bytes_moved() const {
    return counters_.dma_bytes_read.value() + counters_.dma_bytes_written.value();
  }

private:
  struct Entry {
    MfcCommand command;
    std::uint32_t mark;         ///< age, see LateTransfers
    std::uint32_t next_element; ///< of a list
    std::uint32_t next_lsa;     ///< of a list: where its next element's quadword lies
    bool stalled;               ///< at a notify element
  };

  void check(const MfcCommand& command) const;
  void execute_immediate(const MfcCommand& command);
  void enqueue(const MfcCommand& command);

  /// The oldest command that must complete before entry `index` may move; `index` itself if it may move now.
  unsigned first_before(unsigned index) const;
  /// Moves entry `index` or what must come before it. False if a stopped list is in the way.
  bool advance_towards(unsigned index);
  bool advance_any_of(std::uint32_t tags);
  void remove(unsigned index);
  void judge_tag_groups();
  std::uint32_t outstanding_tags() const;

  /// True when the command is complete.
  bool execute(Entry& entry);
  bool execute_list(Entry& entry);
  ListElement read_element(const Entry& entry) const;
  void transfer(const MfcCommand& command);
  void transfer_word(const MfcCommand& command, AddressMap::Place place);
  void transfer_block(const MfcCommand& command);

  [[noreturn]] void fail(const std::string& what) const;

  const unsigned spe_;
  Bus& bus_;
  ProblemState& problem_state_;
  Counters& counters_;

  std::array<Entry, kMfcQueueEntries> queue_;
  unsigned queued_ = 0;
  LateTransfers timing_;
  TagGroups tag_groups_;
  std::uint32_t stalled_tags_ = 0; ///< not yet read from channel 25
  std::optional<std::uint32_t> atomic_status_;
};

} // namespace celltrace::cell_emu
