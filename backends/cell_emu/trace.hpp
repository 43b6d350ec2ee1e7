// A run as a Chrome trace, for https://ui.perfetto.dev and chrome://tracing.
//
// The process "Cell" has a thread for the PPE and two for every SPE: what it does (computing, waiting, marks)
// and its messages, joined by arrows from where a word is sent to where it is read. Every MFC is a process of
// its own, whose commands may overlap. Times are virtual; nothing in the file depends on the host.
#pragma once

#include "backends/cell_emu/trace_events.hpp"
#include "celltrace/spe/diagnostic.hpp"

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cell_emu {

/// Writes as it goes, but the messages at the end, in the order of their times: a word that leaves by DMA may
/// do so after words that its SPE reads later. Times are virtual cycles; what compute() and wait() say of one
/// SPE does not overlap. Errors: the stream's own state. Thread safety: one thread at a time.
class Trace {
public:
  /// `clock_hz` is at least 1 Hz. `out` must outlive the trace.
  Trace(std::ostream& out, unsigned spes, double clock_hz);
  Trace(const Trace&) = delete;
  Trace& operator=(const Trace&) = delete;
  /// Completes the file.
  ~Trace();

  /// The SPE ran its program. Stretches that follow each other without a gap become one slice.
  void compute(unsigned spe, std::uint64_t begin, std::uint64_t end);
  /// The SPE stood still: "wait for tag group", "queue full" and the like.
  void wait(unsigned spe, const char* what, std::uint64_t begin, std::uint64_t end);
  /// An MFC command from its issue to its completion. `number` is unique within the SPE. `target` is "main
  /// memory", or the part of `target_spe` that the command reads or writes: "local store", "signal 1",
  /// "signal 2", "in mailbox".
  void dma(unsigned spe, std::uint64_t number, const char* opcode, std::uint32_t tag, std::uint32_t lsa,
           std::uint32_t size, const char* target, unsigned target_spe, std::uint64_t begin,
           std::uint64_t end, CallSite site);
  /// A word leaves an SPE, or the PPE (Diagnostic::kPpe). Returns the arrow that receive() ends; never 0.
  std::uint64_t send(unsigned from, const char* what, std::uint32_t value, std::uint64_t at);
  /// The word is read. `arrow` 0: it is not known who sent it.
  void receive(std::uint64_t arrow, unsigned to, const char* what, std::uint64_t at);
  /// A moment of the program's own choice.
  void note(unsigned spe, const char* what, std::uint32_t value, std::uint64_t at);
  /// A broken rule, without the addresses of its text: those of main memory differ from run to run.
  void diagnostic(const Diagnostic& diagnostic);

private:
  /// Where an event is drawn.
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
    char phase;       ///< of the arrow: s, where it starts, or f, where it ends
    std::string name;
    std::uint64_t arrow;
    std::uint32_t value; ///< of what is sent
  };

  // `spe` may be the PPE.
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
  // These leave the event open for its arguments.
  void begin_command(char phase, unsigned spe, std::uint64_t number, const char* opcode, std::uint64_t at);
  void begin_instant(unsigned spe, std::string_view category, std::string_view name, std::uint64_t at);
  void site_argument(const CallSite& site);

  unsigned spes_;
  std::uint64_t clock_hz_;
  TraceEvents events_;
  std::uint64_t arrows_ = 0;
  std::vector<Interval> computing_;            ///< by SPE, cycles: the stretch that may go on
  std::vector<std::vector<Message>> messages_; ///< by SPE, then the PPE's
};

} // namespace celltrace::cell_emu
