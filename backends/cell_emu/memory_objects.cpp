#include "backends/cell_emu/memory_objects.hpp"

#include "celltrace/error.hpp"

#include <iterator>
#include <mutex>
#include <string>

namespace celltrace::cell_emu {
namespace {

std::string describe(const MemoryObject& object) {
  return object.name.empty() ? "an object in main memory" : "the object '" + object.name + "'";
}

} // namespace

MemoryObjects::MemoryObjects(const std::vector<MemoryObject>& objects) {
  for (const MemoryObject& object : objects)
    add(object);
}

std::map<ea_t, MemoryObject>::const_iterator MemoryObjects::first_behind(ea_t ea) const {
  const auto behind = objects_.upper_bound(ea);
  if (behind == objects_.begin()) return behind;
  const auto before = std::prev(behind);
  return ea - before->first < before->second.bytes ? before : behind;
}

void MemoryObjects::add(const MemoryObject& object) {
  if (object.bytes == 0 || object.ea + object.bytes < object.ea)
    throw InputError(describe(object) + " cannot be registered with " + std::to_string(object.bytes) +
                     " bytes");
  const std::lock_guard lock(mutex_);
  const auto next = first_behind(object.ea);
  if (next != objects_.end() && next->first < object.ea + object.bytes)
    throw InputError(describe(object) + " overlaps with " + describe(next->second) +
                     ", which is registered already");
  objects_[object.ea] = object;
  count_ = objects_.size();
}

void MemoryObjects::remove(ea_t begin) {
  const std::lock_guard lock(mutex_);
  if (objects_.erase(begin) == 0) throw InputError("no object is registered that begins at this address");
  count_ = objects_.size();
}

std::optional<MemoryObject> MemoryObjects::find_left_by(ea_t ea, std::uint32_t size) const {
  const std::shared_lock lock(mutex_);
  const auto found = first_behind(ea);
  if (found == objects_.end() || found->first >= ea + size) return std::nullopt;
  const MemoryObject& object = found->second;
  if (ea >= object.ea && ea - object.ea + size <= object.bytes) return std::nullopt;
  return object;
}

} // namespace celltrace::cell_emu
