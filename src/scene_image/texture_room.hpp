// Limits on the size of the tables of textures.
#pragma once

#include "celltrace/error.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace celltrace {

/// Limit on records of all textures together, in each table. A map that several textures share
/// is written once for each space that it is in.
inline constexpr std::size_t kMostRecords = std::size_t{1} << 22;

template <class Record>
void make_room(const std::vector<Record>& table, std::size_t count, const char* what) {
  if (table.size() + count > kMostRecords)
    throw InputError("all textures together have more than " + std::to_string(kMostRecords) + ' ' + what);
}

} // namespace celltrace
