#include "image/seekable.hpp"

#include "image/formats.hpp"

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>

namespace celltrace::image {

namespace {

constexpr std::uint64_t kMostInMemory = 64u << 20;

[[noreturn]] void fail() {
  throw InputError("cannot be written: " + std::generic_category().message(errno));
}

/// Returns the position of a regular file, -1 if the stream cannot seek back.
std::int64_t origin_of(std::FILE* file) {
  const int descriptor = fileno(file);
  struct stat status;
  if (descriptor < 0 || fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return -1;
  const int flags = fcntl(descriptor, F_GETFL);
  return flags < 0 || (flags & O_APPEND) != 0 ? -1 : ftello(file);
}

} // namespace

SeekableFile::SeekableFile(std::FILE* target, std::uint64_t expected)
    : target_(target), origin_(origin_of(target)) {
  if (origin_ >= 0 || expected <= kMostInMemory) return;
  spool_.reset(std::tmpfile());
  if (!spool_) fail();
}

void SeekableFile::write(const void* bytes, std::size_t count) {
  if (origin_ >= 0)
    write_bytes(target_, bytes, count);
  else if (spool_)
    write_bytes(spool_.get(), bytes, count);
  else {
    const std::uint64_t end = position_ + count;
    if (end > memory_.size()) memory_.resize(std::max(end, position_));
    const auto* const first = static_cast<const std::uint8_t*>(bytes);
    std::copy(first, first + count, memory_.begin() + static_cast<std::ptrdiff_t>(position_));
  }
  position_ += count;
  end_ = std::max(end_, position_);
}

void SeekableFile::seek(std::uint64_t position) {
  position_ = position;
  const auto offset = static_cast<off_t>(position);
  if (origin_ >= 0) {
    if (fseeko(target_, origin_ + offset, SEEK_SET) != 0) fail();
  } else if (spool_ && fseeko(spool_.get(), offset, SEEK_SET) != 0)
    fail();
}

void SeekableFile::finish() {
  seek(origin_ >= 0 ? end_ : 0);
  if (origin_ >= 0) return;
  if (!spool_) return write_bytes(target_, memory_.data(), memory_.size());
  std::vector<std::uint8_t> part(1u << 20);
  for (std::uint64_t left = end_; left > 0;) {
    const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(left, part.size()));
    if (std::fread(part.data(), 1, count, spool_.get()) != count) fail();
    write_bytes(target_, part.data(), count);
    left -= count;
  }
}

} // namespace celltrace::image
