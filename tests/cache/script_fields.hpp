// The records of script_records.hpp on the host: what they consist of, for SPEs of another byte order.
#pragma once

#include "script_records.hpp"

#include "celltrace/cache/config.hpp"
#include "celltrace/spe/shared_records.hpp"

#include <cstdint>

namespace celltrace::test {

FieldList<&CacheEntry::step, &CacheEntry::kind, &CacheEntry::offset, &CacheEntry::value>
fields_of(const CacheEntry&);

FieldList<&CacheTask::memory, &CacheTask::script, &CacheTask::report, &CacheTask::entries,
          &CacheTask::flavour, &CacheTask::ways, &CacheTask::sets, &CacheTask::replacement,
          &CacheTask::enabled, &CacheTask::first_tag, &CacheTask::tag_count, &CacheTask::unused>
fields_of(const CacheTask&);

FieldList<&CacheReport::played, &CacheReport::wrong, &CacheReport::first_wrong, &CacheReport::written_back,
          &CacheReport::local_store_bytes, &CacheReport::hits, &CacheReport::misses, &CacheReport::unused>
fields_of(const CacheReport&);

/// To play `script` to a cache of the memory at `memory`; `report`: where the CacheReport goes.
inline CacheTask task_of(CacheFlavour flavour, const CacheConfig& config, ea_t memory,
                         const SharedRecords<CacheEntry>& script, ea_t report) {
  CacheTask task{};
  task.memory = memory;
  task.script = script.ea();
  task.report = report;
  task.entries = static_cast<std::uint32_t>(script.size());
  task.flavour = flavour;
  task.ways = config.ways;
  task.sets = config.sets;
  task.replacement = static_cast<std::uint32_t>(config.replacement);
  task.enabled = config.enabled ? 1 : 0;
  task.first_tag = config.first_tag;
  task.tag_count = config.tag_count;
  return task;
}

} // namespace celltrace::test
