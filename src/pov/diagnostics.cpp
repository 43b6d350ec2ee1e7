#include "pov/diagnostics.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace celltrace::pov {

namespace {

constexpr std::size_t kMostStackLines = 8;
constexpr std::size_t kMostUnsupported = 50;

} // namespace

std::string quoted_name(std::string_view name) {
  constexpr std::size_t kMost = 200;
  std::string text = "'";
  for (const char c : name.substr(0, kMost))
    text += static_cast<unsigned char>(c) < ' ' || c == 127 ? '?' : c;
  text += name.size() > kMost ? "...'" : "'";
  return text;
}

std::string Diagnostics::place(const Location& where) const {
  return sources_.name(where.file) + ':' + std::to_string(where.line) + ':' + std::to_string(where.column);
}

void Diagnostics::fail(const Location& where, const std::string& what) const {
  std::string before = unsupported_lines();
  if (!before.empty()) before += '\n';
  throw SceneError(before + place(where) + ": error: " + what + stack());
}

void Diagnostics::exceed(const Location& where, std::uint64_t ParseLimits::*limit, const std::string& who,
                         const std::string& unit) const {
  const auto& limits = parse_limits();
  const auto named =
      std::find_if(limits.begin(), limits.end(), [&](const NamedLimit& each) { return each.limit == limit; });
  fail(where, who + " more than " + std::to_string(options_.limits.*limit) + ' ' + unit + " (--max " +
                  named->name + "=N allows more)");
}

void Diagnostics::say(const Location& where, const char* kind, const std::string& what) const {
  const std::string line = place(where) + ": " + kind + ": " + what + '\n';
  if (options_.message)
    options_.message(line);
  else
    std::cerr << line;
}

bool Diagnostics::supports(const UnsupportedPtr& unsupported, const Location& used_at) {
  if (!unsupported) return true;
  std::vector<const Unsupported*> all; // from the last to the first
  for (const Unsupported* one = unsupported.get(); one; one = one->others.get())
    all.push_back(one);
  for (auto one = all.rbegin(); one != all.rend(); ++one)
    if (unsupported_.insert((*one)->what).second) note_unsupported(**one, used_at);
  return false;
}

void Diagnostics::note_unsupported(const Unsupported& unsupported, const Location& used_at) {
  if (options_.lenient)
    return warn(unsupported.where, unsupported.what + " is not supported yet and left out");
  if (unsupported_errors_.size() >= kMostUnsupported) return;
  std::string message = place(unsupported.where) + ": error: " + unsupported.what + " is not supported yet";
  if (unsupported.where != used_at) message += "\n    used at " + place(used_at);
  unsupported_errors_.push_back(message + stack());
}

void Diagnostics::require_supported() const {
  if (!unsupported_errors_.empty()) throw SceneError(unsupported_lines());
}

std::string Diagnostics::unsupported_lines() const {
  std::string lines;
  for (const std::string& error : unsupported_errors_)
    lines += (lines.empty() ? "" : "\n") + error;
  if (!options_.lenient && unsupported_.size() > unsupported_errors_.size())
    lines += "\n    and " + std::to_string(unsupported_.size() - unsupported_errors_.size()) +
             " more features that are not supported yet";
  return lines;
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
