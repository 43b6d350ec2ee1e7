#include "pov/characters.hpp"

namespace celltrace::pov {

namespace {

constexpr unsigned kLatin1End = 0x100, kTwoBytesEnd = 0x800;
constexpr unsigned kTwoBytes = 0xC0, kThreeBytes = 0xE0, kFourBytes = 0xF0, kFollowing = 0x80;
constexpr unsigned kPayload = 0x3F, kPayloadBits = 6;

bool follows(unsigned char byte) {
  return (byte & ~kPayload) == kFollowing;
}

} // namespace

std::string character(unsigned code) {
  const auto byte = [](unsigned value) { return static_cast<char>(value); };
  const auto following = [&](unsigned value) { return byte(kFollowing | (value & kPayload)); };
  if (code == 0) return {};
  if (code < kLatin1End) return {byte(code)};
  if (code < kTwoBytesEnd) return {byte(kTwoBytes | code >> kPayloadBits), following(code)};
  return {byte(kThreeBytes | code >> 2 * kPayloadBits), following(code >> kPayloadBits), following(code)};
}

unsigned first_code(std::string_view text) {
  if (text.empty()) return 0;
  const auto byte = [text](std::size_t i) {
    return static_cast<unsigned char>(i < text.size() ? text[i] : 0);
  };
  const unsigned first = byte(0);
  if (first >= kTwoBytes && first < kThreeBytes && follows(byte(1))) {
    const unsigned code = (first & ~kThreeBytes) << kPayloadBits | (byte(1) & kPayload);
    if (code >= kLatin1End) return code; // lower codes are single bytes here
  }
  if (first >= kThreeBytes && first < kFourBytes && follows(byte(1)) && follows(byte(2)))
    return (first & ~kFourBytes) << 2 * kPayloadBits | (byte(1) & kPayload) << kPayloadBits |
           (byte(2) & kPayload);
  return first;
}

} // namespace celltrace::pov
