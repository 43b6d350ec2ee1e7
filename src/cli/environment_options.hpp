// Options of `render` that a program which starts this one cannot pass: the environment has them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

/// Name of the environment variable.
inline constexpr char kOptionsVariable[] = "CELLTRACE_OPTIONS";

/// Splits a text at blanks as a POSIX shell does: '...' and "..." hold together what is in them, and a
/// backslash takes the next character as it is; between double quotes it does so only before " \ $ and `.
/// Nothing is expanded. Throws InputError for a quote that is not closed and for a backslash at the end.
std::vector<std::string> split_words(std::string_view text);

/// Words of CELLTRACE_OPTIONS; none if it is not set. Throws InputError, naming the variable, for what
/// split_words() refuses, for "--", and if the last word is an option that lacks its value: both would change
/// the meaning of the arguments that follow.
std::vector<std::string> environment_options();

} // namespace celltrace::cli
