#include "backends/cell_emu/trace.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>

namespace celltrace::cell_emu {

namespace {

constexpr std::uint64_t kNanosecondsPerSecond = 1'000'000'000;
/// Length of the slice of a message: an arrow has to begin and end at a slice.
constexpr std::uint64_t kMessageNanoseconds = 20;

constexpr unsigned kCellProcess = 1;
constexpr unsigned kFirstMfcProcess = 2;
constexpr unsigned kPpeThread = 1;
constexpr unsigned kFirstSpeThread = 2;

/// Category and name of all arrows; the two ends of an arrow have the same category, name and number.
constexpr std::string_view kArrow = "message";

std::string numbered(std::string_view name, unsigned number) {
  return std::string(name) + " " + std::to_string(number);
}

} // namespace

Trace::Trace(std::ostream& out, unsigned spes, double clock_hz)
    : spes_(spes), clock_hz_(static_cast<std::uint64_t>(std::llround(clock_hz))), events_(out, clock_hz_),
      computing_(spes), messages_(spes + 1) {
  name_process(activity_of(Diagnostic::kPpe), "Cell");
  name_thread(activity_of(Diagnostic::kPpe), "PPE");
  for (unsigned spe = 0; spe < spes; ++spe) {
    name_thread(activity_of(spe), numbered("SPE", spe));
    name_thread(messages_of(spe), numbered("SPE", spe) + " messages");
  }
  for (unsigned spe = 0; spe < spes; ++spe) {
    name_process(mfc_of(spe), numbered("MFC", spe));
    name_thread(mfc_of(spe), numbered("MFC", spe));
  }
}

Trace::~Trace() {
  try {
    for (unsigned spe = 0; spe < spes_; ++spe)
      flush_compute(spe);
    for (unsigned spe = 0; spe < spes_; ++spe)
      draw_messages(spe);
    draw_messages(Diagnostic::kPpe);
    events_.close();
  } catch (const std::exception&) {
    // The stream's owner finds the error in the stream's state.
  }
}

void Trace::compute(unsigned spe, std::uint64_t begin, std::uint64_t end) {
  if (begin == end) return;
  Interval& running = computing_[spe];
  if (running.end != begin) flush_compute(spe);
  if (running.empty()) running.begin = begin;
  running.end = end;
}

void Trace::wait(unsigned spe, const char* what, std::uint64_t begin, std::uint64_t end) {
  if (begin != end) slice(activity_of(spe), what, {begin, end});
}

void Trace::dma(unsigned spe, std::uint64_t number, const char* opcode, std::uint32_t tag, std::uint32_t lsa,
                std::uint32_t size, const char* target, unsigned target_spe, std::uint64_t begin,
                std::uint64_t end, CallSite site) {
  begin_command('b', spe, number, opcode, begin);
  events_.argument("command", number);
  events_.argument("tag", tag);
  events_.argument_in_hex("lsa", lsa);
  events_.argument("size", size);
  events_.argument("target", target);
  if (std::string_view(target) != "main memory") events_.argument("spe", target_spe);
  site_argument(site);
  events_.end();
  begin_command('e', spe, number, opcode, end);
  events_.end();
}

std::uint64_t Trace::send(unsigned from, const char* what, std::uint32_t value, std::uint64_t at) {
  messages_[std::min(from, spes_)].push_back(
      {nanoseconds(at), 's', std::string("send ") + what, ++arrows_, value});
  return arrows_;
}

void Trace::receive(std::uint64_t arrow, unsigned to, const char* what, std::uint64_t at) {
  messages_[std::min(to, spes_)].push_back({nanoseconds(at), 'f', std::string("read ") + what, arrow, 0});
}

void Trace::note(unsigned spe, const char* what, std::uint32_t value, std::uint64_t at) {
  begin_instant(spe, "note", what, at);
  events_.argument("value", value);
  events_.end();
}

void Trace::diagnostic(const Diagnostic& diagnostic) {
  begin_instant(diagnostic.spe, "diagnostic", name_of(diagnostic.rule), diagnostic.cycle);
  events_.argument("rule", text_of(diagnostic.rule));
  if (diagnostic.command != 0) {
    events_.argument("command", diagnostic.command);
    events_.argument("tag", diagnostic.tag);
    events_.argument_in_hex("lsa", diagnostic.lsa);
    events_.argument("size", diagnostic.size);
  }
  site_argument(diagnostic.site);
  if (diagnostic.other_command != 0) {
    events_.argument("other spe", diagnostic.other_spe);
    events_.argument("other command", diagnostic.other_command);
  }
  events_.end();
}

Trace::Track Trace::activity_of(unsigned spe) {
  if (spe == Diagnostic::kPpe) return {kCellProcess, kPpeThread};
  return {kCellProcess, kFirstSpeThread + 2 * spe};
}

Trace::Track Trace::messages_of(unsigned spe) {
  if (spe == Diagnostic::kPpe) return {kCellProcess, kPpeThread};
  return {kCellProcess, kFirstSpeThread + 2 * spe + 1};
}

Trace::Track Trace::mfc_of(unsigned spe) const {
  // All threads have different numbers, also in different processes, because Perfetto tells threads apart by
  // number alone.
  return {kFirstMfcProcess + spe, kFirstSpeThread + 2 * spes_ + spe};
}

std::uint64_t Trace::nanoseconds(std::uint64_t cycles) const {
  // Computed in two parts, so that the products stay below 2^64.
  return cycles / clock_hz_ * kNanosecondsPerSecond + cycles % clock_hz_ * kNanosecondsPerSecond / clock_hz_;
}

void Trace::name_process(Track first_track, std::string_view name) {
  events_.begin('M', first_track.process, first_track.thread);
  events_.text("name", "process_name");
  events_.argument("name", name);
  events_.end();
  events_.begin('M', first_track.process, first_track.thread);
  events_.text("name", "process_sort_index");
  events_.argument("sort_index", first_track.process);
  events_.end();
}

void Trace::name_thread(Track track, std::string_view name) {
  events_.begin('M', track.process, track.thread);
  events_.text("name", "thread_name");
  events_.argument("name", name);
  events_.end();
  events_.begin('M', track.process, track.thread);
  events_.text("name", "thread_sort_index");
  events_.argument("sort_index", track.thread);
  events_.end();
}

void Trace::slice(Track track, std::string_view name, Interval cycles) {
  const std::uint64_t begin = nanoseconds(cycles.begin);
  events_.begin('X', track.process, track.thread);
  events_.time("ts", begin);
  // Not computed from the difference of cycles: rounding could make neighbouring slices overlap, and Perfetto
  // would drop one of the two.
  events_.time("dur", nanoseconds(cycles.end) - begin);
  events_.text("name", name);
  events_.end();
}

void Trace::flush_compute(unsigned spe) {
  Interval& running = computing_[spe];
  if (!running.empty()) slice(activity_of(spe), "compute", running);
  running = {};
}

void Trace::draw_messages(unsigned spe) {
  std::vector<Message>& messages = messages_[std::min(spe, spes_)];
  std::stable_sort(messages.begin(), messages.end(),
                   [](const Message& a, const Message& b) { return a.at < b.at; });
  for (auto message = messages.begin(); message != messages.end(); ++message) {
    // A slice ends where the next slice begins, or is nested in it if both begin together.
    const auto next =
        std::find_if(message, messages.end(), [&](const Message& m) { return m.at != message->at; });
    const std::uint64_t longest = message->at + kMessageNanoseconds;
    draw(*message, messages_of(spe), next == messages.end() ? longest : std::min(longest, next->at));
  }
}

void Trace::draw(const Message& message, Track track, std::uint64_t end) {
  events_.begin('X', track.process, track.thread);
  events_.time("ts", message.at);
  events_.time("dur", end - message.at);
  events_.text("name", message.name);
  if (message.phase == 's') events_.argument_in_hex("value", message.value);
  events_.end();
  if (message.arrow == 0) return;
  events_.begin(message.phase, track.process, track.thread);
  events_.time("ts", message.at);
  events_.text("cat", kArrow);
  events_.text("name", kArrow);
  events_.identifier(message.arrow);
  // Binds the arrow to the enclosing slice, not to the next slice.
  if (message.phase == 'f') events_.text("bp", "e");
  events_.end();
}

void Trace::begin_command(char phase, unsigned spe, std::uint64_t number, const char* opcode,
                          std::uint64_t at) {
  const Track track = mfc_of(spe);
  events_.begin(phase, track.process, track.thread);
  events_.time("ts", nanoseconds(at));
  events_.text("cat", "dma");
  events_.text("name", opcode);
  events_.identifier((std::uint64_t{spe} << 48) + number);
}

void Trace::begin_instant(unsigned spe, std::string_view category, std::string_view name, std::uint64_t at) {
  const Track track = activity_of(spe);
  events_.begin('i', track.process, track.thread);
  events_.time("ts", nanoseconds(at));
  events_.text("s", "t");
  events_.text("cat", category);
  events_.text("name", name);
}

void Trace::site_argument(const CallSite& site) {
  if (site.line == 0) return;
  // The folder, which differs from build to build, is left out.
  const std::string_view file(site.file);
  events_.argument("at",
                   std::string(file.substr(file.find_last_of('/') + 1)) + ":" + std::to_string(site.line));
}

} // namespace celltrace::cell_emu
