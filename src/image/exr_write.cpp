// OpenEXR out, by its library; its errors become ours here.
#include "image/formats.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>

namespace celltrace::image {

namespace {

/// The file in memory: the library goes back in what it has written, which pipes cannot.
class PictureStream : public Imf::OStream {
public:
  PictureStream() : OStream("picture") {}

  void write(const char bytes[], int count) override {
    const auto end = at_ + static_cast<std::size_t>(count);
    if (end > data_.size()) data_.resize(end);
    std::copy_n(bytes, count, data_.begin() + static_cast<std::ptrdiff_t>(at_));
    at_ = end;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = at; }

  const std::vector<char>& data() const { return data_; }

private:
  std::vector<char> data_;
  std::size_t at_ = 0;
};

/// The channels of a file and where their pixels lie.
class Channels {
public:
  Channels(Imf::Header& header, const ColourImage& picture)
      : header_(header), width_(static_cast<std::size_t>(picture.width)),
        pixels_(width_ * static_cast<std::size_t>(picture.height)) {}

  template <class Number>
  void add(const char* name, Imf::PixelType type, const Number* first, std::size_t stride) {
    header_.channels().insert(name, Imf::Channel(type));
    // The library takes no pointer to what is constant; it only reads.
    char* const base = reinterpret_cast<char*>(const_cast<Number*>(first));
    frame_.insert(name, Imf::Slice(type, base, stride * sizeof(Number), stride * sizeof(Number) * width_));
  }
  /// As 16 or 32 bits.
  void add_floats(const char* name, bool full, const float* first, std::size_t stride) {
    if (full) return add(name, Imf::FLOAT, first, stride);
    constexpr float kGreatest = 65504;
    std::vector<Imath::half>& halves = halves_.emplace_back(pixels_);
    for (std::size_t i = 0; i < pixels_; ++i)
      halves[i] = Imath::half(std::clamp(first[i * stride], -kGreatest, kGreatest));
    add(name, Imf::HALF, halves.data(), 1);
  }

  const Imf::FrameBuffer& frame() const { return frame_; }

private:
  Imf::Header& header_;
  std::size_t width_, pixels_;
  Imf::FrameBuffer frame_;
  std::vector<std::vector<Imath::half>> halves_;
};

bool is_opaque(const ColourImage& picture) {
  for (std::size_t alpha = 3; alpha < picture.rgba.size(); alpha += 4)
    if (picture.rgba[alpha] != 1) return false;
  return true;
}

void check_first_hits(const FirstHits& hits, const ColourImage& picture) {
  const std::size_t pixels = picture.rgba.size() / 4;
  if (hits.width != picture.width || hits.height != picture.height || hits.depth.size() != pixels ||
      hits.normal.size() != 3 * pixels || hits.object.size() != pixels)
    throw InputError("what is seen first does not match the size of the picture");
}

} // namespace

void check_has_exr() {
}

void write_exr(std::FILE* file, const ColourImage& linear, const ExrOptions& options) {
  const bool full = options.full_floats;
  PictureStream bytes;
  try {
    Imf::Header header(linear.width, linear.height);
    Channels channels(header, linear);
    const float* const colours = linear.rgba.data();
    channels.add_floats("R", full, colours, 4);
    channels.add_floats("G", full, colours + 1, 4);
    channels.add_floats("B", full, colours + 2, 4);
    if (!is_opaque(linear)) channels.add_floats("A", full, colours + 3, 4);
    if (options.first_hits != nullptr) {
      const FirstHits& hits = *options.first_hits;
      check_first_hits(hits, linear);
      channels.add("Z", Imf::FLOAT, hits.depth.data(), 1);
      channels.add_floats("N.X", full, hits.normal.data(), 3);
      channels.add_floats("N.Y", full, hits.normal.data() + 1, 3);
      channels.add_floats("N.Z", full, hits.normal.data() + 2, 3);
      channels.add("id", Imf::UINT, hits.object.data(), 1);
    }
    Imf::OutputFile out(bytes, header);
    out.setFrameBuffer(channels.frame());
    out.writePixels(linear.height);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(std::string("cannot be made an OpenEXR file: ") + error.what());
  }
  write_bytes(file, bytes.data().data(), bytes.data().size());
}

} // namespace celltrace::image
