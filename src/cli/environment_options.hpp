// Options of `render` from the environment, for programs that start this one and cannot pass options.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

/// Name of the environment variable.
inline constexpr char kOptionsVariable[] = "CELLTRACE_OPTIONS";

/// Splits a text at blanks as a POSIX shell does: '...' and "..." hold words together, and a backslash quotes
/// the next character; between double quotes it does so only before " \ $ and `. Nothing is expanded. Throws
/// InputError for a quote that is not closed and for a backslash at the end.
std::vector<std::string> split_words(std::string_view text);

/// Returns the words of CELLTRACE_OPTIONS; none if it is not set. Throws InputError, naming the variable, for
/// texts that split_words() rejects, for "--", and if the last word is an option that lacks its value: the
/// latter two would change the meaning of the arguments that follow.
std::vector<std::string> environment_options();

} // namespace celltrace::cli
