// Names of a scene's objects, and their places in its files.
#pragma once

#include "celltrace/pov.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace celltrace::viewer {

/// The names and places, in some 30 bytes an object, because scenes may have millions.
class ObjectNames {
public:
  struct Place {
    std::string_view file; ///< without folders
    std::uint32_t line;
  };

  /// Adds an object; objects must come in the order of their indices.
  void add(Index object, const ObjectOrigin& origin);

  bool contains(Index object) const { return object < entries_.size(); }
  const char* kind(Index object) const { return entries_[object].kind; }
  const std::string& name(Index object) const { return texts_[entries_[object].name]; } ///< empty: none
  Place written(Index object) const;
  Place placed(Index object) const;
  /// Returns "sphere 'Ball' at a.inc:3, placed at s.pov:12"; for an unknown object its number.
  std::string describe(Index object) const;

private:
  struct Entry {
    const char* kind;
    std::uint32_t name, file, line, placed_file, placed_line;
  };
  std::uint32_t number_of(std::string_view text);

  std::vector<Entry> entries_;
  std::vector<std::string> texts_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
};

} // namespace celltrace::viewer
