// The files that the programs of one machine have open: POSIX descriptors, and streams of the C library,
// which use descriptors.
#pragma once

#include "backends/cell_emu/simulator/ppe/allowed_folders.hpp"
#include "backends/cell_emu/simulator/ppe/scanf_format.hpp"
#include "backends/cell_emu/simulator/ppe/spu_errno.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cell_emu {

/// An open file, to which several descriptors may refer. All functions throw CallFailed.
class OpenFile {
public:
  enum class From { start, here, end };

  virtual ~OpenFile() = default;
  /// Reads bytes and returns their number, 0 at the end.
  virtual std::size_t read(std::span<std::uint8_t>) { throw CallFailed{SpuErrno::bad_file}; }
  virtual void write(std::string_view) { throw CallFailed{SpuErrno::bad_file}; }
  /// Moves the position and returns it.
  virtual std::int64_t seek(std::int64_t, From) { throw CallFailed{SpuErrno::illegal_seek}; }
  /// Returns the host's descriptor, or -1 for anything but a file of the host.
  virtual int host_descriptor() const { return -1; }
};

/// An input: a text, followed by pieces of text that a function returns when all text has been read.
class InputText final : public OpenFile {
public:
  InputText(std::string text, std::function<std::string()> more)
      : text_(std::move(text)), more_(std::move(more)) {}
  std::size_t read(std::span<std::uint8_t> to) override;

private:
  std::string text_;
  std::function<std::string()> more_;
  std::size_t at_ = 0;
};

/// An output, whose text a function receives at once; without a function the text is dropped.
class OutputText final : public OpenFile {
public:
  explicit OutputText(std::function<void(std::string_view)> take) : take_(std::move(take)) {}
  void write(std::string_view text) override;

private:
  std::function<void(std::string_view)> take_;
};

/// A file of the host.
class HostFile final : public OpenFile {
public:
  /// Takes over a file.
  HostFile(HostDescriptor file, std::string path) : file_(std::move(file)), path_(std::move(path)) {}
  std::size_t read(std::span<std::uint8_t> to) override;
  void write(std::string_view bytes) override;
  std::int64_t seek(std::int64_t offset, From from) override;
  int host_descriptor() const override { return file_.get(); }
  const std::string& path() const { return path_; }

private:
  HostDescriptor file_;
  std::string path_;
};

/// Descriptors, by number: 0 to 2 are standard input, output and error; new files get the lowest free number.
/// Thread safety: none.
class OpenFiles {
public:
  explicit OpenFiles(std::size_t most) : files_(most) {}

  /// Returns the file of a descriptor. Throws CallFailed with EBADF if there is none.
  const std::shared_ptr<OpenFile>& at(std::int32_t descriptor) const;
  /// Adds a file and returns its descriptor. Throws CallFailed with EMFILE if all are in use.
  std::int32_t add(std::shared_ptr<OpenFile> file);
  /// Replaces the file of a descriptor. Throws CallFailed with EBADF for a number out of range.
  void set(std::int32_t descriptor, std::shared_ptr<OpenFile> file);
  /// Closes a descriptor. Throws CallFailed with EBADF if it is not open.
  void close(std::int32_t descriptor);

private:
  bool possible(std::int32_t descriptor) const {
    return descriptor >= 0 && static_cast<std::size_t>(descriptor) < files_.size();
  }

  std::vector<std::shared_ptr<OpenFile>> files_;
};

/// A stream (FILE). It has no buffer, so that programs may mix descriptors and streams.
class Stream final : public CharacterSource {
public:
  Stream(OpenFiles& files, std::int32_t descriptor, bool reads, bool writes)
      : files_(files), descriptor_(descriptor), reads_(reads), writes_(writes) {}

  std::int32_t descriptor() const { return descriptor_; }
  bool at_end() const { return at_end_; }
  bool has_error() const { return has_error_; }
  void clear_errors() { at_end_ = has_error_ = false; }

  int get() override;
  void unget(int character) override { pushed_back_ += static_cast<char>(character); }
  /// Pushes a character back, as ungetc() does. Throws CallFailed if too many characters are pushed back.
  void push_back(int character);

  std::size_t read(std::span<std::uint8_t> to);
  void write(std::string_view text);
  void seek(std::int64_t offset, OpenFile::From from);
  std::int64_t tell();

private:
  OpenFile& file() { return *files_.at(descriptor_); }

  OpenFiles& files_;
  std::int32_t descriptor_;
  bool reads_, writes_;
  bool at_end_ = false, has_error_ = false;
  std::string pushed_back_; // characters that are read first, the last of them first
};

/// Streams, by their numbers in programs: 1 to 3 are standard input, output and error; new streams get the
/// lowest free number. Thread safety: none.
class Streams {
public:
  explicit Streams(std::size_t most) : streams_(most) {}

  /// Returns a stream. Throws CallFailed with EBADF if there is none.
  Stream& at(std::uint32_t number);
  /// Adds a stream and returns its number. Throws CallFailed with EMFILE if all are in use.
  std::uint32_t add(Stream stream);
  void set(std::uint32_t number, Stream stream);
  void remove(std::uint32_t number) { streams_[number - 1].reset(); }

private:
  std::vector<std::unique_ptr<Stream>> streams_;
};

} // namespace celltrace::cell_emu
