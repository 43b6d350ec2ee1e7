// Writes a trace of a run in Chrome's format, for https://ui.perfetto.dev and chrome://tracing.
//
// The process "Cell" has a thread for the PPE and two for every SPE: one for its activity (computing,
// waiting, marks) and one for its messages. Arrows go from the send to the read of a word. Every MFC is a
// process of its own, because its commands may overlap. Times are virtual; nothing in the file depends on the
// host.
#pragma once

#include "backends/cell_emu/trace_events.hpp"
#include "celltrace/spe/diagnostic.hpp"

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cell_emu {

/// Writes events when they are added, but messages at the end, sorted by time, because messages are not added
/// in order of time: a word that is sent by DMA may be added after words that its SPE reads later. Times are
/// virtual cycles; the intervals of compute() and wait() of one SPE must not overlap. Errors: the stream's
/// own state. Thread safety: one thread at a time.
class Trace {
public:
  /// `clock_hz` is at least 1 Hz. `out` must outlive the trace.
  Trace(std::ostream& out, unsigned spes, double clock_hz);
  Trace(const Trace&) = delete;
  Trace& operator=(const Trace&) = delete;
  /// Completes the file.
  ~Trace();

  /// Adds an interval in which the SPE ran its program. Adjacent intervals become one slice.
  void compute(unsigned spe, std::uint64_t begin, std::uint64_t end);
  /// Adds an interval in which the SPE waited; `what` is "wait for tag group", for example.
  void wait(unsigned spe, const char* what, std::uint64_t begin, std::uint64_t end);
  /// Adds an MFC command from its issue to its completion. `number` is unique within the SPE. `target` is
  /// "main memory", or the part of `target_spe` that the command reads or writes: "local store", "signal 1",
  /// "signal 2", "in mailbox".
  void dma(unsigned spe, std::uint64_t number, const char* opcode, std::uint32_t tag, std::uint32_t lsa,
           std::uint32_t size, const char* target, unsigned target_spe, std::uint64_t begin,
           std::uint64_t end, CallSite site);
  /// Adds the send of a word by an SPE, or the PPE (Diagnostic::kPpe). Returns the number of the arrow for
  /// receive(); never 0.
  std::uint64_t send(unsigned from, const char* what, std::uint32_t value, std::uint64_t at);
  /// Adds the read of a word. `arrow` 0: the sender is unknown.
  void receive(std::uint64_t arrow, unsigned to, const char* what, std::uint64_t at);
  /// Adds a mark that the program sets.
  void note(unsigned spe, const char* what, std::uint32_t value, std::uint64_t at);
  /// Adds a broken rule, but not the diagnostic's text, whose main memory addresses differ from run to run.
  void diagnostic(const Diagnostic& diagnostic);

private:
  /// The track that an event is drawn on.
  struct Track {
    unsigned process, thread;
  };
  struct Interval {
    std::uint64_t begin = 0, end = 0;
    bool empty() const { return begin == end; }
  };

  /// One end of an arrow.
  struct Message {
    std::uint64_t at; ///< nanoseconds
    char phase;       ///< phase of the arrow's event: s at its start, f at its end
    std::string name;
    std::uint64_t arrow;
    std::uint32_t value; ///< the word that is sent
  };

  // In the functions below, `spe` may be Diagnostic::kPpe.
  static Track activity_of(unsigned spe);
  static Track messages_of(unsigned spe);
  Track mfc_of(unsigned spe) const;
  std::uint64_t nanoseconds(std::uint64_t cycles) const;

  void name_process(Track first_track, std::string_view name);
  void name_thread(Track track, std::string_view name);
  void slice(Track track, std::string_view name, Interval cycles);
  void flush_compute(unsigned spe);
  void draw_messages(unsigned spe);
  void draw(const Message& message, Track track, std::uint64_t end);
  // The functions below begin an event; their caller adds arguments and ends the event.
  void begin_command(char phase, unsigned spe, std::uint64_t number, const char* opcode, std::uint64_t at);
  void begin_instant(unsigned spe, std::string_view category, std::string_view name, std::uint64_t at);
  void site_argument(const CallSite& site);

  unsigned spes_;
  std::uint64_t clock_hz_;
  TraceEvents events_;
  std::uint64_t arrows_ = 0;
  /// By SPE: last interval of computing, in cycles, which adjacent intervals still extend.
  std::vector<Interval> computing_;
  std::vector<std::vector<Message>> messages_; ///< by SPE; the last element is the PPE's
};

} // namespace celltrace::cell_emu
