// The output of --list-keywords, which is also docs/keywords.md.
#pragma once

#include <string>

namespace celltrace::cli {

/// Returns a page in Markdown with every reserved word of the scene language, by its support.
std::string keyword_page();

} // namespace celltrace::cli
