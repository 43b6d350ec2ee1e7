#include "backends/cell_emu/simulator/ppe/open_files.hpp"

#include <algorithm>
#include <cstring>
#include <functional>

#include <unistd.h>

namespace celltrace::cell_emu {

std::size_t InputText::read(std::span<std::uint8_t> to) {
  if (at_ == text_.size() && more_ && !to.empty()) {
    text_ = more_();
    at_ = 0;
  }
  const std::size_t count = std::min(to.size(), text_.size() - at_);
  std::memcpy(to.data(), text_.data() + at_, count);
  at_ += count;
  return count;
}

void OutputText::write(std::string_view text) {
  if (take_ && !text.empty()) take_(text);
}

std::size_t HostFile::read(std::span<std::uint8_t> to) {
  const ssize_t count = ::read(file_.get(), to.data(), to.size());
  if (count < 0) fail_with_host_errno();
  return static_cast<std::size_t>(count);
}

void HostFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file_.get(), bytes.data(), bytes.size());
    if (count < 0) fail_with_host_errno();
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

std::int64_t HostFile::seek(std::int64_t offset, From from) {
  const int whence = from == From::start ? SEEK_SET : from == From::here ? SEEK_CUR : SEEK_END;
  const off_t position = ::lseek(file_.get(), offset, whence);
  if (position < 0) fail_with_host_errno();
  return position;
}

const std::shared_ptr<OpenFile>& OpenFiles::at(std::int32_t descriptor) const {
  if (!possible(descriptor) || !files_[static_cast<std::size_t>(descriptor)])
    throw CallFailed{SpuErrno::bad_file};
  return files_[static_cast<std::size_t>(descriptor)];
}

std::int32_t OpenFiles::add(std::shared_ptr<OpenFile> file) {
  const auto free = std::ranges::find(files_, nullptr);
  if (free == files_.end()) throw CallFailed{SpuErrno::too_many_open_files};
  *free = std::move(file);
  return static_cast<std::int32_t>(free - files_.begin());
}

void OpenFiles::set(std::int32_t descriptor, std::shared_ptr<OpenFile> file) {
  if (!possible(descriptor)) throw CallFailed{SpuErrno::bad_file};
  files_[static_cast<std::size_t>(descriptor)] = std::move(file);
}

void OpenFiles::close(std::int32_t descriptor) {
  at(descriptor);
  files_[static_cast<std::size_t>(descriptor)].reset();
}

int Stream::get() {
  std::uint8_t character = 0;
  return read({&character, 1}) == 1 ? character : -1;
}

void Stream::push_back(int character) {
  constexpr std::size_t kMostPushedBack = 4096;
  if (!reads_) throw CallFailed{SpuErrno::bad_file};
  if (pushed_back_.size() >= kMostPushedBack) throw CallFailed{SpuErrno::no_memory};
  unget(character);
  at_end_ = false;
}

std::size_t Stream::read(std::span<std::uint8_t> to) {
  try {
    if (!reads_) throw CallFailed{SpuErrno::bad_file};
    std::size_t done = 0;
    for (; done < to.size() && !pushed_back_.empty(); pushed_back_.pop_back())
      to[done++] = static_cast<std::uint8_t>(pushed_back_.back());
    while (done < to.size()) {
      const std::size_t count = file().read(to.subspan(done));
      if (count == 0) {
        at_end_ = true;
        break;
      }
      done += count;
    }
    return done;
  } catch (const CallFailed&) {
    has_error_ = true;
    throw;
  }
}

void Stream::write(std::string_view text) {
  try {
    if (!writes_) throw CallFailed{SpuErrno::bad_file};
    file().write(text);
  } catch (const CallFailed&) {
    has_error_ = true;
    throw;
  }
}

void Stream::seek(std::int64_t offset, OpenFile::From from) {
  if (from == OpenFile::From::here) offset -= static_cast<std::int64_t>(pushed_back_.size());
  file().seek(offset, from);
  pushed_back_.clear();
  at_end_ = false;
}

std::int64_t Stream::tell() {
  return file().seek(0, OpenFile::From::here) - static_cast<std::int64_t>(pushed_back_.size());
}

Stream& Streams::at(std::uint32_t number) {
  if (number == 0 || number > streams_.size() || !streams_[number - 1]) throw CallFailed{SpuErrno::bad_file};
  return *streams_[number - 1];
}

std::uint32_t Streams::add(Stream stream) {
  const auto free = std::ranges::find_if(streams_, std::logical_not<>());
  if (free == streams_.end()) throw CallFailed{SpuErrno::too_many_open_files};
  *free = std::make_unique<Stream>(std::move(stream));
  return static_cast<std::uint32_t>(free - streams_.begin() + 1);
}

void Streams::set(std::uint32_t number, Stream stream) {
  streams_.at(number - 1) = std::make_unique<Stream>(std::move(stream));
}

} // namespace celltrace::cell_emu
