// Converts records of main storage to the byte order of a machine's SPUs (Machine::byte_order()) and back.
//
// A record's fields are listed once, by a function of its namespace that is never
// defined:
//
//   struct alignas(16) Task { ea_t blocks; uint32_t count; float scale; };
//   FieldList<&Task::blocks, &Task::count, &Task::scale> fields_of(const Task&);
//
// The widths follow from the types. A list that leaves a field out, names one twice or leaves padding does
// not compile: give padding a name.
#pragma once

#include "celltrace/spe/types.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

namespace celltrace {

namespace detail {

template <class Member> struct MemberPointer;
template <class R, class F> struct MemberPointer<F R::*> {
  using Record = R;
  using Field = F;
};
template <auto member> using RecordOf = typename MemberPointer<decltype(member)>::Record;
template <auto member> using FieldOf = typename MemberPointer<decltype(member)>::Field;

template <auto a, auto b> consteval bool same_member() {
  if constexpr (std::is_same_v<decltype(a), decltype(b)>)
    return a == b;
  else
    return false;
}
template <auto first, auto... others> consteval bool are_different() {
  if ((same_member<first, others>() || ...)) return false;
  if constexpr (sizeof...(others) != 0)
    return are_different<others...>();
  else
    return true;
}

} // namespace detail

/// All data members of a record: numbers, enumerations, other records with fields, and arrays of all of them.
template <auto first, auto... others> struct FieldList {
  using Record = celltrace::detail::RecordOf<first>;
  static_assert((std::is_same_v<Record, celltrace::detail::RecordOf<others>> && ...),
                "fields of two records");
  static_assert(celltrace::detail::are_different<first, others...>(), "a field is named twice");
  static_assert((sizeof(celltrace::detail::FieldOf<first>) + ... +
                 sizeof(celltrace::detail::FieldOf<others>)) == sizeof(Record),
                "a field of the record is missing in its list, or it has padding");
  static_assert(std::is_trivially_copyable_v<Record>, "a record is copied by DMA");

  template <class Visit> static constexpr void for_each(Record& record, Visit visit) {
    visit(record.*first);
    (visit(record.*others), ...);
  }
  /// Returns whether `holds` is true for the types of all fields.
  template <class Holds> static consteval bool all(Holds holds) {
    return holds.template operator()<celltrace::detail::FieldOf<first>>() &&
           (holds.template operator()<celltrace::detail::FieldOf<others>>() && ...);
  }
};

/// A record with a list of its fields.
template <class T>
concept HasFields = requires(const T& record) {
  fields_of(record);
};
template <HasFields Record> using FieldsOf = decltype(fields_of(std::declval<const Record&>()));

/// Returns true if all numbers of a T have 32 bits, so that it can be handled as an array of words.
template <class T> consteval bool consists_of_words() {
  if constexpr (std::is_array_v<T>)
    return consists_of_words<std::remove_all_extents_t<T>>();
  else if constexpr (HasFields<T>)
    return FieldsOf<T>::all([]<class Field>() { return consists_of_words<Field>(); });
  else
    return !std::is_class_v<T> && sizeof(T) == 4;
}

/// Reverses the bytes of a number, or of every number in an array or a record. Its own inverse. A value with
/// reversed bytes is only good for memcpy() and DMA: floats in it may have any bits.
template <class T> void reverse_bytes(T& value) noexcept {
  if constexpr (std::is_array_v<T>) {
    for (auto& element : value)
      reverse_bytes(element);
  } else if constexpr (HasFields<T>) {
    FieldsOf<T>::for_each(value, [](auto& field) { reverse_bytes(field); });
  } else {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>, "a record needs its fields_of()");
    std::byte bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i)
      std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    std::memcpy(&value, bytes, sizeof(T));
  }
}

/// Converts a value from the host's order to `order`, or back.
template <class T> void reorder(T& value, std::endian order) noexcept {
  if (order != std::endian::native) reverse_bytes(value);
}

FieldList<&SpeAddresses::local_store, &SpeAddresses::signal_1, &SpeAddresses::signal_2,
          &SpeAddresses::in_mailbox>
fields_of(const SpeAddresses&);

} // namespace celltrace
