#include "celltrace/cache/replay.hpp"
#include "celltrace/error.hpp"

#include <bit>
#include <cstddef>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

namespace celltrace {

using cache_trace::Operation;

namespace {

/// A version of a line: when main memory has changed, the line counts as another one.
using Version = std::uint32_t;

constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

/// An event in a set.
struct Event {
  Version version = 0;
  std::size_t next_use = kNever; ///< number of the event that uses the version next
  std::uint32_t kind = 0;
  std::uint32_t times = 0; ///< number of references that it counts as: 0 for a prefetch
  bool reset = false;      ///< true if only the counters are reset
};

/// The events of every set.
class Timetable {
public:
  Timetable(const CacheTrace& trace, std::uint32_t sets) : sets_(sets) {
    for (const CacheRequest& request : trace.requests)
      take(request);
    for (std::vector<Event>& events : sets_)
      look_ahead(events);
  }

  const std::vector<std::vector<Event>>& sets() const { return sets_; }
  std::size_t versions() const { return versions_; }

private:
  void take(const CacheRequest& request) {
    switch (request.operation) {
    case Operation::read:
    case Operation::write:
      return add({version_of(request.line), kNever, request.kind, request.count, false}, request.line);
    case Operation::prefetch:
      return add({version_of(request.line), kNever, 0, 0, false}, request.line);
    case Operation::synchronize:
      std::erase_if(current_, [&](const auto& entry) { return entry.first - request.line < request.count; });
      return;
    case Operation::synchronize_all:
    case Operation::invalidate_all:
      return current_.clear();
    case Operation::reset_counters:
      for (std::vector<Event>& events : sets_)
        events.push_back({0, kNever, 0, 0, true});
      return;
    case Operation::flush:
    case Operation::begin:
    case Operation::end:
      return;
    }
  }
  void add(const Event& event, std::uint32_t line) {
    sets_[cache_set(line * kLineBytes) & (sets_.size() - 1)].push_back(event);
  }
  Version version_of(std::uint32_t line) {
    const auto [entry, is_new] = current_.try_emplace(line, versions_);
    if (is_new) ++versions_;
    return entry->second;
  }
  void look_ahead(std::vector<Event>& events) const {
    std::unordered_map<Version, std::size_t> next;
    for (std::size_t i = events.size(); i-- > 0;) {
      if (events[i].reset) continue;
      const auto [entry, is_last] = next.try_emplace(events[i].version, i);
      if (is_last) continue;
      events[i].next_use = entry->second;
      entry->second = i;
    }
  }

  std::vector<std::vector<Event>> sets_;
  std::unordered_map<std::uint32_t, Version> current_; ///< key: line
  Version versions_ = 0;
};

/// A set with knowledge of the future.
class Set {
public:
  /// Makes the set. `next_use` has room for all versions: for those in the set, the event of their next use.
  Set(std::uint32_t ways, std::vector<std::size_t>& next_use) : ways_(ways), next_use_(next_use) {}

  /// Uses a version; returns true if it was in the set.
  bool use(const Event& event) {
    const bool hit = next_use_[event.version] != kAbsent;
    if (!hit) make_room();
    next_use_[event.version] = event.next_use;
    by_next_use_.emplace(event.next_use, event.version);
    return hit;
  }

  static constexpr std::size_t kAbsent = kNever - 1;

private:
  void make_room() {
    if (lines_ < ways_) {
      ++lines_;
      return;
    }
    // A used version leaves entries with its earlier next uses behind.
    while (next_use_[by_next_use_.top().second] != by_next_use_.top().first)
      by_next_use_.pop();
    next_use_[by_next_use_.top().second] = kAbsent;
    by_next_use_.pop();
  }

  std::uint32_t ways_;
  std::uint32_t lines_ = 0;
  std::vector<std::size_t>& next_use_;
  std::priority_queue<std::pair<std::size_t, Version>> by_next_use_;
};

ReplayResult run(const std::vector<Event>& events, Set& set) {
  ReplayResult result;
  for (const Event& event : events) {
    if (event.reset) {
      result = ReplayResult();
      continue;
    }
    const bool hit = set.use(event);
    if (!hit) ++result.fetched;
    if (event.times == 0) continue;
    result.kinds[event.kind].misses += hit ? 0 : 1;
    result.kinds[event.kind].hits += event.times - (hit ? 0 : 1);
  }
  return result;
}

} // namespace

ReplayResult optimal(const CacheTrace& trace, std::uint32_t ways, std::uint32_t sets) {
  if (ways == 0 || !std::has_single_bit(sets)) throw InputError("cache trace: no cache can have this shape");
  const Timetable timetable(trace, sets);
  std::vector<std::size_t> next_use(timetable.versions(), Set::kAbsent);
  ReplayResult result;
  for (const std::vector<Event>& events : timetable.sets()) {
    Set set(ways, next_use);
    result = result + run(events, set);
  }
  return result;
}

} // namespace celltrace
