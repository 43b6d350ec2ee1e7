// PovTranslation: the file of the picture.
#include <algorithm>
#include <cctype>
#include <optional>

#include "cli/pov_faults.hpp"
#include "cli/pov_translation.hpp"

namespace celltrace::cli {

bool PovTranslation::apply_file(const PovEntry& entry) {
  switch (entry.setting->action) {
  case Action::to_file:
    option("--picture", on(entry) ? "on" : "off");
    break;
  case Action::file_switch:
    file_switch(entry);
    break;
  case Action::file_type:
    file_type(entry, needed(entry, "a letter")[0]);
    break;
  case Action::bits:
    file_.bits = number(entry, entry.value, true);
    break;
  case Action::grey:
    file_.is_grey = on(entry);
    break;
  case Action::file_gamma:
    file_.gamma = std::nullopt;
    if (!same_word(entry.value, "srgb")) file_.gamma = number(entry);
    break;
  case Action::compression:
    file_.compression = number(entry, entry.value, true);
    break;
  default:
    return false;
  }
  file_at_ = arguments_.size();
  return true;
}

void PovTranslation::file_type(const PovEntry& entry, char letter) {
  const std::string_view name = file_type_name(letter);
  if (name.empty()) fail(entry, "is no file type that is known here");
  file_.type = letter;
  option("--file-type", std::string(name));
  if (entry.kind == PovEntry::Kind::setting && entry.value.size() > 1)
    note(shown(entry.text) + " counts as " + letter);
}

void PovTranslation::file_switch(const PovEntry& entry) {
  option("--picture", entry.plus ? "on" : "off");
  if (entry.value.empty()) return;
  const std::string_view behind = std::string_view(entry.value).substr(1);
  file_type(entry, entry.value[0]);
  const bool may_be_grey = is_one_of(file_type_name(file_.type), {"png", "ppm"});
  if (same_word(behind, "g") && may_be_grey)
    file_.is_grey = true;
  else if (std::all_of(behind.begin(), behind.end(), [](unsigned char c) { return std::isdigit(c); })) {
    if (!behind.empty()) file_.bits = number(entry, behind, true);
  } else
    fail_as_unknown(entry);
}

} // namespace celltrace::cli
