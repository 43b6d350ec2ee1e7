// PovTranslation: POV-Ray's text streams.
#include <algorithm>
#include <iterator>
#include <utility>

#include "cli/pov_faults.hpp"
#include "cli/pov_translation.hpp"

namespace celltrace::cli {

bool PovTranslation::apply_messages(const PovEntry& entry) {
  const std::string kind(entry.setting->option);
  switch (entry.setting->action) {
  case Action::stream:
    if (!entry.value.empty()) text_file(entry, kind);
    [[fallthrough]];
  case Action::console: {
    const bool is_printed = on(entry);
    if (kind == "error" && !is_printed)
      note(shown(entry.text) + ": errors are printed all the same");
    else
      messages_.printed[kind] = is_printed;
    return true;
  }
  case Action::text_file:
    text_file(entry, kind);
    return true;
  case Action::append:
    messages_.appends = on(entry);
    return true;
  default:
    return false;
  }
}

void PovTranslation::text_file(const PovEntry& entry, std::string_view kind) {
  constexpr std::pair<std::string_view, std::string_view> kNames[] = {
      {"all", "alltext.out"},   {"debug", "debug.out"},      {"error", "fatal.out"},
      {"render", "render.out"}, {"statistics", "stats.out"}, {"warning", "warning.out"}};
  const std::string& value = needed(entry, "a file name");
  if (entry.kind == PovEntry::Kind::setting && is_off_word(value)) {
    messages_.files.erase(std::string(kind));
  } else if (entry.kind == PovEntry::Kind::setting && is_one_of(value, {"on", "yes", "true", "1"})) {
    const auto name = std::find_if(std::begin(kNames), std::end(kNames),
                                   [&](const auto& each) { return each.first == kind; });
    messages_.files[std::string(kind)] = std::string(name->second);
  } else {
    messages_.files[std::string(kind)] = value;
  }
}

} // namespace celltrace::cli
