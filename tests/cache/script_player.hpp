// A program that plays a script: it asks a software cache for one thing after the other, holds what it finds
// against what it should find, and reports what the cache counted. Kernel dialect.
#pragma once

#include "celltrace/cache.hpp"
#include "script_records.hpp"

#include <new>
#include <stdint.h>

namespace celltrace::test {

/// Room for an object that comes later. What was there before is forgotten.
template <class T> class Later {
public:
  template <class... Arguments> void make(Arguments&&... arguments) {
    object_ = new (static_cast<void*>(bytes_)) T(static_cast<Arguments&&>(arguments)...);
  }
  T& operator*() { return *object_; }
  T* operator->() { return object_; }

private:
  alignas(T) uint8_t bytes_[sizeof(T)];
  T* object_ = nullptr;
};

/// The cache of a task, and what has been found there.
template <class Spu, class Options> class CachePlayer {
public:
  CachePlayer(Spu& spu, const CacheTask& task)
      : spu_(spu), memory_(task.memory), outgoing_(spu.template allocate<uint32_t>(4, 16)),
        items_(spu.template allocate<CacheEntry>(kMaxItems)), free_(spu.mark()),
        cache_(spu, config_of(task), task.memory),
        local_store_bytes_(static_cast<uint32_t>(spu.mark() - free_)) {}

  void play(const CacheEntry& entry) {
    if (!read(entry) && !change(entry) && !write(entry)) spu_.halt(HaltCode::bad_argument);
    ++played_;
  }

  void report(CacheReport& report) const {
    report.played = played_;
    report.wrong = wrong_;
    report.first_wrong = first_wrong_;
    report.local_store_bytes = local_store_bytes_;
    for (uint32_t kind = 0; kind < Cache::kKinds; ++kind) {
      report.hits[kind] = cache_.counters(kind).hits;
      report.misses[kind] = cache_.counters(kind).misses;
    }
    if constexpr (Options::write_back && !Spu::direct_memory) report.written_back = cache_.written_back();
  }

private:
  using Cache = SoftwareCache<Spu, uint32_t, Options>;
  using Run = WordRun<Spu, uint32_t, Options>;

  static constexpr uint32_t kTag = 1;

  static CacheConfig config_of(const CacheTask& task) {
    CacheConfig config =
        CacheConfig::of(task.ways, task.sets, static_cast<CacheReplacement>(task.replacement));
    config.enabled = task.enabled != 0;
    config.first_tag = task.first_tag;
    config.tag_count = task.tag_count;
    return config;
  }

  bool read(const CacheEntry& entry) {
    const uint32_t offset = entry.offset;
    const uint32_t kind = entry.kind;
    switch (entry.step) {
    case CacheStep::read:
      expect(entry, cache_.word(offset, kind));
      return true;
    case CacheStep::read_byte:
      expect(entry, *cache_.template get<uint8_t>(offset, kind));
      return true;
    case CacheStep::read_block:
      expect(entry, sum_of_words(cache_.template copy<CacheBlock>(offset, kind).words, 4));
      return true;
    case CacheStep::read_line:
      expect(entry, sum_of_words(cache_.template get<CacheLine>(offset, kind)->words, kLineBytes / 4));
      return true;
    case CacheStep::get:
      pointer_.make(cache_.template get<uint32_t>(offset, kind));
      plain_ = *pointer_;
      expect(entry, *plain_);
      return true;
    case CacheStep::use:
      expect(entry, **pointer_);
      return true;
    case CacheStep::use_plain:
      expect(entry, *plain_);
      return true;
    case CacheStep::item:
      items_[item_count_++] = entry;
      return true;
    case CacheStep::fetch:
      fetch();
      return true;
    case CacheStep::lanes:
      lanes(entry);
      return true;
    case CacheStep::run:
      run_.make(cache_, offset, entry.value, kind);
      return true;
    case CacheStep::next:
      expect(entry, run_->empty() ? ~entry.value : run_->next());
      return true;
    case CacheStep::prefetch:
      cache_.prefetch(offset);
      return true;
    case CacheStep::settle:
      cache_.settle();
      return true;
    default:
      return false;
    }
  }

  bool change(const CacheEntry& entry) {
    switch (entry.step) {
    case CacheStep::synchronize:
      cache_.synchronize(entry.offset, entry.value);
      return true;
    case CacheStep::synchronize_all:
      cache_.synchronize_all();
      return true;
    case CacheStep::invalidate_all:
      cache_.invalidate_all();
      return true;
    case CacheStep::reset_counters:
      cache_.reset_counters();
      return true;
    case CacheStep::change: {
      // A word has the same place in its quadword on both sides of a transfer.
      uint32_t* const word = outgoing_ + (entry.offset / 4 & 3);
      *word = entry.value;
      spu_.put(word, memory_ + entry.offset, sizeof *word, kTag);
      spu_.wait_all(1u << kTag);
      return true;
    }
    default:
      return false;
    }
  }

  bool write(const CacheEntry& entry) {
    if constexpr (Options::write_back) {
      switch (entry.step) {
      case CacheStep::write_byte:
        cache_.write(entry.offset, static_cast<uint8_t>(entry.value), entry.kind);
        return true;
      case CacheStep::write_word:
        cache_.write(entry.offset, entry.value, entry.kind);
        return true;
      case CacheStep::write_block:
        cache_.write(entry.offset, rising<CacheBlock>(entry.value), entry.kind);
        return true;
      case CacheStep::write_line:
        cache_.write(entry.offset, rising<CacheLine>(entry.value), entry.kind);
        return true;
      case CacheStep::flush:
        cache_.flush();
        return true;
      default:
        break;
      }
    }
    return false;
  }
  template <class Words> static Words rising(uint32_t first) {
    Words all;
    for (uint32_t& word : all.words)
      word = first++;
    return all;
  }

  void fetch() {
    uint32_t offsets[kMaxItems];
    for (uint32_t i = 0; i < item_count_; ++i)
      offsets[i] = items_[i].offset;
    cache_.fetch(offsets, item_count_);
    item_count_ = 0;
  }
  void lanes(const CacheEntry& entry) {
    alignas(64) int32_t words[kSimdLanes];
    for (uint32_t lane = 0; lane < kSimdLanes; ++lane)
      words[lane] = static_cast<int32_t>(items_[lane].offset);
    cache_.words(Cache::Lanes::load(words), entry.value, entry.kind).store(words);
    for (uint32_t lane = 0; lane < kSimdLanes; ++lane) {
      if ((entry.value >> lane & 1) != 0) expect(items_[lane], static_cast<uint32_t>(words[lane]));
    }
    item_count_ = 0;
  }

  /// `entry` is one of the script's, or its copy among the items.
  void expect(const CacheEntry& entry, uint32_t found) {
    if (found == entry.value) return;
    if (wrong_++ == 0) first_wrong_ = played_;
  }

  Spu& spu_;
  ea_t memory_;
  uint32_t* outgoing_;
  CacheEntry* items_;
  uint8_t* free_;
  Cache cache_;
  uint32_t local_store_bytes_;
  uint32_t item_count_ = 0;
  Later<typename Cache::template Pointer<uint32_t>> pointer_;
  const uint32_t* plain_ = nullptr;
  Later<Run> run_;
  uint32_t wrong_ = 0;
  uint32_t first_wrong_ = 0;
  uint32_t played_ = 0;
};

template <class Spu, class Options> void play_script(Spu& spu, const CacheTask& task) {
  constexpr uint32_t kTag = 0;
  constexpr uint32_t kPiece = 128;
  CacheEntry* const piece = spu.template allocate<CacheEntry>(kPiece);
  CacheReport* const report = spu.template allocate<CacheReport>();
  CachePlayer<Spu, Options> player(spu, task);
  for (uint32_t first = 0; first < task.entries; first += kPiece) {
    const uint32_t left = task.entries - first;
    const uint32_t count = left < kPiece ? left : kPiece;
    spu.get(piece, task.script + first * sizeof(CacheEntry), count * sizeof(CacheEntry), kTag);
    spu.wait_all(1u << kTag);
    for (uint32_t i = 0; i < count; ++i)
      player.play(piece[i]);
  }
  player.report(*report);
  spu.put(report, task.report, sizeof(CacheReport), kTag);
  spu.wait_all(1u << kTag);
}

/// The program; `argument` is the ea of the CacheTasks.
template <class Spu> void cache_scripts(Spu& spu, ea_t argument) {
  CacheTask* const task = spu.template allocate<CacheTask>();
  spu.get(task, argument + spu.id() * sizeof(CacheTask), sizeof(CacheTask), 0);
  spu.wait_all(1);
  switch (task->flavour) {
  case CacheFlavour::plain:
    return play_script<Spu, CacheOptions>(spu, *task);
  case CacheFlavour::checked:
    return play_script<Spu, CheckedCacheOptions>(spu, *task);
  case CacheFlavour::write_back:
    return play_script<Spu, WriteBackCacheOptions>(spu, *task);
  }
}

} // namespace celltrace::test
