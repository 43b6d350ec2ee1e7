#include "cli/replay_command.hpp"

#include "celltrace/cache/replay.hpp"
#include "celltrace/error.hpp"
#include "cli/unreadable_file.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>

#include <nlohmann/json.hpp>

namespace celltrace::cli {

namespace {

std::vector<CacheTrace> read(const ReplayRequest& request) {
  std::ifstream file(request.trace, std::ios::binary);
  if (!file) throw unreadable(request.trace);
  try {
    std::vector<CacheTrace> traces = read_cache_traces(file);
    if (traces.empty()) throw InputError("no cache was used");
    if (request.prefetches) return traces;
    for (CacheTrace& trace : traces)
      trace = without_prefetches(std::move(trace));
    return traces;
  } catch (const InputError& error) {
    throw InputError(request.trace.string() + ": " + error.what());
  }
}

std::string name_of(const CacheConfig& shape) {
  if (!shape.enabled) return "off";
  const char* const policies[] = {"random", "fifo", "lru"};
  return std::to_string(shape.ways) + "x" + std::to_string(shape.sets) + ":" +
         policies[static_cast<unsigned>(shape.replacement)];
}

template <class ReplayOne> ReplayResult sum(const std::vector<CacheTrace>& traces, ReplayOne replay_one) {
  ReplayResult result;
  for (const CacheTrace& trace : traces)
    result = result + replay_one(trace);
  return result;
}

/// The results of optimal replacement, computed once for each shape.
class Limits {
public:
  explicit Limits(const std::vector<CacheTrace>& traces) : traces_(traces) {}
  const ReplayResult& of(std::uint32_t ways, std::uint32_t sets) {
    const auto [entry, is_new] = known_.try_emplace({ways, sets});
    if (is_new)
      entry->second = sum(traces_, [&](const CacheTrace& trace) { return optimal(trace, ways, sets); });
    return entry->second;
  }

private:
  const std::vector<CacheTrace>& traces_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, ReplayResult> known_;
};

struct Row {
  CacheConfig shape;
  ReplayResult result, optimal_in_sets, optimal;
};

std::vector<Row> replay_all(const ReplayRequest& request, const std::vector<CacheTrace>& traces) {
  std::vector<CacheConfig> shapes = request.shapes;
  if (shapes.empty()) shapes.push_back(traces.front().config);
  Limits limits(traces);
  std::vector<Row> rows;
  for (const CacheConfig& shape : shapes) {
    Row row;
    row.shape = shape;
    row.result = sum(traces, [&](const CacheTrace& trace) { return replay(trace, shape); });
    if (shape.enabled) {
      row.optimal_in_sets = limits.of(shape.ways, shape.sets);
      row.optimal = limits.of(shape.lines(), 1);
    } else {
      row.optimal_in_sets = row.optimal = row.result;
    }
    rows.push_back(row);
  }
  return rows;
}

nlohmann::ordered_json to_json(const ReplayResult& result) {
  nlohmann::ordered_json json;
  json["hits"] = result.total().hits;
  json["misses"] = result.total().misses;
  json["hit_rate"] = result.hit_rate();
  json["fetched"] = result.fetched;
  json["written_back"] = result.written_back;
  for (const ReplayResult::Counters& kind : result.kinds)
    json["kinds"].push_back({{"hits", kind.hits}, {"misses", kind.misses}});
  return json;
}

void print_json(const std::vector<Row>& rows) {
  auto json = nlohmann::ordered_json::array();
  for (const Row& row : rows)
    json.push_back({{"cache", name_of(row.shape)},
                    {"replayed", to_json(row.result)},
                    {"optimal_in_its_sets", to_json(row.optimal_in_sets)},
                    {"optimal", to_json(row.optimal)}});
  std::cout << json.dump(2) << std::endl;
}

void print_table(const std::vector<Row>& rows) {
  std::cout << "cache              references       misses      fetched   hit rate   optimal in its sets   "
               "optimal\n";
  for (const Row& row : rows) {
    const ReplayResult::Counters total = row.result.total();
    std::array<char, 160> line{};
    std::snprintf(
        line.data(), line.size(), "%-16s %12llu %12llu %12llu   %7.3f%%              %7.3f%%  %7.3f%%\n",
        name_of(row.shape).c_str(), static_cast<unsigned long long>(total.hits + total.misses),
        static_cast<unsigned long long>(total.misses), static_cast<unsigned long long>(row.result.fetched),
        100 * row.result.hit_rate(), 100 * row.optimal_in_sets.hit_rate(), 100 * row.optimal.hit_rate());
    std::cout << line.data();
  }
  std::cout << std::flush;
}

} // namespace

int run_replay(const ReplayRequest& request) {
  const std::vector<Row> rows = replay_all(request, read(request));
  if (request.json)
    print_json(rows);
  else
    print_table(rows);
  return 0;
}

} // namespace celltrace::cli
