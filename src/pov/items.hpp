// Items of blocks: the words inside finish { }, camera { } and the like, with what stands behind each. An
// item is one row of its block's table: its word, the form of its values and the function that sets what it
// says. The words mean something in their blocks only: TokenStream knows which block it is in, and gives the
// grammar one token for each form.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pov/block.hpp"
#include "pov/literals.hpp"
#include "pov/location.hpp"
#include "pov/session.hpp"

namespace celltrace::pov {

/// Forms of the values behind an item's word.
enum class ItemForm : std::uint8_t {
  word,            ///< nothing
  value,           ///< a number or a vector
  option,          ///< a number, or nothing
  pair,            ///< two values
  share,           ///< a number, which may have `albedo` in front
  colour,          ///< a colour or a number
  colour_or_black, ///< a colour, a number, or nothing
  list             ///< a list in braces that begins with its length
};

struct ItemWord {
  const char* word;
  ItemForm form;
  bool is_ignored; ///< its values change nothing
};

/// Lists the rows of a block's own table; a row's place is the item's number.
std::vector<ItemWord> item_words(Block block);
/// Returns the block whose table also belongs to `block`; Block::none if `block` has only its own table.
Block base_of(Block block);

/// An item as written. The type is small, because each entry of the grammar's stack has room for an item.
struct Item {
  int row = 0; ///< row_of()
  Location where;
  bool has_value = false;
  bool is_albedo = false;
  ShapeArgument value = {};
  std::shared_ptr<const ShapeArgument> second = nullptr; ///< second value of a pair

  Block block() const { return static_cast<Block>(row / kRows); }
  std::size_t number() const { return static_cast<std::size_t>(row % kRows); }

  static constexpr int kRows = 256;
  static int row_of(Block block, int number) { return static_cast<int>(block) * kRows + number; }
};
Item item(int row, const Location& where);
Item item(int row, const Location& where, const Quantity& value, const Location& value_where);
Item item(int row, const Location& where, const ShapeArgument& first, const ShapeArgument& second);

/// The values of an item, checked as its setter wants them.
class ItemValues {
public:
  ItemValues(Session& session, const Item& item) : session_(session), item_(item) {}

  Session& session() const { return session_; }
  const Location& where() const { return item_.where; }
  const Location& value_where() const { return item_.value.where; }
  const Quantity& quantity() const { return item_.value.value; }
  bool is_albedo() const { return item_.is_albedo; }

  double number() const { return session_.number(quantity(), value_where()); }
  double second_number() const { return session_.number(item_.second->value, item_.second->where); }
  double number_or_0() const { return session_.number_or_0(quantity(), value_where()); }
  double option() const { return item_.has_value ? number() : 1; }
  bool flag() const { return is_true(option()); }
  Vec3 vector() const { return session_.vector(quantity(), value_where()); }
  Vec3 colour() const { return session_.colour(quantity(), value_where()).rgb; }
  Vec3 light() const { return session_.light(quantity(), value_where()).rgb; }

private:
  Session& session_;
  const Item& item_;
};

/// One row of a table of items that say something about a T.
template <class T> struct ItemRow {
  const char* word;
  ItemForm form;
  void (*set)(T&, const ItemValues&);
};

/// Stores what `get`, a member of ItemValues, returns in a member of the target, or in a member of that.
template <auto get, auto... members, class T> void store(T& target, const ItemValues& values) {
  // clang-format off
  (target .* ... .* members) = (values.*get)();
  // clang-format on
}
/// Sets a flag for a word without values.
template <auto member, class T> void set_true(T& target, const ItemValues&) {
  target.*member = true;
}

/// For rows without effect: POV-Ray takes the word.
template <class T> void ignore(T&, const ItemValues&) {
}
/// For rows without effect whose value must be a number.
template <class T> void ignore_number(T&, const ItemValues& values) {
  values.option();
}

template <class T, std::size_t count> std::vector<ItemWord> words_of(const ItemRow<T> (&rows)[count]) {
  std::vector<ItemWord> words;
  for (const ItemRow<T>& row : rows)
    words.push_back({row.word, row.form, row.set == ignore<T> || row.set == ignore_number<T>});
  return words;
}

/// Sets what an item says.
template <class T, std::size_t count>
void apply(const ItemRow<T> (&rows)[count], Session& session, T& target, const Item& item) {
  rows[item.number()].set(target, ItemValues(session, item));
}

} // namespace celltrace::pov
