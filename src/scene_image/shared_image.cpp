#include "scene_image/shared_image.hpp"

#include "scene/progress_monitor.hpp"
#include "scene_image/image_fields.hpp"

#include <cstdint>
#include <cstring>

namespace celltrace {

using namespace kernel;

// Asserts this for the accelerator's records; image_layout.cpp asserts it for all other tables.
static_assert(consists_of_words<CellRecord>() && consists_of_words<NodeRecord>(),
              "an image is converted word by word");

void SharedImage::publish_static() {
  if (!converts_) return;
  copy_.reserve(image_.end_offset());
  copy(0, image_.header().bytes);
  copy_header();
}

void SharedImage::publish_all() {
  if (!converts_) return;
  copy_.reserve(image_.end_offset());
  copy(0, image_.end_offset());
  copy_header();
}

void SharedImage::remember() {
  before_.reserve(image_.end_offset());
  std::memcpy(before_.data(), image_.base(), image_.end_offset());
}

std::vector<std::uint32_t> SharedImage::publish_changes() {
  std::vector<std::uint32_t> lines;
  for (std::uint32_t at = 0; at < image_.end_offset(); at += kLineBytes) {
    if (std::memcmp(image_.base() + at, before_.data() + at, kLineBytes) == 0) continue;
    lines.push_back(at);
    if (converts_) copy(at, at + kLineBytes);
  }
  if (converts_) copy_header();
  return lines;
}

/// Copies a range of bytes word by word; both ends are multiples of a word.
void SharedImage::copy(std::size_t begin, std::size_t end) {
  for (std::size_t at = begin; at < end; at += sizeof(std::uint32_t)) {
    ProgressMonitor::check_cancelled(at / sizeof(std::uint32_t));
    std::uint32_t word;
    std::memcpy(&word, image_.base() + at, sizeof word);
    word = word >> 24 | (word >> 8 & 0xFF00) | (word << 8 & 0xFF0000) | word << 24;
    std::memcpy(copy_.data() + at, &word, sizeof word);
  }
}

/// Copies the header field by field: it is the only record with numbers that are not words.
void SharedImage::copy_header() {
  ImageHeader header = image_.header();
  reverse_bytes(header);
  std::memcpy(copy_.data(), &header, sizeof header);
}

} // namespace celltrace
