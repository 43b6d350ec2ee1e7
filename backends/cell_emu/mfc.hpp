// The memory flow controller of one SPE: checks commands, queues them, and completes them in virtual time, in
// an order that fences and barriers allow.
//
// Commands of a queue complete in any order, except that a fenced command follows all earlier ones of its
// tag, a barriered one also precedes all later ones of its tag, and mfc_barrier, mfceieio and mfcsync follow
// everything earlier and precede everything later. A list that stopped at a notify element stays in the queue
// until it is acknowledged; the other commands of its tag go on.
//
// A command starts when nothing is left that it is ordered behind; the timing model says when it is complete,
// and the configuration when its data move. Its transfers are in flight, and watched, until the program has
// observed that it is complete.
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

/// What the MFCs of a machine share.
struct MfcContext {
  Bus& bus;
  Flights& flights;
  Bounds& bounds;
  DiagnosticLog& log;
  const EmulationConfig& config;
  Trace* trace; ///< null: no trace is written
  /// Of the words that the SPUs write for their MFCs: list elements, and words for registers.
  std::endian byte_order = std::endian::native;

  std::uint32_t from_spu(std::uint32_t word) const {
    return byte_order == std::endian::native ? word : __builtin_bswap32(word);
  }
};

/// The part of local store that is the program's own memory; the rest is its code and stack.
struct ArenaRange {
  std::uint32_t begin, end;
};

/// Thread safety: belongs to the thread that runs its SPE. Members throw RuleViolation when a rule is broken
/// whose action is to stop.
class Mfc {
public:
  Mfc(unsigned spe, const MfcContext& context, DmaTiming& timing, ProblemState& problem_state,
      Counters& counters);
  Mfc(const Mfc&) = delete;
  Mfc& operator=(const Mfc&) = delete;

  // --- a program's life ---

  /// While none runs.
  void begin_program(ArenaRange arena);
  /// The kernel has returned: completes everything and reports what is left undone.
  void finish(Cycle now);
  /// The program was broken off: forgets its commands.
  void abandon();

  /// A program that says what it allocates has begun; a release() is checked for stores past what it frees.
  void begin_allocations(const std::uint8_t* from);
  /// Changes the arena's end and where the next allocation begins, as red zones ask for it.
  void allocated(const std::uint8_t* begin, std::uint32_t bytes, std::uint32_t alignment, CallSite site,
                 ArenaState& arena);
  void release(const std::uint8_t* from, CallSite site, Cycle now, ArenaState& arena);
  std::uint32_t arena_end() const { return arena_.end; }
  /// Bytes that red zones have added to the arena.
  std::uint32_t red_zone_bytes() const { return arena_.end - plain_arena_end_; }

  /// The part of the arena that the program has used.
  ForeignStoreWatch::Used local_store_in_use() const;
  std::uint32_t arena_begin() const { return arena_.begin; }

  // --- commands of the SPU ---

  unsigned free_entries() const { return kMfcQueueEntries - spu_entries_; }
  /// The program has read that all entries are free: all of its commands are complete, and it knows.
  void observe_empty_queue(CallSite site, Cycle now);
  /// Executes an immediate command, queues any other. The queue is not full.
  void issue(const MfcCommand& command, CallSite site, Cycle now);

  // --- commands of the PPE ---

  unsigned free_proxy_entries() const {
    return kProxyQueueEntries - static_cast<unsigned>(queue_.size() - spu_entries_);
  }
  /// The rules of a proxy command, which the PPE breaks. False if it must not be issued. Thread-safe.
  bool check_proxy(const MfcCommand& command, Cycle now);
  void issue_proxy(const MfcCommand& command, Cycle now);
  /// Instead of issue_proxy(), from a thread that does not run the SPE: the data move at once. Thread-safe.
  void perform_proxy(const MfcCommand& command);
  /// Tags with proxy commands in the queue.
  std::uint32_t outstanding_proxy_tags() const { return outstanding(true); }
  void observe_proxy(std::uint32_t tags, Cycle now);

  // --- machine code ---

  /// From now on `watch`, a byte a quadword of local store, says what check_load() and check_store() are for:
  /// its bits are those of isa::State. Null: nobody looks.
  void watch_flights(std::uint8_t* watch) { watch_ = watch; }
  /// A transfer in flight, for who looks at local store meanwhile.
  struct FlightInfo {
    std::uint64_t command = 0;
    MfcCommand transfer{};
    CallSite site;
    bool drained = false; ///< it is complete, and the program has seen that the queue is empty

    FlightInfo() = default;
    explicit FlightInfo(const Flight& flight)
        : command(flight.command), transfer(flight.transfer), site(flight.site), drained(flight.drained) {}
  };
  /// A get in flight that targets all of the quadword at `lsa`. A load of which only a part is in flight may
  /// be meant for the other part.
  std::optional<FlightInfo> get_in_flight(std::uint32_t lsa) const;
  /// The program uses at `use` what it loaded from there at `load`.
  void report_early_load(const FlightInfo& flight, std::uint32_t lsa, CallSite load, CallSite use, Cycle now);
  /// An instruction is about to store the 16 bytes at `bytes` at `lsa`. That it leaves a put's bytes as they
  /// are is no change of them.
  void check_store(std::uint32_t lsa, const std::uint8_t* bytes, CallSite site, Cycle now);

  // --- virtual time ---

  /// When the next thing happens by itself, or kNever.
  Cycle next_event() const;
  /// Lets it happen. Returns its time.
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
  /// Only when available.
  std::uint32_t take_tag_status(Cycle now);
  /// Why channel 24 will never have a value; the queue has nothing left that happens by itself.
  std::string why_no_tag_status() const;

  bool list_stall_status_available() const { return stalled_tags_ != 0; }
  std::uint32_t take_list_stall_status(Cycle now);
  void acknowledge_list_stall(std::uint32_t tag, CallSite site, Cycle now);

  bool atomic_status_available() const { return atomic_status_.has_value(); }
  /// When the status of the last lock-line command is there.
  Cycle atomic_status_time() const { return atomic_due_; }
  std::uint32_t take_atomic_status();

private:
  struct Entry {
    MfcCommand command;
    std::uint64_t number;
    CallSite site;
    bool proxy;
    Cycle issued;
    Cycle due = kNever;     ///< when it, or the present part of a list, is complete; kNever until it starts
    Cycle move_at = kNever; ///< when its data move, if that is before `due`
    bool moved = false;
    bool stalled = false;                ///< at a notify element
    std::vector<ListElement> elements{}; ///< of a list, as the MFC has read them
    std::uint32_t next_element = 0;      ///< first of the part that comes after the present one
    std::uint32_t next_lsa = 0;          ///< of a list: where that part's first quadword lies
  };

  Diagnostic about(const Entry& entry, Rule rule, Cycle now) const;
  /// Reports a rule that a command breaks; `before` comes before the command in the text.
  void report(const Entry& entry, Rule rule, Cycle now, const std::string& before = {}) const;
  Allocations& allocations() const { return context_.bounds.allocations[spe_]; }
  void report_channel(Channel channel, std::uint32_t value, Rule rule, CallSite site, Cycle now) const;
  /// A store past the local store that is found by a command, or at the end. False if it is not reported.
  bool note_overrun(Diagnostic& diagnostic, CallSite site, Cycle now);
  /// The same for one past an allocation.
  bool note_allocation_overrun(Diagnostic& diagnostic, CallSite site, Cycle now);
  void check_stores(CallSite site, Cycle now);
  Rule broken_arena_rule(const MfcCommand& transfer) const;
  Rule broken_bounds_rule(const MfcCommand& command, bool proxy) const;
  /// What was to be kept, for a rule that broken_bounds_rule() has returned.
  std::string bounds_of(Rule rule, const Entry& entry) const;
  struct LocalRange {
    unsigned spe;
    std::uint32_t lsa;
  };
  std::optional<LocalRange> unallocated(const MfcCommand& command, bool proxy) const;
  std::optional<MemoryObject> left_object(const MfcCommand& command) const;
  /// What a command of the SPU, or of the PPE, finds at its effective address.
  EaKind target_of(const MfcCommand& command, std::uint32_t size, bool proxy);
  /// False if the command cannot be carried out, though whoever broke the rule goes on.
  bool check(const MfcCommand& command, std::uint64_t number, CallSite site, Cycle now, bool proxy);
  void enqueue(const MfcCommand& command, CallSite site, Cycle now, bool proxy);
  void execute_immediate(const MfcCommand& command, Cycle now);
  void check_conditional(const MfcCommand& command, CallSite site, Cycle now);

  // --- transfers in flight: mfc_transfers.cpp ---

  void depart(const Entry& entry, const MfcCommand& transfer, Cycle now);
  void report_conflict(const Entry& entry, const MfcCommand& transfer, const Conflict& conflict, Cycle now);
  bool is_ordered_before(const Flight& flight, const Entry& entry) const;
  bool is_ordered_behind(const Flight& flight, const Entry& entry) const;
  /// `observed`: nobody watches over its local store any more.
  void move(Flight& flight, Cycle now, bool observed = false);
  void move_word(const Flight& flight, AddressMap::Place place, Cycle now);
  /// Reports a flight whose local store has another content than the emulator left there.
  void report_touched(const Flight& flight, Cycle now);
  void verify(const Flight& flight, Cycle now);
  /// Reports a put of what host code has read, or computed from, where data were still to come.
  void check_source(const Flight& flight, const Entry& entry, Cycle now);
  /// The program relies on what only the count of the queue has told it. False if that is not reported.
  bool note_drained(const FlightInfo& flight, Diagnostic& diagnostic, Cycle now);
  void report_drained(const FlightInfo& flight, Cycle now);
  /// The program knows that the flights of which `seen(flight)` is true are complete.
  template <class Seen> void observe_if(Seen seen, Cycle now);
  /// What of a list has been transferred.
  void observe_part(std::uint64_t command, Cycle now);
  void observe(std::uint32_t tags, std::uint64_t last_command, bool proxy, Cycle now);
  std::uint8_t* local_store(const MfcCommand& transfer) const;
  /// Has the program's accesses to the target of a get reported, until it may know that the data are there.
  void forbid(Flight& flight);
  void permit(Flight& flight);
  void report_access(const FlightInfo& flight, Rule rule, const std::string& what, CallSite site, Cycle now);
  void watch(const Flight& flight);
  template <class Gone> void remove_flights(Gone gone);

  // --- progress ---

  void start_ready(Cycle now);
  bool may_start(std::size_t index) const;
  void start(Entry& entry, Cycle now);
  Cycle time_of(const Entry& entry, Cycle start);
  Cycle time_of_transfer(const MfcCommand& transfer, Cycle start);
  void move_data(Entry& entry, Cycle now);
  void complete(std::size_t index, Cycle now);
  /// True when the list is done; else it stands at its notify element.
  bool complete_part(Entry& entry, Cycle now);
  void begin_part(Entry& entry, Cycle now);
  void read_list(Entry& entry) const;
  void check_list_unchanged(const Entry& entry, Cycle now);
  void trace_command(const Entry& entry, Cycle now) const;
  void judge_tag_groups();
  std::uint32_t outstanding(bool proxy) const;

  class OpenedLocalStore;

  const unsigned spe_;
  const MfcContext context_;
  const bool has_checker_ = has_access_checker();
  void fit_arena(ArenaState& arena);

  ArenaRange arena_{0, kLocalStoreBytes};
  std::uint32_t plain_arena_end_ = kLocalStoreBytes; ///< without red zones
  Bus& bus_;
  DmaTiming& timing_;
  ProblemState& problem_state_;
  Counters& counters_;
  SeededRandom random_;
  HostMemory host_memory_;

  std::uint8_t* watch_ = nullptr;
  std::vector<Entry> queue_; ///< of the SPU and of the PPE, oldest first
  unsigned spu_entries_ = 0;
  std::uint64_t commands_ = 0; ///< issued
  std::uint64_t last_queue_barrier_[2] = {0, 0};
  std::array<std::uint64_t, kMfcTags> last_tag_barrier_[2] = {};

  TagGroups tag_groups_;
  std::uint32_t used_tags_ = 0;
  std::uint32_t waited_tags_ = 0;
  std::array<CallSite, kMfcTags> waits_{}; ///< by tag: the last wait for it
  CallSite last_request_;
  CallSite drain_site_; ///< where the queue was last seen empty
  bool drain_reported_ = false;
  std::uint32_t stalled_tags_ = 0; ///< not yet read from channel 25
  std::optional<std::uint32_t> atomic_status_;
  Cycle atomic_due_ = 0;
  MfcCommand last_atomic_{};
  CallSite last_atomic_site_;
};

} // namespace celltrace::cell_emu
