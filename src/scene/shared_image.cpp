#include "scene/shared_image.hpp"

#include "scene/image_fields.hpp"

#include <cstdint>
#include <cstring>

namespace celltrace {

using namespace kernel;

// What SceneImage does not lay out itself; of its own tables it says the same.
static_assert(consists_of_words<CellRecord>() && consists_of_words<NodeRecord>(),
              "an image is converted word by word");

void SharedImage::publish_static() {
  if (converts_) copy(image_.header().bytes);
}

void SharedImage::publish_all() {
  if (converts_) copy(image_.end_offset());
}

void SharedImage::copy(std::size_t bytes) {
  copy_.reserve(image_.end_offset());
  for (std::size_t at = 0; at < bytes; at += sizeof(std::uint32_t)) {
    std::uint32_t word;
    std::memcpy(&word, image_.base() + at, sizeof word);
    word = word >> 24 | (word >> 8 & 0xFF00) | (word << 8 & 0xFF0000) | word << 24;
    std::memcpy(copy_.data() + at, &word, sizeof word);
  }
  // The only numbers of another width.
  ImageHeader header = image_.header();
  reverse_bytes(header);
  std::memcpy(copy_.data(), &header, sizeof header);
}

} // namespace celltrace
