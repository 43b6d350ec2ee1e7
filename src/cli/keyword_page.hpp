// What --list-keywords prints, which is also docs/keywords.md.
#pragma once

#include <string>

namespace celltrace::cli {

/// Every word that the scene language reserves, by what becomes of it, in Markdown.
std::string keyword_page();

} // namespace celltrace::cli
