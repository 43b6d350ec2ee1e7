// Common parts of the writers of row_writer.hpp: counting and converting rows, and refusing rows that a file
// cannot hold.
#pragma once

#include "image/encoding.hpp"
#include "image/row_writer.hpp"

#include <cstddef>
#include <vector>

namespace celltrace::image {

/// Counts the rows of a file.
class CountedRows : public RowWriter {
public:
  void finish() final;

protected:
  CountedRows(std::FILE* file, const RowFormat& format) : file_(file), format_(format) {}

  std::size_t width() const { return static_cast<std::size_t>(format_.width); }
  std::FILE* file() const { return file_; }
  const RowFormat& format() const { return format_; }
  /// Counts rows. Throws InputError if there would be more than the picture has.
  void count(int rows);
  /// Writes the part of the file behind the rows.
  virtual void end() {}

private:
  std::FILE* file_;
  RowFormat format_;
  std::int64_t rows_ = 0;
};

/// A writer of files with 8 or 16 bits a channel.
class EncodedRows : public CountedRows {
public:
  void write(const std::uint8_t* rgba, int count) final;
  void write(const std::uint16_t* rgba, int count) final;
  void write(const float* rgba, int count, const FirstHitRows& hits = {}) final;

protected:
  EncodedRows(std::FILE* file, const RowFormat& format)
      : CountedRows(file, format), encoding_(format.colour_gamma, format.gamma) {}

  bool has_alpha() const { return format().channels % 2 == 0; }
  bool is_grey() const { return format().channels < 3; }
  /// Writes rows with as many bits as the file has; grey rows have three equal colours.
  virtual void put(const std::uint8_t* rgba, int count) = 0;
  /// Writes rows of 16 bits; called only if RowFormat::bits is 16.
  virtual void put(const std::uint16_t*, int) {}

private:
  template <class Channel> void write_encoded(const Channel* rgba, int count);
  template <class Channel> void write_colours(const float* rgba, int count);

  Encoding encoding_;
};

/// A writer of files with colours as floats.
class FloatRows : public CountedRows {
public:
  void write(const std::uint8_t* rgba, int count) final;
  void write(const std::uint16_t* rgba, int count) final;
  void write(const float* rgba, int count, const FirstHitRows& hits = {}) final;

protected:
  using CountedRows::CountedRows;

  /// Writes linear rows.
  virtual void put(const float* rgba, int count, const FirstHitRows& hits) = 0;

private:
  std::vector<float> linear_;
};

} // namespace celltrace::image
