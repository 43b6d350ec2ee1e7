// The words of a scene, numbered, with their meaning in the language.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>

#include "pov/block.hpp"
#include "pov/token.hpp"

namespace celltrace::pov {

/// The preprocessor's words, which follow a #.
enum class Directive : std::uint8_t {
  none,
  break_,
  case_,
  debug,
  declare,
  default_,
  else_,
  elseif,
  end,
  error,
  fclose_,
  fopen_,
  for_,
  if_,
  ifdef,
  ifndef,
  include,
  local,
  macro,
  range,
  read_,
  render,
  statistics,
  switch_,
  undef,
  version,
  warning,
  while_,
  write_,
  unsupported, ///< POV-Ray's, but not this program's
};

/// Returns whether a directive needs an #end.
bool opens_block(Directive directive);

class Names {
public:
  /// Token and detail of a reserved word in a block.
  struct Meaning {
    int token = 0;
    int detail = 0; ///< what the token says apart from its kind: which function, constant or colour model
  };
  using Meanings = std::array<Meaning, kBlocks>; ///< index: Block
  struct Entry {
    std::string text;
    int token = 0;      ///< the grammar's token for a reserved word, 0 for a free one
    int detail = 0;     ///< distinguishes words of one token: which function, constant or colour model
    int component = -1; ///< meaning behind a dot: component 0 to 4, 5 for grey, -1 for none
    bool is_unsupported = false; ///< reserved for a feature that this program lacks
    Directive directive = Directive::none;
    const Meanings* in_blocks = nullptr; ///< meanings of a reserved word in blocks

    const Meaning& in(Block block) const { return (*in_blocks)[static_cast<std::size_t>(block)]; }
  };

  /// Adds the reserved words.
  Names();

  NameId intern(std::string_view text);
  bool is_reserved(std::string_view text) const;
  const Entry& operator[](NameId name) const { return entries_[name]; }
  const std::string& text(NameId name) const { return entries_[name].text; }
  std::size_t size() const { return entries_.size(); }

private:
  std::deque<Entry> entries_; // a deque, so that the views in numbers_ stay valid
  std::unordered_map<std::string_view, NameId> numbers_;
};

} // namespace celltrace::pov
