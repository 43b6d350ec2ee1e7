// Writes OpenEXR with the format's library, and converts the library's errors to InputErrors.
#include "image/format_table.hpp"
#include "image/rows.hpp"
#include "image/seekable.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>

namespace celltrace::image {

namespace {

/// A file for the library, which seeks back to write the lengths of the parts.
class PictureStream : public Imf::OStream {
public:
  PictureStream(std::FILE* file, std::uint64_t expected) : OStream("picture"), file_(file, expected) {}

  void write(const char bytes[], int count) override { file_.write(bytes, static_cast<std::size_t>(count)); }
  std::uint64_t tellp() override { return file_.position(); }
  void seekp(std::uint64_t at) override { file_.seek(at); }
  void finish() { file_.finish(); }

private:
  SeekableFile file_;
};

/// A channel of a file, and the place of its pixels in the rows to write.
struct Channel {
  const char* name;
  Imf::PixelType type;
  std::size_t first, stride; ///< first number and stride, in numbers of the channel's type
  enum { colours, depth, normal, object } source;
};

class ExrRows : public FloatRows {
public:
  ExrRows(std::FILE* file, const RowFormat& format)
      : FloatRows(file, format), stream_(file, bytes_expected(format)) {
    translating([&] {
      Imf::Header header(static_cast<int>(format.width), static_cast<int>(format.height));
      for (const Channel& channel : channels())
        header.channels().insert(channel.name, Imf::Channel(channel.type));
      out_.emplace(stream_, header);
    });
  }

private:
  static std::uint64_t bytes_expected(const RowFormat& format) {
    const int bytes = format.channels * format.bits / 8 + (format.first_hits ? 20 : 0);
    return static_cast<std::uint64_t>(format.width * format.height) * static_cast<std::uint64_t>(bytes);
  }

  std::vector<Channel> channels() const {
    const Imf::PixelType number = format().bits == 32 ? Imf::FLOAT : Imf::HALF;
    std::vector<Channel> channels;
    const char* const names[] = {"R", "G", "B", "A"};
    for (std::size_t i = 0; i < static_cast<std::size_t>(format().channels); ++i)
      channels.push_back({names[i], number, i, 4, Channel::colours});
    if (!format().first_hits) return channels;
    channels.push_back({"Z", Imf::FLOAT, 0, 1, Channel::depth});
    channels.push_back({"N.X", number, 0, 3, Channel::normal});
    channels.push_back({"N.Y", number, 1, 3, Channel::normal});
    channels.push_back({"N.Z", number, 2, 3, Channel::normal});
    channels.push_back({"id", Imf::UINT, 0, 1, Channel::object});
    return channels;
  }

  /// Runs `work`, which calls the library, and converts the library's errors.
  template <class Work> static void translating(Work work) {
    try {
      work();
    } catch (const InputError&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw InputError(std::string("cannot be made an OpenEXR file: ") + error.what());
    }
  }

  void put(const float* rgba, int count, const FirstHitRows& hits) override {
    if (count == 0) return;
    if (format().first_hits && (hits.depth == nullptr || hits.normal == nullptr || hits.object == nullptr))
      throw InputError("rows of what is seen first are missing");
    const std::size_t pixels = width() * static_cast<std::size_t>(count);
    std::vector<std::vector<Imath::half>> halves;
    Imf::FrameBuffer frame;
    for (const Channel& channel : channels()) {
      const float* const numbers = channel.source == Channel::colours ? rgba
                                   : channel.source == Channel::depth ? hits.depth
                                                                      : hits.normal;
      if (channel.type == Imf::UINT) {
        add(frame, channel, hits.object, 1);
      } else if (channel.type == Imf::FLOAT) {
        add(frame, channel, numbers + channel.first, channel.stride);
      } else {
        constexpr float kGreatest = 65504;
        std::vector<Imath::half>& converted = halves.emplace_back(pixels);
        for (std::size_t i = 0; i < pixels; ++i)
          converted[i] =
              Imath::half(std::clamp(numbers[channel.first + i * channel.stride], -kGreatest, kGreatest));
        add(frame, channel, converted.data(), 1);
      }
    }
    translating([&] {
      out_->setFrameBuffer(frame);
      out_->writePixels(count);
    });
    row_ += count;
  }

  /// Adds a channel. `first` points to the next row; the library expects a pointer to the picture's first
  /// row.
  template <class Number>
  void add(Imf::FrameBuffer& frame, const Channel& channel, const Number* first, std::size_t stride) const {
    const std::size_t row_bytes = stride * sizeof(Number) * width();
    const auto base = reinterpret_cast<std::uintptr_t>(first) - static_cast<std::uintptr_t>(row_) * row_bytes;
    // The library only reads, but takes no pointer to const.
    frame.insert(channel.name,
                 Imf::Slice(channel.type, reinterpret_cast<char*>(base), stride * sizeof(Number), row_bytes));
  }

  void end() override {
    translating([&] { out_.reset(); });
    stream_.finish();
  }

  PictureStream stream_;
  std::optional<Imf::OutputFile> out_;
  std::int64_t row_ = 0; ///< number of the next row
};

} // namespace

const bool kHasExr = true;

std::unique_ptr<RowWriter> open_exr(std::FILE* file, const RowFormat& format) {
  return std::make_unique<ExrRows>(file, format);
}

} // namespace celltrace::image
