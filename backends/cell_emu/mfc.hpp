// The memory flow controller of one SPE: checks commands, queues them, and completes them in virtual time, in
// an order that fences and barriers allow.
//
// Commands of a queue complete in any order, with exceptions: a command with a fence follows all earlier
// commands of its tag; a command with a barrier also precedes all later commands of its tag; mfc_barrier,
// mfceieio and mfcsync follow all earlier commands and precede all later commands. A list that stopped at a
// notify element stays in the queue until the stop is acknowledged; the other commands of its tag go on.
//
// A command starts when all commands that it is ordered behind are complete. The timing model decides when
// the command is complete, and the configuration when its data move. Its transfers are in flight, and
// watched, until the program has observed their completion.
#pragma once

#include "backends/cell_emu/access_checkers.hpp"
#include "backends/cell_emu/bounds.hpp"
#include "backends/cell_emu/bus.hpp"
#include "backends/cell_emu/counters.hpp"
#include "backends/cell_emu/cycle.hpp"
#include "backends/cell_emu/diagnostic_log.hpp"
#include "backends/cell_emu/dma_timing.hpp"
#include "backends/cell_emu/flights.hpp"
#include "backends/cell_emu/foreign_store_watch.hpp"
#include "backends/cell_emu/host_memory.hpp"
#include "backends/cell_emu/mfc_command.hpp"
#include "backends/cell_emu/seeded_random.hpp"
#include "backends/cell_emu/tag_groups.hpp"
#include "backends/cell_emu/trace.hpp"

#include <array>
#include <bit>
#include <optional>
#include <string>
#include <vector>

namespace celltrace {
struct ArenaState;
}

namespace celltrace::cell_emu {

/// State that the MFCs of a machine share.
struct MfcContext {
  Bus& bus;
  Flights& flights;
  Bounds& bounds;
  DiagnosticLog& log;
  const EmulationConfig& config;
  Trace* trace; ///< null: no trace is written
  /// Byte order of the words that SPUs write for their MFCs: list elements, and words for registers.
  std::endian byte_order = std::endian::native;

  std::uint32_t from_spu(std::uint32_t word) const {
    return byte_order == std::endian::native ? word : __builtin_bswap32(word);
  }
};

/// The range of local store that the program allocates from; the rest is for its code and stack.
struct ArenaRange {
  std::uint32_t begin, end;
};

/// The MFC. Thread safety: belongs to the thread that runs its SPE. Members throw RuleViolation if a rule
/// with Action::stop is broken.
class Mfc {
public:
  Mfc(unsigned spe, const MfcContext& context, DmaTiming& timing, ProblemState& problem_state,
      Counters& counters);
  Mfc(const Mfc&) = delete;
  Mfc& operator=(const Mfc&) = delete;

  // --- a program's life ---

  /// Begins a program; the SPE must not run another program.
  void begin_program(ArenaRange arena);
  /// Completes all commands after the kernel has returned, and reports errors such as transfers that the
  /// program has not waited for.
  void finish(Cycle now);
  /// Forgets the commands of a program that was broken off.
  void abandon();

  /// Begins to track the allocations of a program from `from` on. release() then checks for stores past the
  /// freed allocations.
  void begin_allocations(const std::uint8_t* from);
  /// Adds an allocation. With red zones, changes the arena's end and the place of the next allocation.
  void allocated(const std::uint8_t* begin, std::uint32_t bytes, std::uint32_t alignment, CallSite site,
                 ArenaState& arena);
  void release(const std::uint8_t* from, CallSite site, Cycle now, ArenaState& arena);
  std::uint32_t arena_end() const { return arena_.end; }
  /// Returns the bytes that red zones have added to the arena.
  std::uint32_t red_zone_bytes() const { return arena_.end - plain_arena_end_; }

  /// Returns the part of the arena that the program has used.
  ForeignStoreWatch::Used local_store_in_use() const;
  std::uint32_t arena_begin() const { return arena_.begin; }

  // --- commands of the SPU ---

  unsigned free_entries() const { return kMfcQueueEntries - spu_entries_; }
  /// Notes that the program has read that all entries of the queue are free, from which it knows that all its
  /// commands are complete.
  void observe_empty_queue(CallSite site, Cycle now);
  /// Executes a lock-line command at once (see is_immediate()); queues any other command. The queue must not
  /// be full.
  void issue(const MfcCommand& command, CallSite site, Cycle now);

  // --- commands of the PPE ---

  unsigned free_proxy_entries() const {
    return kProxyQueueEntries - static_cast<unsigned>(queue_.size() - spu_entries_);
  }
  /// Checks a proxy command. Broken rules are the PPE's. Returns false if the command must not be issued.
  /// Thread-safe.
  bool check_proxy(const MfcCommand& command, Cycle now);
  void issue_proxy(const MfcCommand& command, Cycle now);
  /// Executes a proxy command at once: replaces issue_proxy() for a thread that does not run the SPE.
  /// Thread-safe.
  void perform_proxy(const MfcCommand& command);
  /// Returns the tags with proxy commands in the queue.
  std::uint32_t outstanding_proxy_tags() const { return outstanding(true); }
  void observe_proxy(std::uint32_t tags, Cycle now);

  // --- machine code ---

  /// Marks, from now on, the local store of transfers in flight in `watch`, which has a byte with the bits of
  /// isa::State for each quadword of local store. A mark means that loads or stores have to be checked. Null:
  /// no marks.
  void watch_flights(std::uint8_t* watch) { watch_ = watch; }
  /// A transfer in flight, as seen by code that accesses local store meanwhile.
  struct FlightInfo {
    std::uint64_t command = 0;
    MfcCommand transfer{};
    CallSite site;
    /// True: the transfer is complete, and the program has seen that the queue is empty.
    bool drained = false;

    FlightInfo() = default;
    explicit FlightInfo(const Flight& flight)
        : command(flight.command), transfer(flight.transfer), site(flight.site), drained(flight.drained) {}
  };
  /// Returns a get in flight whose target includes the whole quadword at `lsa`. A get into a part of the
  /// quadword is not returned, because a load may be meant for the other part.
  std::optional<FlightInfo> get_in_flight(std::uint32_t lsa) const;
  /// Reports that the program uses, at `use`, data that it loaded too early, at `load`, from the target of a
  /// get.
  void report_early_load(const FlightInfo& flight, std::uint32_t lsa, CallSite load, CallSite use, Cycle now);
  /// Checks an instruction that is about to store the quadword `bytes` at `lsa`. A store that leaves the
  /// bytes of a put unchanged is allowed.
  void check_store(std::uint32_t lsa, const std::uint8_t* bytes, CallSite site, Cycle now);

  // --- virtual time ---

  /// Returns the time of the next event that the passing of time brings about, or kNever.
  Cycle next_event() const;
  /// Executes the next event. Returns its time.
  Cycle run_next();
  void run_until(Cycle now) {
    while (next_event() <= now)
      run_next();
  }

  // --- channels ---

  std::uint32_t tag_mask() const { return tag_groups_.mask(); }
  void write_tag_mask(std::uint32_t mask);
  void write_tag_update(std::uint32_t request, CallSite site, Cycle now);
  bool tag_status_available() const { return tag_groups_.available(); }
  /// Returns and clears the tag status, which must be available.
  std::uint32_t take_tag_status(Cycle now);
  /// Returns a text that says why channel 24 will never have a value, for an MFC without further events.
  std::string why_no_tag_status() const;

  bool list_stall_status_available() const { return stalled_tags_ != 0; }
  std::uint32_t take_list_stall_status(Cycle now);
  void acknowledge_list_stall(std::uint32_t tag, CallSite site, Cycle now);

  bool atomic_status_available() const { return atomic_status_.has_value(); }
  /// Returns the time at which the status of the last lock-line command is available.
  Cycle atomic_status_time() const { return atomic_due_; }
  std::uint32_t take_atomic_status();

private:
  struct Entry {
    MfcCommand command;
    std::uint64_t number;
    CallSite site;
    bool proxy;
    Cycle issued;
    /// Time at which the command, or the present part of a list, is complete; kNever until it starts.
    Cycle due = kNever;
    Cycle move_at = kNever; ///< time at which the data move, if they move before `due`
    bool moved = false;
    bool stalled = false;                ///< the list waits at a notify element
    std::vector<ListElement> elements{}; ///< elements of a list, as the MFC has read them
    std::uint32_t next_element = 0;      ///< first element of the next part
    std::uint32_t next_lsa = 0;          ///< for a list: address of the first quadword of the next part
  };

  Diagnostic about(const Entry& entry, Rule rule, Cycle now) const;
  /// Reports a rule that a command breaks. The text has `before` in front of the command.
  void report(const Entry& entry, Rule rule, Cycle now, const std::string& before = {}) const;
  Allocations& allocations() const { return context_.bounds.allocations[spe_]; }
  void report_channel(Channel channel, std::uint32_t value, Rule rule, CallSite site, Cycle now) const;
  void enqueue(const MfcCommand& command, CallSite site, Cycle now, bool proxy);
  void execute_immediate(const MfcCommand& command, Cycle now);
  void check_conditional(const MfcCommand& command, CallSite site, Cycle now);

  // --- checks: mfc_checks.cpp ---

  void fit_arena(ArenaState& arena);
  /// Notes a store past the edges of local store. `site`: the command or the program's end at which it was
  /// found. Returns false if there is no such store, or the rule is ignored.
  bool note_overrun(Diagnostic& diagnostic, CallSite site, Cycle now);
  /// Notes a store past an allocation, as note_overrun() does.
  bool note_allocation_overrun(Diagnostic& diagnostic, CallSite site, Cycle now);
  void check_stores(CallSite site, Cycle now);
  Rule broken_arena_rule(const MfcCommand& transfer) const;
  Rule broken_bounds_rule(const MfcCommand& command, bool proxy) const;
  /// Describes the bounds that a command has crossed; `rule` is from broken_bounds_rule().
  std::string bounds_of(Rule rule, const Entry& entry) const;
  struct LocalRange {
    unsigned spe;
    std::uint32_t lsa;
  };
  std::optional<LocalRange> unallocated(const MfcCommand& command, bool proxy) const;
  std::optional<MemoryObject> left_object(const MfcCommand& command) const;
  /// Returns the kind of storage at a command's effective address, for a command of the SPU or of the PPE.
  EaKind target_of(const MfcCommand& command, std::uint32_t size, bool proxy);
  /// Checks a command. Returns false if the command cannot be executed, but the rule's action lets the
  /// program go on.
  bool check(const MfcCommand& command, std::uint64_t number, CallSite site, Cycle now, bool proxy);

  // --- transfers in flight: mfc_transfers.cpp ---

  void depart(const Entry& entry, const MfcCommand& transfer, Cycle now);
  void report_conflict(const Entry& entry, const MfcCommand& transfer, const Conflict& conflict, Cycle now);
  bool is_ordered_before(const Flight& flight, const Entry& entry) const;
  bool is_ordered_behind(const Flight& flight, const Entry& entry) const;
  /// Moves the data of a flight. `observed`: the flight's local store is no longer watched.
  void move(Flight& flight, Cycle now, bool observed = false);
  void move_word(const Flight& flight, AddressMap::Place place, Cycle now);
  /// Reports that the program has changed the local store of a flight.
  void report_touched(const Flight& flight, Cycle now);
  void verify(const Flight& flight, Cycle now);
  /// Reports a put of data that host code has copied or computed from the target of a get before the get
  /// delivered its data.
  void check_source(const Flight& flight, const Entry& entry, Cycle now);
  /// Completes the diagnostic that the program relies on the queue's count alone for a transfer's completion.
  /// Returns false if this is not to be reported.
  bool note_drained(const FlightInfo& flight, Diagnostic& diagnostic, Cycle now);
  void report_drained(const FlightInfo& flight, Cycle now);
  /// Notes that the program knows that the flights for which `predicate(flight)` is true are complete.
  template <class Predicate> void observe_if(Predicate predicate, Cycle now);
  /// Notes that the program knows the transferred part of a list.
  void observe_part(std::uint64_t command, Cycle now);
  void observe(std::uint32_t tags, std::uint64_t last_command, bool proxy, Cycle now);
  std::uint8_t* local_store(const MfcCommand& transfer) const;
  /// Forbids accesses of the program to the target of a get, which an access checker then reports. permit()
  /// ends this when the program may know that the data are there.
  void forbid(Flight& flight);
  void permit(Flight& flight);
  void report_access(const FlightInfo& flight, Rule rule, const std::string& what, CallSite site, Cycle now);
  void watch(const Flight& flight);
  template <class Predicate> void remove_flights(Predicate predicate);

  // --- progress ---

  void start_ready(Cycle now);
  bool may_start(std::size_t index) const;
  void start(Entry& entry, Cycle now);
  Cycle time_of(const Entry& entry, Cycle start);
  Cycle time_of_transfer(const MfcCommand& transfer, Cycle start);
  void move_data(Entry& entry, Cycle now);
  void complete(std::size_t index, Cycle now);
  void trace_command(const Entry& entry, Cycle now) const;
  void judge_tag_groups();
  std::uint32_t outstanding(bool proxy) const;

  // --- lists: mfc_lists.cpp ---

  /// Completes a part of a list. Returns true if the list is done; otherwise the list waits at its notify
  /// element.
  bool complete_part(Entry& entry, Cycle now);
  void begin_part(Entry& entry, Cycle now);
  void read_list(Entry& entry) const;
  void check_list_unchanged(const Entry& entry, Cycle now);

  class OpenedLocalStore;

  const unsigned spe_;
  const MfcContext context_;
  const bool has_checker_ = has_access_checker();
  ArenaRange arena_{0, kLocalStoreBytes};
  std::uint32_t plain_arena_end_ = kLocalStoreBytes; ///< end of the arena without red zones
  Bus& bus_;
  DmaTiming& timing_;
  ProblemState& problem_state_;
  Counters& counters_;
  SeededRandom random_;
  HostMemory host_memory_;

  std::uint8_t* watch_ = nullptr;
  std::vector<Entry> queue_; ///< commands of the SPU and of the PPE, oldest first
  unsigned spu_entries_ = 0;
  std::uint64_t commands_ = 0; ///< number of commands issued
  std::uint64_t last_queue_barrier_[2] = {0, 0};
  std::array<std::uint64_t, kMfcTags> last_tag_barrier_[2] = {};

  TagGroups tag_groups_;
  std::uint32_t used_tags_ = 0;
  std::uint32_t waited_tags_ = 0;
  std::array<CallSite, kMfcTags> waits_{}; ///< index: tag; place of the last wait for it
  CallSite last_request_;
  CallSite drain_site_; ///< place where the queue was last seen empty
  bool drain_reported_ = false;
  /// Tags of stopped lists that the program has not yet read from channel 25.
  std::uint32_t stalled_tags_ = 0;
  std::optional<std::uint32_t> atomic_status_;
  Cycle atomic_due_ = 0;
  MfcCommand last_atomic_{};
  CallSite last_atomic_site_;
};

} // namespace celltrace::cell_emu
