// Converts records of main storage to the byte order of a machine's SPUs (Machine::byte_order()) and back.
//
// A record's fields are listed once, in the return type of a function in the record's namespace that is
// declared but never defined:
//
//   struct alignas(16) Task { ea_t blocks; uint32_t count; float scale; };
//   FieldList<&Task::blocks, &Task::count, &Task::scale> fields_of(const Task&);
//
// The widths follow from the fields' types. A list that omits a field or names a field twice does not
// compile, nor does a record with padding: declare padding as a field.
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

/// All data members of a record, which may be numbers, enumerations, other records with a field list, and
/// arrays of these.
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
  /// Returns true if `holds` is true for the type of every field.
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

/// Returns true if all numbers in a T have 32 bits, so that a T can be handled as an array of words.
template <class T> consteval bool consists_of_words() {
  if constexpr (std::is_array_v<T>)
    return consists_of_words<std::remove_all_extents_t<T>>();
  else if constexpr (HasFields<T>)
    return FieldsOf<T>::all([]<class Field>() { return consists_of_words<Field>(); });
  else
    return !std::is_class_v<T> && sizeof(T) == 4;
}

/// Reverses the bytes of a number, or of every number in an array or a record. Its own inverse. Use a value
/// with reversed bytes for memcpy() and DMA only: its floats may be signalling NaNs.
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
