// The objects in main memory that the application has registered. A command that touches an object has to
// stay within it.
#pragma once

#include "celltrace/spe/emulation.hpp"

#include <atomic>
#include <map>
#include <optional>
#include <shared_mutex>
#include <vector>

namespace celltrace::cell_emu {

/// The registered objects. Thread safety: all members from any thread.
class MemoryObjects {
public:
  /// Throws InputError for objects that overlap or have no bytes.
  explicit MemoryObjects(const std::vector<MemoryObject>& objects);

  /// Adds an object. Throws InputError if it has no bytes or overlaps another object.
  void add(const MemoryObject& object);
  /// Removes the object that begins at `begin`. Throws InputError if no object begins there.
  void remove(ea_t begin);

  /// Returns the object that [ea, ea + size) touches but is not within; nothing if there is no such object.
  /// Fast if no objects are registered.
  std::optional<MemoryObject> left_by(ea_t ea, std::uint32_t size) const {
    if (count_.load(std::memory_order_relaxed) == 0) return std::nullopt;
    return find_left_by(ea, size);
  }

private:
  std::optional<MemoryObject> find_left_by(ea_t ea, std::uint32_t size) const;
  /// Returns the first object that ends behind `ea`.
  std::map<ea_t, MemoryObject>::const_iterator first_behind(ea_t ea) const;

  mutable std::shared_mutex mutex_;
  std::map<ea_t, MemoryObject> objects_; ///< by address; no two overlap
  std::atomic<std::size_t> count_{0};
};

} // namespace celltrace::cell_emu
