#include "cli/resume_state.hpp"

#include "celltrace/error.hpp"
#include "cli/output_files.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>

#include <sys/stat.h>

namespace celltrace::cli {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view kJournalTitle = "celltrace resume 1\n";
constexpr std::string_view kRowsTitle = "celltrace rows 1\n";

std::string text_of(const Settings& settings) {
  std::string text;
  for (const auto& [name, value] : settings)
    text += name + '=' + value + '\n';
  return text + '\n';
}

/// Takes what text_of() wrote from the front. False: it is not all there.
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

/// Throws InputError, naming the first difference.
void check_same(const fs::path& path, const Settings& before, const Settings& now) {
  if (before == now) return;
  const auto [a, b] = std::mismatch(before.begin(), before.end(), now.begin(), now.end());
  const std::string name = a != before.end() ? a->first : b->first;
  throw InputError(path.string() +
                   ": what was stopped cannot go on, as something else is to be rendered now: " + name +
                   " was " + value_of(before, name) + " and is " + value_of(now, name) +
                   "; without +C it is rendered anew");
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

/// Fowler, Noll and Vo's FNV-1a, by words of 8 bytes: a file that a disk has lost part of is not taken for
/// whole.
std::uint64_t checksum(std::string_view bytes) {
  constexpr std::uint64_t kPrime = 0x100000001B3;
  std::uint64_t hash = 0xCBF29CE484222325;
  while (!bytes.empty()) {
    std::uint64_t word = 0;
    const std::size_t size = std::min(sizeof word, bytes.size());
    std::memcpy(&word, bytes.data(), size);
    hash = (hash ^ word) * kPrime;
    bytes.remove_prefix(size);
  }
  return hash;
}

/// Complete lines "frame N BYTES". A line that is cut off was the last one.
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

void ResumeState::save_rows(int frame, const Settings& files, const PartialPicture& picture) {
  if (!is_kept()) return;
  std::string bytes = std::string(kRowsTitle) + text_of(settings_) + text_of(files) + std::to_string(frame) +
                      '\n' + picture.to_bytes();
  const std::uint64_t sum = checksum(bytes);
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  OutputFile file(rows_);
  file.stream()->write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.finish();
}

bool ResumeState::load_rows(int frame, const Settings& files, PartialPicture& picture) const {
  std::error_code error;
  if (!is_kept() || !fs::exists(rows_, error)) return false;
  const std::string bytes = read_all(rows_);
  std::string_view text = bytes;
  std::uint64_t sum = 0;
  if (text.size() < sizeof sum) return false;
  std::memcpy(&sum, text.data() + text.size() - sizeof sum, sizeof sum);
  text.remove_suffix(sizeof sum);
  if (checksum(text) != sum || !take_front(text, kRowsTitle)) return false;
  Settings before, files_before;
  if (!take_settings(text, before) || !take_settings(text, files_before)) return false;
  check_same(rows_, before, settings_);
  if (!take_front(text, std::to_string(frame) + '\n')) return false; // of another frame
  check_same(rows_, files_before, files);
  return picture.take_bytes(text);
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
