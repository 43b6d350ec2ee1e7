#include "celltrace/image.hpp"

#include "image/huge_pages.hpp"
#include "image/limits.hpp"

namespace celltrace {

Image::Image(int image_width, int image_height) : width(image_width), height(image_height) {
  image::check_size(image_width, image_height);
  const std::size_t bytes = 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  rgba.reserve(bytes);
  use_huge_pages(rgba.data(), bytes);
  rgba.resize(bytes);
  for (std::size_t alpha = 3; alpha < rgba.size(); alpha += 4)
    rgba[alpha] = 255;
}

namespace image {

void check_size(std::int64_t width, std::int64_t height) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  if (width < 1 || height < 1) throw InputError("a picture of " + size + " pixels is empty");
  if (width > kMaxImageSide || height > kMaxImageSide || width * height > kMaxImagePixels)
    throw InputError("a picture of " + size + " pixels is too large: " + std::to_string(kMaxImageSide) +
                     " pixels a side and " + std::to_string(kMaxImagePixels) + " in all are the limits");
}

void check_image(const Image& image) {
  check_size(image.width, image.height);
  if (image.rgba.size() != 4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
    throw InputError("a picture's pixels do not match its size");
}

} // namespace image
} // namespace celltrace
