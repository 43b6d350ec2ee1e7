// What a cache ought to do, said with lists.
#pragma once

#include "celltrace/cache.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace celltrace::test {

/// Says of each reference whether it hits.
class CacheModel {
public:
  explicit CacheModel(const CacheConfig& config) : config_(config), sets_(config.sets) {
    for (Set& set : sets_)
      set.ways.resize(config.ways);
  }

  bool read(std::uint32_t offset) {
    const std::uint32_t line = offset / kLineBytes;
    Set& set = set_of(line);
    const auto way = find(set, line);
    if (!way || set.ways[*way]->out_of_date) {
      fetch(set, way, line);
      return false;
    }
    if (config_.replacement == CacheReplacement::lru) make_youngest(set, *way);
    return true;
  }
  void prefetch(std::uint32_t offset) {
    const std::uint32_t line = offset / kLineBytes;
    Set& set = set_of(line);
    const auto way = find(set, line);
    if (!way || set.ways[*way]->out_of_date) fetch(set, way, line);
  }
  void synchronize(std::uint32_t offset, std::uint32_t bytes) {
    if (bytes == 0) return;
    for (Set& set : sets_) {
      for (auto& way : set.ways) {
        if (!way || way->line < offset / kLineBytes || way->line > (offset + bytes - 1) / kLineBytes)
          continue;
        way->out_of_date = true;
      }
    }
  }
  void invalidate_all() {
    for (Set& set : sets_) {
      for (auto& way : set.ways)
        way.reset();
      set.by_age.clear();
    }
  }

private:
  struct Line {
    std::uint32_t line;
    bool out_of_date;
  };
  struct Set {
    std::vector<std::optional<Line>> ways;
    std::vector<std::size_t> by_age; ///< ways, the oldest first
  };

  Set& set_of(std::uint32_t line) { return sets_[(line ^ line / 64) % config_.sets]; }
  static std::optional<std::size_t> find(const Set& set, std::uint32_t line) {
    for (std::size_t way = 0; way < set.ways.size(); ++way) {
      if (set.ways[way] && set.ways[way]->line == line) return way;
    }
    return std::nullopt;
  }
  void fetch(Set& set, std::optional<std::size_t> way, std::uint32_t line) {
    for (std::size_t free = 0; !way && free < set.ways.size(); ++free) {
      if (!set.ways[free]) way = free;
    }
    if (!way && config_.replacement == CacheReplacement::random)
      way = random_.next_below_power_of_two(config_.ways);
    if (!way) way = set.by_age.front();
    set.ways[*way] = Line{line, false};
    make_youngest(set, *way);
  }
  static void make_youngest(Set& set, std::size_t way) {
    std::erase(set.by_age, way);
    set.by_age.push_back(way);
  }

  CacheConfig config_;
  std::vector<Set> sets_;
  CacheRandom random_;
};

} // namespace celltrace::test
