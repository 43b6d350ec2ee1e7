#include "cli/resume_state.hpp"

#include "celltrace/error.hpp"
#include "cli/output_files.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>

#include <sys/stat.h>

namespace celltrace::cli {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view kJournalTitle = "celltrace resume 1\n";

std::string text_of(const Settings& settings) {
  std::string text;
  for (const auto& [name, value] : settings)
    text += name + '=' + value + '\n';
  return text + '\n';
}

/// Reads from the front of a text what text_of() wrote. Returns false if it is not complete.
bool take_settings(std::string_view& text, Settings& settings) {
  for (;;) {
    const std::size_t end = text.find('\n');
    if (end == text.npos) return false;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    if (line.empty()) return true;
    const std::size_t equals = line.find('=');
    if (equals == line.npos) return false;
    settings.emplace_back(line.substr(0, equals), line.substr(equals + 1));
  }
}

std::string value_of(const Settings& settings, const std::string& name) {
  const auto found =
      std::find_if(settings.begin(), settings.end(), [&](const auto& each) { return each.first == name; });
  return found == settings.end() ? "none" : found->second;
}

/// Throws InputError, naming the first difference, if settings differ.
void check_same(const fs::path& path, const Settings& before, const Settings& now) {
  if (before == now) return;
  const auto [a, b] = std::mismatch(before.begin(), before.end(), now.begin(), now.end());
  const std::string name = a != before.end() ? a->first : b->first;
  throw InputError(path.string() + ": cannot resume: " + name + " was " + value_of(before, name) + ", now " +
                   value_of(now, name) + ". Leave out --resume (+C) to start again");
}

bool take_front(std::string_view& text, std::string_view front) {
  if (text.substr(0, front.size()) != front) return false;
  text.remove_prefix(front.size());
  return true;
}

std::string read_all(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Returns the frames of complete lines "frame N BYTES". A line that is cut off is the last one.
std::map<int, std::uintmax_t> frames_in(std::string_view text) {
  std::map<int, std::uintmax_t> frames;
  for (std::size_t end = 0; (end = text.find('\n')) != text.npos; text.remove_prefix(end + 1)) {
    std::istringstream line{std::string(text.substr(0, end))};
    std::string word;
    int frame = 0;
    std::uintmax_t bytes = 0;
    if (line >> word >> frame >> bytes && word == "frame") frames[frame] = bytes;
  }
  return frames;
}

std::string frame_line(int frame, std::uintmax_t bytes) {
  return "frame " + std::to_string(frame) + ' ' + std::to_string(bytes) + '\n';
}

} // namespace

ResumeState::ResumeState(const fs::path& output, Settings settings) : settings_(std::move(settings)) {
  if (output.empty() || output == "-" || image::is_stream(output)) return;
  journal_ = rows_ = output;
  journal_ += ".resume";
  rows_ += ".rows";
}

void ResumeState::load() {
  std::error_code error;
  if (!is_kept() || !fs::exists(journal_, error)) return;
  const std::string bytes = read_all(journal_);
  std::string_view text = bytes;
  Settings before;
  if (!take_front(text, kJournalTitle) || !take_settings(text, before))
    throw InputError(journal_.string() + ": is not what celltrace leaves there");
  check_same(journal_, before, settings_);
  frames_ = frames_in(text);
}

bool ResumeState::has_frame(int frame, const fs::path& picture) const {
  const auto found = frames_.find(frame);
  if (found == frames_.end()) return false;
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(picture, error);
  return !error && bytes == found->second;
}

void ResumeState::begin_journal() {
  OutputFile file(journal_);
  *file.stream() << kJournalTitle << text_of(settings_);
  for (const auto& [frame, bytes] : frames_)
    *file.stream() << frame_line(frame, bytes);
  file.finish();
  has_journal_ = true;
}

void ResumeState::finish_frame(int frame, const fs::path& picture) {
  if (!is_kept()) return;
  frames_[frame] = fs::file_size(picture);
  if (has_journal_) {
    std::ofstream file(journal_, std::ios::binary | std::ios::app);
    file << frame_line(frame, frames_[frame]) << std::flush;
    if (!file) throw InputError(journal_.string() + ": cannot be written");
  } else {
    begin_journal();
  }
  std::error_code ignored;
  fs::remove(rows_, ignored);
}

RowsFile ResumeState::rows_of(int frame, const Settings& files) const {
  if (!is_kept()) return {};
  const std::string of_frame = std::to_string(frame) + '\n';
  if (const std::optional<std::string> head = RowsFile::head_of(rows_)) {
    std::string_view text = *head;
    Settings before, files_before;
    if (take_settings(text, before) && take_settings(text, files_before)) {
      check_same(rows_, before, settings_);
      if (text == of_frame) check_same(rows_, files_before, files);
    }
  }
  return {rows_, text_of(settings_) + text_of(files) + of_frame};
}

void ResumeState::remove() {
  if (!is_kept()) return;
  std::error_code ignored;
  fs::remove(journal_, ignored);
  fs::remove(rows_, ignored);
}

std::string file_stamp(const fs::path& path) {
  struct stat facts = {};
  if (stat(path.c_str(), &facts) != 0) return "not there";
  char nanoseconds[16];
  std::snprintf(nanoseconds, sizeof nanoseconds, "%09ld", static_cast<long>(facts.st_mtim.tv_nsec));
  return std::to_string(facts.st_size) + " bytes of " + std::to_string(facts.st_mtim.tv_sec) + '.' +
         nanoseconds;
}

} // namespace celltrace::cli
