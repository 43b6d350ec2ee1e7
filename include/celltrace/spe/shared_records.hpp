// SharedRecords: arrays in main memory that the PPE and a machine's SPEs both use, even if their byte orders
// differ.
#pragma once

#include "celltrace/spe/byte_order.hpp"
#include "celltrace/spe/types.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

namespace celltrace {

/// An array of a number type, or of a record that has fields_of(). The PPE uses the array in the host's byte
/// order, SPEs in the SPUs'. If these orders are equal there is one array, and publish() and fetch() do
/// nothing. Otherwise there are two arrays: the SPEs see the PPE's writes after publish(), the PPE sees the
/// SPEs' writes after fetch().
///
/// Thread safety: as a standard container; SPEs count as threads that use the array at ea().
template <class Record> class SharedRecords {
  static_assert(std::is_trivially_copyable_v<Record> && alignof(Record) <= kLineBytes);

public:
  /// Makes an empty array.
  SharedRecords() = default;
  /// Makes an array of `count` zeroed records for a machine whose SPUs have the byte order `spe_order`.
  /// Throws std::bad_alloc.
  SharedRecords(std::size_t count, std::endian spe_order) : converts_(spe_order != std::endian::native) {
    resize(count);
    clear();
  }

  std::size_t size() const noexcept { return count_; }
  std::span<Record> all() noexcept { return {data(), count_}; }
  std::span<const Record> all() const noexcept { return {data(), count_}; }
  Record& operator[](std::size_t index) noexcept { return data()[index]; }
  const Record& operator[](std::size_t index) const noexcept { return data()[index]; }

  /// Returns the effective address of a record for the SPEs. The first record is 128-byte aligned; the memory
  /// includes the whole cache line of the last record.
  ea_t ea(std::size_t index = 0) const noexcept {
    const Line* lines = converts_ ? theirs_.get() : ours_.get();
    return reinterpret_cast<std::uintptr_t>(lines) + index * sizeof(Record);
  }

  /// Copies the PPE's array to the SPEs' array.
  void publish() noexcept {
    if (converts_) copy(ours_.get(), theirs_.get());
  }
  /// Copies the SPEs' array to the PPE's array.
  void fetch() noexcept {
    if (converts_) copy(theirs_.get(), ours_.get());
  }

  /// Sets all records to zero on both sides.
  void clear() noexcept {
    std::fill_n(ours_.get(), lines_of(count_), Line{});
    if (converts_) std::fill_n(theirs_.get(), lines_of(count_), Line{});
  }
  /// Replaces all records, on both sides; the addresses may change. Throws std::bad_alloc.
  void assign(std::span<const Record> records) {
    resize(records.size());
    std::copy(records.begin(), records.end(), data());
    publish();
  }

private:
  struct alignas(kLineBytes) Line {
    std::byte bytes[kLineBytes];
  };

  static constexpr std::size_t lines_of(std::size_t count) {
    return (count * sizeof(Record) + kLineBytes - 1) / kLineBytes;
  }
  Record* data() const noexcept { return reinterpret_cast<Record*>(ours_.get()); }

  /// Makes room for `count` records, whose contents are indeterminate.
  void resize(std::size_t count) {
    const std::size_t lines = lines_of(count);
    if (lines > capacity_) {
      auto ours = std::make_unique<Line[]>(lines);
      if (converts_) theirs_ = std::make_unique<Line[]>(lines);
      ours_ = std::move(ours);
      capacity_ = lines;
    }
    count_ = count;
  }
  void copy(const Line* from, Line* to) const noexcept {
    if (count_ == 0) return; // the arrays may be null
    std::memcpy(to, from, count_ * sizeof(Record));
    auto* records = reinterpret_cast<Record*>(to);
    std::for_each(records, records + count_, [](Record& record) { reverse_bytes(record); });
  }

  bool converts_ = false;
  std::size_t count_ = 0, capacity_ = 0; ///< records, and lines that fit into the allocated memory
  std::unique_ptr<Line[]> ours_, theirs_;
};

} // namespace celltrace
