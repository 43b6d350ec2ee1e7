// The bytes of a scene image, to be changed and sealed again.
#pragma once

#include "scene_image/scene_image.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace celltrace::test {

using Bytes = std::vector<std::byte>;

inline Bytes bytes_of(const SceneImage& image) {
  return image.to_bytes();
}

inline kernel::ImageHeader& header_of(Bytes& bytes) {
  return *reinterpret_cast<kernel::ImageHeader*>(bytes.data());
}

/// Makes the checksum right again after a change: FNV-1a over 64-bit words, its own field as 0.
inline void seal(Bytes& bytes) {
  header_of(bytes).checksum = 0;
  std::uint64_t sum = 0xCBF29CE484222325u;
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word;
    std::memcpy(&word, bytes.data() + at, 8);
    sum = (sum ^ word) * 0x100000001B3u;
  }
  header_of(bytes).checksum = sum;
}

/// FNV-1a of bytes, as 16 digits.
template <class AllBytes> std::string hash_of(const AllBytes& bytes) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  for (const auto byte : bytes)
    hash = (hash ^ static_cast<std::uint8_t>(byte)) * 0x100000001B3u;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

template <class Record> Record* table(Bytes& bytes, std::uint32_t offset) {
  return reinterpret_cast<Record*>(bytes.data() + offset);
}
template <class Record> const Record* table(const SceneImage& image, std::uint32_t offset) {
  return reinterpret_cast<const Record*>(image.base() + offset);
}

} // namespace celltrace::test
