// The trace file: valid, complete, and such that Perfetto draws all of it.
#include "backends/cell_emu/trace.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace celltrace::cell_emu {
namespace {

using Json = nlohmann::json;

constexpr double kClock = 3.2e9;

/// What a trace of two SPEs contains after `actions`.
template <class Actions> std::string text_of_trace(Actions actions, double clock_hz = kClock) {
  std::ostringstream out;
  {
    Trace trace(out, 2, clock_hz);
    actions(trace);
  }
  return out.str();
}

std::vector<Json> events_in(const std::string& text) {
  return Json::parse(text).at("traceEvents").get<std::vector<Json>>();
}

template <class Actions> std::vector<Json> events_of(Actions actions, double clock_hz = kClock) {
  return events_in(text_of_trace(actions, clock_hz));
}

std::vector<Json> with_phase(const std::vector<Json>& events, const std::string& phase) {
  std::vector<Json> found;
  for (const Json& event : events)
    if (event.at("ph") == phase) found.push_back(event);
  return found;
}

/// Threads by name, of the events' own metadata.
std::map<std::string, unsigned> threads(const std::vector<Json>& events) {
  std::map<std::string, unsigned> ids;
  for (const Json& event : with_phase(events, "M"))
    if (event.at("name") == "thread_name") ids[event.at("args").at("name")] = event.at("tid");
  return ids;
}

long long nanoseconds(const Json& microseconds) {
  return std::llround(microseconds.get<double>() * 1000);
}

struct Slice {
  long long begin, end;
  unsigned thread;
  bool holds(long long at, unsigned of_thread) const {
    return of_thread == thread && begin <= at && at < end;
  }
};

Slice slice_of(const Json& event) {
  const long long begin = nanoseconds(event.at("ts"));
  return {begin, begin + nanoseconds(event.at("dur")), event.at("tid")};
}

/// No two slices of a thread overlap but where one holds the other.
bool nested(const std::vector<Json>& events) {
  std::vector<Slice> slices;
  for (const Json& event : with_phase(events, "X"))
    slices.push_back(slice_of(event));
  for (const Slice& a : slices)
    for (const Slice& b : slices)
      if (a.thread == b.thread && a.begin < b.begin && b.begin < a.end && a.end < b.end) return false;
  return true;
}

TEST_CASE("an empty trace names the PPE, the SPEs and their MFCs") {
  const std::string text = text_of_trace([](Trace&) {});
  CHECK(Json::parse(text).at("otherData").at("clock_hz") == 3'200'000'000);
  const auto events = events_in(text);

  const auto ids = threads(events);
  for (const char* name : {"PPE", "SPE 0", "SPE 0 messages", "SPE 1", "SPE 1 messages", "MFC 0", "MFC 1"})
    CHECK(ids.count(name) == 1);
  std::set<unsigned> different;
  for (const auto& [name, id] : ids)
    different.insert(id);
  CHECK(different.size() == ids.size());
  CHECK(different.count(0) == 0);

  std::set<std::string> processes;
  for (const Json& event : events)
    if (event.at("name") == "process_name") processes.insert(event.at("args").at("name"));
  CHECK(processes == std::set<std::string>{"Cell", "MFC 0", "MFC 1"});
}

TEST_CASE("times are microseconds of the given clock, to the nanosecond") {
  const auto begin_and_length = [](double clock, std::uint64_t begin, std::uint64_t end) {
    const auto events = with_phase(events_of([&](Trace& t) { t.wait(0, "w", begin, end); }, clock), "X");
    return std::pair(events.at(0).at("ts").get<double>(), events.at(0).at("dur").get<double>());
  };
  CHECK(begin_and_length(3.2e9, 32, 3232) == std::pair(0.010, 1.000));
  CHECK(begin_and_length(1e9, 1, 5) == std::pair(0.001, 0.004));
  // Hours of virtual time, at a clock that does not divide a second.
  const std::uint64_t long_time = 3'192'000'000ull * 40'000;
  CHECK(begin_and_length(3.192e9, long_time, long_time + 3192) == std::pair(40'000e6, 1.000));
}

TEST_CASE("computing goes on across calls, waits interrupt it, and nothing is empty") {
  const auto events = events_of([](Trace& t) {
    t.compute(0, 0, 320);
    t.compute(1, 0, 640);
    t.compute(0, 320, 640);
    t.compute(0, 640, 640);
    t.wait(0, "wait for tag group", 640, 960);
    t.wait(0, "wait for mailbox", 960, 960);
    t.compute(0, 960, 1280);
  });
  std::vector<std::tuple<std::string, long long, long long>> first;
  const unsigned spe_0 = threads(events).at("SPE 0");
  for (const Json& event : with_phase(events, "X"))
    if (event.at("tid") == spe_0)
      first.emplace_back(event.at("name"), slice_of(event).begin, slice_of(event).end);
  std::sort(first.begin(), first.end(),
            [](const auto& a, const auto& b) { return std::get<1>(a) < std::get<1>(b); });
  REQUIRE(first.size() == 3);
  CHECK(first[0] == std::tuple("compute", 0, 200));
  CHECK(first[1] == std::tuple("wait for tag group", 200, 300));
  CHECK(first[2] == std::tuple("compute", 300, 400));
  CHECK(with_phase(events, "X").size() == 4);
  CHECK(nested(events));
}

TEST_CASE("commands begin and end under a number of their own, and may overlap") {
  const CallSite site{"/some/where/kernel.hpp", 12};
  const auto events = events_of([&](Trace& t) {
    t.dma(1, 2, "get", 5, 0x18080, 4096, "main memory", 0, 100, 5000, site);
    t.dma(1, 1, "sndsig", 31, 0x1008C, 4, "signal 2", 0, 90, 700, {});
    t.dma(0, 2, "put", 5, 0x20000, 128, "local store", 1, 200, 200, site);
  });
  std::map<std::string, std::pair<Json, Json>> commands;
  for (const Json& event : with_phase(events, "b"))
    commands[event.at("id")].first = event;
  for (const Json& event : with_phase(events, "e"))
    commands[event.at("id")].second = event;
  REQUIRE(commands.size() == 3);
  std::map<std::string, Json> by_name;
  for (const auto& [id, ends] : commands) {
    const auto& [begin, end] = ends;
    for (const char* key : {"name", "cat", "pid", "tid"})
      CHECK(begin.at(key) == end.at(key));
    CHECK(begin.at("ts").get<double>() <= end.at("ts").get<double>());
    by_name[begin.at("name")] = begin;
  }
  const auto ids = threads(events);
  CHECK(by_name.at("get").at("tid") == ids.at("MFC 1"));
  CHECK(by_name.at("put").at("tid") == ids.at("MFC 0"));
  const Json& get = by_name.at("get").at("args");
  CHECK(get == Json{{"command", 2},
                    {"tag", 5},
                    {"lsa", "0x18080"},
                    {"size", 4096},
                    {"target", "main memory"},
                    {"at", "kernel.hpp:12"}});
  const Json& signal = by_name.at("sndsig").at("args");
  CHECK(signal.at("spe") == 0);
  CHECK_FALSE(signal.contains("at"));
  CHECK(by_name.at("put").at("args").at("spe") == 1);
}

TEST_CASE("arrows join the word that is sent to the word that is read") {
  const auto events = events_of([](Trace& t) {
    const std::uint64_t command = t.send(Diagnostic::kPpe, "signal 1", 7, 100);
    const std::uint64_t word = t.send(0, "mailbox", 0xC0FFEE, 1000);
    const std::uint64_t doorbell = t.send(0, "signal 2", 1, 1006);
    t.receive(command, 1, "signal 1", 600);
    t.receive(word, 1, "mailbox", 1500);
    t.receive(doorbell, 1, "signal 2", 1500);
    t.receive(0, 1, "mailbox", 1506);
    t.receive(t.send(1, "outbound mailbox", 2, 1570), Diagnostic::kPpe, "outbound mailbox", 1570);
    t.send(1, "mailbox", 3, 1000000);   // never read
    t.receive(0, 1, "mailbox", 999980); // while the word above is on its way
  });
  CHECK(nested(events));
  std::vector<Slice> slices;
  for (const Json& event : with_phase(events, "X"))
    slices.push_back(slice_of(event));
  CHECK(slices.size() == 11);
  CHECK(
      std::all_of(slices.begin(), slices.end(), [](const Slice& slice) { return slice.begin < slice.end; }));
  const auto in_a_slice = [&](const Json& arrow) {
    return std::any_of(slices.begin(), slices.end(), [&](const Slice& slice) {
      return slice.holds(nanoseconds(arrow.at("ts")), arrow.at("tid"));
    });
  };

  std::map<std::string, Json> starts;
  for (const Json& start : with_phase(events, "s")) {
    CHECK(in_a_slice(start));
    CHECK(starts.emplace(start.at("id"), start).second);
  }
  CHECK(starts.size() == 5);
  const auto ends = with_phase(events, "f");
  CHECK(ends.size() == 4);
  for (const Json& end : ends) {
    CHECK(in_a_slice(end));
    CHECK(end.at("bp") == "e");
    const Json& start = starts.at(end.at("id"));
    CHECK(start.at("name") == end.at("name"));
    CHECK(start.at("cat") == end.at("cat"));
    CHECK(start.at("ts").get<double>() <= end.at("ts").get<double>());
  }
  const auto ids = threads(events);
  CHECK(starts.begin()->second.at("tid") == ids.at("PPE"));
  CHECK(ends.at(0).at("tid") == ids.at("SPE 1 messages"));

  const Json sent = with_phase(events, "X").at(0);
  CHECK(sent.at("name") == "send mailbox");
  CHECK(sent.at("tid") == ids.at("SPE 0 messages"));
  CHECK(sent.at("args").at("value") == "0xc0ffee");
}

TEST_CASE("notes and diagnostics are moments, without addresses of main memory") {
  const std::string text = text_of_trace([](Trace& t) {
    t.note(1, "balance exchange", 3, 3200);
    Diagnostic broken;
    broken.rule = Rule::transfer_size;
    broken.spe = 0;
    broken.command = 4;
    broken.tag = 5;
    broken.lsa = 0x18080;
    broken.size = 20;
    broken.ea = 0x7FFFABCD1230;
    broken.site = {"src/kernel/accel/stream.hpp", 33};
    broken.cycle = 6400;
    broken.text = "SPE 0: get 20 bytes, LS 0x18080 <- EA 0x7fffabcd1230";
    t.diagnostic(broken);
    Diagnostic dead;
    dead.rule = Rule::deadlock;
    dead.spe = Diagnostic::kPpe;
    t.diagnostic(dead);
  });
  CHECK(text.find("abcd") == std::string::npos);
  const auto events = events_in(text);
  const auto moments = with_phase(events, "i");
  REQUIRE(moments.size() == 3);
  const auto ids = threads(events);
  CHECK(moments[0].at("name") == "balance exchange");
  CHECK(moments[0].at("args").at("value") == 3);
  CHECK(moments[0].at("tid") == ids.at("SPE 1"));
  CHECK(nanoseconds(moments[0].at("ts")) == 1000);
  CHECK(moments[1].at("name") == name_of(Rule::transfer_size));
  CHECK(moments[1].at("args").at("rule") == text_of(Rule::transfer_size));
  CHECK(moments[1].at("args").at("at") == "stream.hpp:33");
  CHECK(moments[1].at("args").at("lsa") == "0x18080");
  CHECK(moments[2].at("tid") == ids.at("PPE"));
  CHECK_FALSE(moments[2].at("args").contains("command"));
}

TEST_CASE("any name is text") {
  const std::string name = "a \"quoted\" \\ name,\nin two lines\x01";
  const auto events = events_of([&](Trace& t) { t.note(0, name.c_str(), 0, 0); });
  CHECK(with_phase(events, "i").at(0).at("name") == name);
}

TEST_CASE("what a program computed last is in the file, however it ended") {
  std::ostringstream out;
  try {
    Trace trace(out, 2, kClock);
    trace.compute(0, 0, 3200);
    for (std::uint64_t i = 0; i < 5000; ++i)
      trace.wait(1, "wait for event", 100 * i, 100 * i + 50);
    throw std::runtime_error("in the middle");
  } catch (const std::runtime_error&) {
  }
  const auto events = events_in(out.str());
  CHECK(with_phase(events, "X").size() == 5001);
}

TEST_CASE("a trace that cannot be written leaves the stream failed") {
  std::ostringstream out;
  out.setstate(std::ios::badbit);
  { Trace trace(out, 2, kClock); }
  CHECK_FALSE(out);

  std::ostringstream throwing;
  throwing.setstate(std::ios::badbit);
  CHECK_THROWS_AS(throwing.exceptions(std::ios::badbit), std::ios::failure);
  CHECK_NOTHROW(Trace(throwing, 2, kClock));
}

} // namespace
} // namespace celltrace::cell_emu
