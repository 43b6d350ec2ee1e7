#include "image/source_image.hpp"

#include "celltrace/error.hpp"
#include "celltrace/image.hpp"

#include <cstddef>
#include <string_view>

namespace celltrace::image {

namespace {

bool begins(const std::string& bytes, std::string_view with) {
  return std::string_view(bytes).substr(0, with.size()) == with;
}

SourceFormat format_of(const std::string& bytes) {
  if (begins(bytes, "\x89PNG")) return SourceFormat::png;
  if (begins(bytes, "\xFF\xD8")) return SourceFormat::jpeg;
  if (begins(bytes, "BM")) return SourceFormat::bmp;
  if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6') return SourceFormat::ppm;
  if (begins(bytes, "GIF8")) throw InputError("is a GIF, which is not read yet");
  if (begins(bytes, "II*") || begins(bytes, "MM")) throw InputError("is a TIFF, which is not read yet");
  if (begins(bytes, "\x76\x2F\x31\x01")) throw InputError("is an OpenEXR, which is not read yet");
  if (begins(bytes, "#?")) throw InputError("is a Radiance picture, which is not read yet");
  return SourceFormat::tga;
}

} // namespace

SourceImage read_source_image(const std::string& bytes, const TakesMemory& take) {
  const SourceFormat format = format_of(bytes);
  if (format == SourceFormat::png) return read_png_source(bytes, take);
  const Image decoded = decode_image(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  take(decoded.rgba.size() * sizeof(std::uint16_t));
  SourceImage image;
  image.format = format;
  image.width = decoded.width;
  image.height = decoded.height;
  image.rgba.reserve(decoded.rgba.size());
  image.is_grey = format == SourceFormat::ppm && bytes.size() > 1 && (bytes[1] == '2' || bytes[1] == '5');
  for (std::size_t i = 0; i < decoded.rgba.size(); ++i) {
    image.rgba.push_back(static_cast<std::uint16_t>(decoded.rgba[i] * 257));
    if (i % 4 == 3 && decoded.rgba[i] != 255) image.has_alpha = true;
  }
  return image;
}

} // namespace celltrace::image
