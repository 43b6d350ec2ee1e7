// Pictures as programs of others read them.
#pragma once

#include "picture_files.hpp"

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace celltrace::test {

/// Whether `check`, a command of the shell, says that a program is there and can do something; else the test
/// says that it is skipped.
inline bool is_able(const std::string& check) {
  if (std::system(("{ " + check + "; } >/dev/null 2>&1").c_str()) == 0) return true;
  WARN("skipped, as this fails: " << check);
  return false;
}
inline bool imagemagick_reads(const std::string& format) {
  return is_able("convert -list format | grep -q '^ *" + format + ".* r'");
}

/// What a command of the shell prints.
inline std::string printed_by(const TemporaryFolder& folder, const std::string& command) {
  CAPTURE(command);
  const int failed =
      std::system(("cd '" + folder.path().string() + "' && " + command + " >printed 2>errors").c_str());
  CAPTURE(read_bytes(folder / "errors"));
  REQUIRE(failed == 0);
  return read_bytes(folder / "printed");
}

template <class Number> std::vector<Number> numbers_in(const std::string& bytes) {
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

/// Of 8 bits a channel.
inline Image by_imagemagick(const TemporaryFolder& folder, const std::string& file) {
  printed_by(folder, "convert '" + file + "' -depth 8 converted.png");
  return load_image(folder / "converted.png");
}

/// Red, green and blue of each pixel, clipped to 0..1, in steps of 1 / 65535.
inline std::vector<double> numbers_by_imagemagick(const TemporaryFolder& folder, const std::string& file) {
  // Numbers that are said to be sRGB's already are left alone.
  const std::string bytes =
      printed_by(folder, "convert '" + file + "' -set colorspace sRGB -depth 16 -endian LSB rgb:-");
  std::vector<double> numbers;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2)
    numbers.push_back((static_cast<std::uint8_t>(bytes[i]) + 256 * static_cast<std::uint8_t>(bytes[i + 1])) /
                      65535.0);
  return numbers;
}

} // namespace celltrace::test
