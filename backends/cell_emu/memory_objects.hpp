// The objects in main memory that the host has registered: commands that touch one have to stay in it.
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

  /// Adds an object. Throws InputError if it has no bytes or overlaps another.
  void add(const MemoryObject& object);
  /// Removes the object at `begin`. Throws InputError if there is none.
  void remove(ea_t begin);

  /// Returns the object that [ea, ea + size) touches and leaves. Fast if there are no objects.
  std::optional<MemoryObject> left_by(ea_t ea, std::uint32_t size) const {
    if (count_.load(std::memory_order_relaxed) == 0) return std::nullopt;
    return find_left_by(ea, size);
  }

private:
  std::optional<MemoryObject> find_left_by(ea_t ea, std::uint32_t size) const;
  /// Returns the first object that ends behind `ea`.
  std::map<ea_t, MemoryObject>::const_iterator first_behind(ea_t ea) const;

  mutable std::shared_mutex mutex_;
  std::map<ea_t, MemoryObject> objects_; ///< key: begin; none overlaps another
  std::atomic<std::size_t> count_{0};
};

} // namespace celltrace::cell_emu
