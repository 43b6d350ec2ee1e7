#include "pov/diagnostics.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace celltrace::pov {

namespace {

constexpr std::size_t kMostStackLines = 8;
constexpr std::size_t kMostErrorsInText = 50;
constexpr std::size_t kMostRemarks = 1000;

} // namespace

std::string quoted_name(std::string_view name) {
  constexpr std::size_t kMost = 200;
  std::string text = "'";
  for (const char c : name.substr(0, kMost))
    text += static_cast<unsigned char>(c) < ' ' || c == 127 ? '?' : c;
  text += name.size() > kMost ? "...'" : "'";
  return text;
}

void refuse_scene(const std::string& name, const std::string& what, const ParseOptions& options) {
  Finding error;
  error.file = name;
  error.line = error.column = 0;
  error.text = what;
  if (options.finding) options.finding(error);
  throw SceneError(to_text(error), {error});
}

std::string Diagnostics::place(const Location& where) const {
  return sources_.name(where.file) + ':' + std::to_string(where.line) + ':' + std::to_string(where.column);
}

void Diagnostics::fail(const Location& where, const std::string& what,
                       const std::vector<std::string>& details) const {
  Finding error = finding(Finding::Severity::error, where, what);
  error.reached_by = stack();
  error.reached_by.insert(error.reached_by.begin(), details.begin(), details.end());
  keep(error);
  refuse();
}

void Diagnostics::exceed(const Location& where, std::uint64_t ParseLimits::*limit, const std::string& who,
                         const std::string& unit) const {
  const auto& limits = parse_limits();
  const auto named =
      std::find_if(limits.begin(), limits.end(), [&](const NamedLimit& each) { return each.limit == limit; });
  fail(where, who + " more than " + std::to_string(options_.limits.*limit) + ' ' + unit + " (--max " +
                  named->name + "=N allows more)");
}

Finding Diagnostics::finding(Finding::Severity severity, const Location& where,
                             const std::string& what) const {
  return {severity, sources_.name(where.file), where.line, where.column, what, {}};
}

void Diagnostics::keep(const Finding& finding) const {
  if (options_.finding) options_.finding(finding);
  if (finding.severity == Finding::Severity::error)
    ++errors_;
  else if (++remarks_ > kMostRemarks)
    return;
  findings_.push_back(finding);
}

void Diagnostics::say(Finding::Severity severity, const Location& where, const std::string& what) const {
  const Finding said = finding(severity, where, what);
  keep(said);
  if (options_.message) options_.message(to_text(said) + '\n');
}

void Diagnostics::warn_once(const Location& where, const std::string& what) {
  if (warned_at_.insert({where.file, where.line, where.column}).second) warn(where, what);
}

bool Diagnostics::supports(const UnsupportedPtr& unsupported, const Location& used_at) {
  if (!unsupported) return true;
  std::vector<const Unsupported*> all; // in reverse order
  for (const Unsupported* one = unsupported.get(); one; one = one->others.get())
    all.push_back(one);
  for (auto one = all.rbegin(); one != all.rend(); ++one)
    if (unsupported_.insert((*one)->what).second) note_unsupported(**one, used_at);
  return false;
}

void Diagnostics::note_unsupported(const Unsupported& unsupported, const Location& used_at) {
  if (options_.lenient)
    return warn(unsupported.where, unsupported.what + " is not supported yet and left out");
  Finding error =
      finding(Finding::Severity::error, unsupported.where, unsupported.what + " is not supported yet");
  error.is_unsupported = true;
  error.reached_by = stack();
  if (unsupported.where != used_at)
    error.reached_by.insert(error.reached_by.begin(), "used at " + place(used_at));
  keep(error);
}

void Diagnostics::require_supported() const {
  if (errors_ != 0) refuse();
}

/// Throws the errors. The last one is always included, as it may be more than a missing feature.
void Diagnostics::refuse() const {
  std::vector<const Finding*> errors;
  for (const Finding& finding : findings_)
    if (finding.severity == Finding::Severity::error) errors.push_back(&finding);
  std::string text;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const bool is_last = i + 1 == errors.size();
    if (i >= kMostErrorsInText && !is_last) continue;
    if (i > kMostErrorsInText) {
      text += "\n    and ";
      text += std::to_string(i - kMostErrorsInText) + " more features that are not supported yet";
    }
    if (!text.empty()) text += '\n';
    text += to_text(*errors[i]);
  }
  throw SceneError(text, findings_);
}

std::vector<std::string> Diagnostics::stack() const {
  // A run of equal entries, as of a file that includes itself or a macro that calls itself, is one line.
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
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < entries.size() && i < kMostStackLines; ++i)
    lines.push_back(entries[i].text +
                    (entries[i].times > 1 ? " (" + std::to_string(entries[i].times) + " times)" : ""));
  if (entries.size() > kMostStackLines)
    lines.push_back(std::string("and ") + std::to_string(entries.size() - kMostStackLines) + " more");
  return lines;
}

} // namespace celltrace::pov

namespace celltrace {

std::string to_text(const Finding& finding) {
  static constexpr const char* kSeverities[] = {"note", "warning", "error"};
  std::string text = finding.file + ':';
  if (finding.line != 0) text += std::to_string(finding.line) + ':' + std::to_string(finding.column) + ':';
  text += std::string(" ") + kSeverities[static_cast<int>(finding.severity)] + ": " + finding.text;
  for (const std::string& place : finding.reached_by)
    text += "\n    " + place;
  return text;
}

} // namespace celltrace
