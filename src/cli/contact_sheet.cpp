#include "cli/contact_sheet.hpp"

#include "cli/output_files.hpp"

#include <algorithm>
#include <cstdio>

namespace celltrace::cli {

namespace {

/// Returns a text escaped for HTML, also between quotes.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
    case '&':
      out += "&amp;";
      break;
    case '<':
      out += "&lt;";
      break;
    case '>':
      out += "&gt;";
      break;
    case '"':
      out += "&quot;";
      break;
    default:
      out += c;
    }
  }
  return out;
}

/// Returns a file's name as a relative URL, in which special characters are escaped.
std::string url_of(const std::string& name) {
  std::string url = "./";
  for (const char c : name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                          c == '.' || c == '-' || c == '_';
    char code[4];
    std::snprintf(code, sizeof code, "%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
    url += is_plain ? std::string(1, c) : std::string(code);
  }
  return url;
}

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>celltrace: contact sheet</title>
<style>
body { font: 14px/1.4 sans-serif; margin: 1.5em; background: #f4f4f4; color: #222 }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(220px, 1fr)); gap: 1em }
figure { margin: 0; padding: .6em; background: #fff; border-radius: 4px; overflow-wrap: anywhere }
img { width: 100%; display: block; background: repeating-conic-gradient(#ddd 0 25%, #fff 0 50%) 0 / 16px 16px }
pre { white-space: pre-wrap; margin: 0; color: #a00; font-size: 12px }
figcaption { margin-top: .4em } small { color: #666 }
</style>
)";

std::string figure_of(const SheetEntry& entry) {
  const std::string url = url_of(entry.picture);
  std::string figure = "<figure>";
  if (entry.state == SheetEntry::State::failed)
    figure += "<pre>" + escaped(entry.text) + "</pre>";
  else
    figure += "<a href=\"" + url + "\"><img src=\"" + url + "\" alt=\"\" loading=\"lazy\"></a>";
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.2f s", entry.seconds);
  return figure + "<figcaption>" + escaped(entry.scene) + " <small>" + seconds +
         (entry.state == SheetEntry::State::partial ? ", partial" : "") + "</small></figcaption></figure>\n";
}

} // namespace

std::size_t ContactSheet::count(SheetEntry::State state) const {
  return static_cast<std::size_t>(std::count_if(
      entries_.begin(), entries_.end(), [&](const SheetEntry& entry) { return entry.state == state; }));
}

std::size_t ContactSheet::count_unsupported() const {
  return static_cast<std::size_t>(std::count_if(
      entries_.begin(), entries_.end(), [](const SheetEntry& entry) { return entry.is_unsupported; }));
}

std::string ContactSheet::page() const {
  std::string page = kHead;
  page += "<p>" + std::to_string(count(SheetEntry::State::done)) + " of " + std::to_string(entries_.size()) +
          " scenes rendered";
  if (const std::size_t unsupported = count_unsupported(); unsupported != 0)
    page += "; " + std::to_string(unsupported) +
            " use what is not supported yet: <code>--lenient</code> renders them without it";
  page += "</p>\n<main>\n";
  for (const SheetEntry& entry : entries_)
    page += figure_of(entry);
  return page + "</main>\n</html>\n";
}

void ContactSheet::write(const std::filesystem::path& path) const {
  write_report(path.string(), page());
}

} // namespace celltrace::cli
