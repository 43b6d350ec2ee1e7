// Errors about POV-Ray's switches and settings.
#pragma once

#include "cli/pov_entries.hpp"

#include <string>
#include <string_view>

namespace celltrace::cli {

/// Returns a switch or a setting in quotes for messages; shortened if it is long.
std::string shown(std::string_view text);

/// Throws an InputError that begins with the entry.
[[noreturn]] void fail(const PovEntry& entry, const std::string& what);
/// Throws the InputError of an entry that POV-Ray does not have.
[[noreturn]] void fail_as_unknown(const PovEntry& entry);
/// Throws the InputError of an entry without its value; `what` describes the value.
[[noreturn]] void fail_without(const PovEntry& entry, const std::string& what);

/// Returns the entry's value. Throws the InputError of fail_without() if it is empty.
const std::string& needed(const PovEntry& entry, const char* what);

} // namespace celltrace::cli
