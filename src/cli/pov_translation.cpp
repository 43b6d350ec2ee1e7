#include "cli/pov_translation.hpp"

#include "celltrace/error.hpp"
#include "celltrace/pov.hpp"
#include "cli/blanks.hpp"
#include "cli/pov_faults.hpp"
#include "cli/pov_numbers.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <utility>

namespace celltrace::cli {

namespace {

void check_name(const PovEntry& entry, const std::string& name) {
  const auto is_letter = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) ||
      !std::all_of(name.begin(), name.end(), is_letter))
    fail(entry, "does not declare anything: " + shown(name) + " is no name of the scene language");
  const std::vector<Keyword> words = keywords();
  const bool is_word =
      std::any_of(words.begin(), words.end(), [&](const Keyword& k) { return k.word == name; });
  if (is_word && name != "clock")
    fail(entry, "does not declare anything: " + shown(name) + " is a word of the scene language");
}

} // namespace

void PovTranslation::pass(const std::string& argument) {
  values_.clear(); // celltrace's own options and switches count in their order
  arguments_.push_back(argument);
}

std::size_t PovTranslation::reserve() {
  arguments_.emplace_back();
  return arguments_.size() - 1;
}

void PovTranslation::add_option(std::string_view name, const std::string& value) {
  arguments_.emplace_back(name);
  arguments_.push_back(value);
}

void PovTranslation::option(std::string_view name, const std::string& value) {
  const auto said = values_.find(name);
  if (said != values_.end()) {
    arguments_[said->second] = value;
    return;
  }
  add_option(name, value);
  values_.emplace(name, arguments_.size() - 1);
}

bool PovTranslation::has_any_option(std::initializer_list<std::string_view> names) const {
  return std::find_first_of(arguments_.begin(), arguments_.end(), names.begin(), names.end()) !=
         arguments_.end();
}

Translation PovTranslation::take() {
  const auto insert = [this](std::size_t at, const std::vector<std::string>& options) {
    arguments_.insert(arguments_.begin() + static_cast<std::ptrdiff_t>(at), options.begin(), options.end());
  };
  std::pair<std::size_t, std::vector<std::string>> choices[] = {{sampling_at_, sampling_.options()},
                                                                {file_at_, file_.options()}};
  // Inserts from the back, so that earlier positions stay valid.
  std::sort(std::begin(choices), std::end(choices), std::greater<>());
  for (const auto& [at, options] : choices)
    insert(at, options);
  insert(1, messages_.options());
  if (resumes_) insert(1, {"--resume"});
  return {std::move(arguments_), std::move(notes_)};
}

double PovTranslation::number(const PovEntry& entry, std::string_view text, bool is_whole) {
  const std::optional<NumberPrefix> read = is_whole ? read_whole(text) : read_real(text);
  if (!read) fail_without(entry, "a number");
  if (!std::isfinite(read->value)) fail(entry, "needs a number that is not as large");
  const PovSetting& setting = *entry.setting;
  const double value = std::clamp(read->value, setting.least, setting.most);
  if (value != read->value && setting.out_of_range == OutOfRange::refused)
    fail(entry, "needs a number from " + number_text(setting.least) + " to " + number_text(setting.most));
  const bool is_cut = !read->rest.empty() && read->rest.substr(0, 2) != "//";
  if (is_cut || value != read->value) note(shown(entry.text) + " counts as " + number_text(value));
  return value;
}

double PovTranslation::number(const PovEntry& entry) {
  return number(entry, entry.value, false);
}

bool PovTranslation::on(const PovEntry& entry) {
  if (entry.kind == PovEntry::Kind::option) return entry.plus;
  const bool is_on_here = is_on(entry.value);
  if (!is_on_here && !is_off_word(entry.value)) note(shown(entry.text) + " counts as off");
  return is_on_here;
}

void PovTranslation::apply(const PovEntry& entry) {
  if (!entry.setting) fail_as_unknown(entry);
  if (!entry.left_out.empty()) note(shown(entry.left_out) + " behind " + shown(entry.text) + " is left out");
  const PovSetting& setting = *entry.setting;
  switch (setting.action) {
  case Action::output:
    return option("--pov-output", same_word(needed(entry, "a file name"), "stdout") ? "-" : entry.value);
  case Action::declare:
    return declare(entry);
  case Action::whole:
    return option(setting.option, number_text(number(entry, entry.value, true)));
  case Action::real:
    return option(setting.option, number_text(number(entry)));
  case Action::on_off:
    if (entry.kind == PovEntry::Kind::option && !entry.value.empty()) fail_as_unknown(entry);
    return option(setting.option, on(entry) ? "on" : "off");
  case Action::resume:
    if (entry.kind == PovEntry::Kind::option && !entry.value.empty()) fail_as_unknown(entry);
    resumes_ = on(entry);
    return;
  case Action::refused_if_on:
    if (on(entry)) fail(entry, "is not supported yet: " + std::string(setting.option));
    return note(shown(entry.text) + " has no effect here");
  case Action::without_effect:
    return note(shown(entry.text) + " has no effect, as in POV-Ray 3.7");
  case Action::never_run:
    return note(shown(entry.text) + " is not run: celltrace runs no commands");
  default:
    if (!apply_sampling(entry) && !apply_file(entry) && !apply_messages(entry)) apply_ignored(entry);
  }
}

bool PovTranslation::apply_sampling(const PovEntry& entry) {
  switch (entry.setting->action) {
  case Action::antialias:
    sampling_.is_on = on(entry);
    if (entry.kind == PovEntry::Kind::option && !entry.value.empty()) sampling_.threshold = number(entry);
    break;
  case Action::threshold:
    sampling_.threshold = number(entry);
    break;
  case Action::jitter:
    sampling_.jitters = on(entry);
    if (entry.kind == PovEntry::Kind::option && !entry.value.empty()) sampling_.jitter = number(entry);
    break;
  case Action::jitter_amount:
    sampling_.jitter = number(entry);
    break;
  case Action::sampling:
    sampling_.method = number(entry, entry.value, true);
    break;
  case Action::sampling_depth:
    sampling_.depth = number(entry, entry.value, true);
    break;
  case Action::sampling_gamma:
    sampling_.gamma = number(entry);
    break;
  default:
    return false;
  }
  sampling_at_ = arguments_.size();
  return true;
}

bool PovTranslation::apply_ignored(const PovEntry& entry) {
  const Action action = entry.setting->action;
  const bool has_number = read_real(entry.value).has_value();
  if (action == Action::ignored_number && !has_number) fail_without(entry, "a number");
  if (entry.kind == PovEntry::Kind::option && !entry.value.empty() &&
      (action == Action::ignored || (action == Action::ignored_perhaps && !has_number)))
    fail_as_unknown(entry);
  note(shown(entry.text) + " has no effect here");
  return true;
}

void PovTranslation::declare(const PovEntry& entry) {
  const std::string_view declared = entry.value;
  const std::size_t equals = std::min(declared.find('='), declared.size());
  const std::string name(trimmed(declared.substr(0, equals)));
  std::string value(trimmed(declared.substr(std::min(equals + 1, declared.size()))));
  if (value.empty()) fail(entry, "declares no value: Declare=NAME=VALUE does, a number or a string");
  check_name(entry, name);
  if (const std::optional<NumberPrefix> read = read_real(value)) {
    if (!std::isfinite(read->value)) fail(entry, "declares a number that is too large");
    if (!read->rest.empty() && read->rest.substr(0, 2) != "//")
      note(shown(entry.text) + " declares " + number_text(read->value) +
           "; quotes around it make it a string");
    value = number_text(read->value);
  }
  if (name != "clock" && !declared_.insert(name).second)
    return note(shown(entry.text) + " has no effect: the first value counts, as in POV-Ray");
  add_option("--declare", name + '=' + value);
}

} // namespace celltrace::cli
