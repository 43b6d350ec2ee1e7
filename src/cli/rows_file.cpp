#include "cli/rows_file.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace celltrace::cli {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view kTitle = "celltrace rows 2\n";
/// The largest head in bytes; settings and names of files take less.
constexpr std::uint64_t kLongestHead = std::uint64_t{64} << 20;

/// The header of each part in the file.
struct PartHead {
  std::int32_t top, bottom;
  std::uint64_t bytes, checksum;
  std::uint64_t own_checksum; ///< checksum of the preceding members
};

/// Returns the FNV-1a hash (Fowler, Noll, Vo), by words of 8 bytes.
std::uint64_t checksum_of(std::string_view bytes) {
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
std::uint64_t own_checksum_of(const PartHead& head) {
  return checksum_of({reinterpret_cast<const char*>(&head), offsetof(PartHead, own_checksum)});
}

bool read_exactly(std::FILE* file, void* to, std::size_t bytes) {
  return std::fread(to, 1, bytes, file) == bytes;
}

/// Reads the head of a file from its beginning; leaves the position after the head.
std::optional<std::string> read_head(std::FILE* file) {
  char title[kTitle.size()];
  std::uint64_t size = 0, checksum = 0;
  if (!read_exactly(file, title, sizeof title) || std::string_view(title, sizeof title) != kTitle ||
      !read_exactly(file, &size, sizeof size) || size > kLongestHead)
    return std::nullopt;
  std::string head(size, '\0');
  if (!read_exactly(file, head.data(), size) || !read_exactly(file, &checksum, sizeof checksum) ||
      checksum != checksum_of(head))
    return std::nullopt;
  return head;
}

[[noreturn]] void fail(const fs::path& path) {
  const std::string reason = std::generic_category().message(errno);
  throw InputError(path.string() + ": cannot be written: " + reason);
}

} // namespace

RowsFile::RowsFile(fs::path path, std::string head) : path_(std::move(path)), head_(std::move(head)) {
  find_parts();
}

std::optional<std::string> RowsFile::head_of(const fs::path& path) {
  const image::File file(std::fopen(path.c_str(), "rb"));
  return file ? read_head(file.get()) : std::nullopt;
}

void RowsFile::find_parts() {
  const image::File file(std::fopen(path_.c_str(), "rb"));
  if (!file || read_head(file.get()) != head_) return;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path_, error);
  if (error) return;
  end_ = static_cast<std::uint64_t>(std::ftell(file.get()));
  for (PartHead head; read_exactly(file.get(), &head, sizeof head);) {
    const std::uint64_t at = end_ + sizeof head;
    if (own_checksum_of(head) != head.own_checksum || head.top < 0 || head.top >= head.bottom || at > size ||
        head.bytes > size - at || std::fseek(file.get(), static_cast<long>(at + head.bytes), SEEK_SET) != 0)
      break;
    parts_[head.top] = {head.bottom, at, head.bytes, head.checksum};
    end_ = at + head.bytes;
  }
}

std::optional<RowsFile::Rows> RowsFile::next(int top) const {
  const auto found = parts_.lower_bound(top);
  return found == parts_.end() ? std::nullopt : std::optional(Rows{found->first, found->second.bottom});
}

int RowsFile::count() const {
  int rows = 0;
  for (const auto& [top, part] : parts_)
    rows += part.bottom - top;
  return rows;
}

std::optional<std::string> RowsFile::read(int top) {
  const auto found = parts_.find(top);
  if (found == parts_.end()) return std::nullopt;
  const Part& part = found->second;
  const image::File file(std::fopen(path_.c_str(), "rb"));
  std::string bytes(part.bytes, '\0');
  if (file && std::fseek(file.get(), static_cast<long>(part.at), SEEK_SET) == 0 &&
      read_exactly(file.get(), bytes.data(), bytes.size()) && checksum_of(bytes) == part.checksum)
    return bytes;
  parts_.erase(found);
  return std::nullopt;
}

void RowsFile::begin() {
  file_.reset(std::fopen(path_.c_str(), end_ == 0 ? "wb" : "r+b"));
  if (!file_) fail(path_);
  if (end_ != 0) {
    if (ftruncate(fileno(file_.get()), static_cast<off_t>(end_)) != 0 ||
        std::fseek(file_.get(), static_cast<long>(end_), SEEK_SET) != 0)
      fail(path_);
    return;
  }
  const std::uint64_t size = head_.size(), checksum = checksum_of(head_);
  std::fwrite(kTitle.data(), 1, kTitle.size(), file_.get());
  std::fwrite(&size, sizeof size, 1, file_.get());
  std::fwrite(head_.data(), 1, head_.size(), file_.get());
  std::fwrite(&checksum, sizeof checksum, 1, file_.get());
  end_ = kTitle.size() + sizeof size + head_.size() + sizeof checksum;
}

void RowsFile::append(int top, int bottom, std::string_view bytes) {
  if (!is_kept()) return;
  if (!file_) begin();
  PartHead head = {top, bottom, bytes.size(), checksum_of(bytes), 0};
  head.own_checksum = own_checksum_of(head);
  std::fwrite(&head, sizeof head, 1, file_.get());
  std::fwrite(bytes.data(), 1, bytes.size(), file_.get());
  if (std::fflush(file_.get()) != 0 || std::ferror(file_.get()) != 0) fail(path_);
  parts_[top] = {bottom, end_ + sizeof head, head.bytes, head.checksum};
  end_ += sizeof head + head.bytes;
}

} // namespace celltrace::cli
