#include "viewer/camera_text.hpp"

#include <array>
#include <charconv>

namespace celltrace::viewer {

namespace {

/// Names of Camera::Kind in POV-Ray's language.
constexpr std::array kKinds = {"perspective", "orthographic", "spherical",  "ultra_wide_angle",
                               "omnimax",     "panoramic",    "cylinder 1", "cylinder 2",
                               "cylinder 3",  "cylinder 4",   "fisheye"};

/// Returns the shortest digits that are read as this number.
std::string text_of(double number) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, number + 0.0).ptr}; // avoids -0
}

std::string text_of(const Vec3& v) {
  return '<' + text_of(v.x) + ", " + text_of(v.y) + ", " + text_of(v.z) + '>';
}

} // namespace

std::string camera_text(const Camera& camera, int width, int height) {
  const bool is_flat = camera.kind == Camera::Kind::perspective || camera.kind == Camera::Kind::orthographic;
  std::string text = "camera { // of a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels\n  " + kKinds[static_cast<std::size_t>(camera.kind)] + "\n  location " +
                     text_of(camera.location) + "\n  direction " + text_of(camera.direction) + "\n  right " +
                     text_of(camera.right) + "\n  up " + text_of(camera.up) + '\n';
  if (!is_flat) text += "  angle " + text_of(camera.angle);
  if (camera.kind == Camera::Kind::spherical) text += ", " + text_of(camera.vertical_angle);
  if (!is_flat) text += '\n';
  return text + "}\n";
}

} // namespace celltrace::viewer
