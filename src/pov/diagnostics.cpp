#include "pov/diagnostics.hpp"

#include "celltrace/error.hpp"

#include <string>
#include <utility>
#include <vector>

namespace celltrace::pov {

namespace {

constexpr std::size_t kMostStackLines = 8;

}

std::string Diagnostics::place(const Location& where) const {
  return sources_.name(where.file) + ':' + std::to_string(where.line) + ':' + std::to_string(where.column);
}

void Diagnostics::fail(const Location& where, const std::string& what) const {
  throw SceneError(place(where) + ": error: " + what + stack());
}

void Diagnostics::require_supported(const UnsupportedPtr& unsupported, const Location& used_at) const {
  if (!unsupported) return;
  std::string message = place(unsupported->where) + ": error: " + unsupported->what + " is not supported yet";
  if (unsupported->where != used_at) message += "\n    used at " + place(used_at);
  throw SceneError(message + stack());
}

std::string Diagnostics::stack() const {
  // A file that includes itself, or a macro that calls itself, is one line.
  struct Entry {
    std::string text;
    int times;
  };
  std::vector<Entry> entries;
  const auto& frames = input_.frames();
  for (std::size_t i = frames.size(); i-- > 1;) {
    const Frame& frame = frames[i];
    if (frame.kind == Frame::Kind::loop) continue;
    std::string text = frame.kind == Frame::Kind::file
                           ? "included from "
                           : "in macro '" + names_.text(frame.macro_name) + "' called from ";
    text += sources_.name(frame.opened_at.file) + ':' + std::to_string(frame.opened_at.line);
    if (!entries.empty() && entries.back().text == text)
      ++entries.back().times;
    else
      entries.push_back({std::move(text), 1});
  }
  std::string lines;
  for (std::size_t i = 0; i < entries.size() && i < kMostStackLines; ++i) {
    lines += "\n    " + entries[i].text;
    if (entries[i].times > 1) lines += " (" + std::to_string(entries[i].times) + " times)";
  }
  if (entries.size() > kMostStackLines)
    lines += "\n    and " + std::to_string(entries.size() - kMostStackLines) + " more";
  return lines;
}

} // namespace celltrace::pov
