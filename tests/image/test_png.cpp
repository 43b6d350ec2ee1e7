#include "picture_files.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <vector>

#include <catch2/catch.hpp>
#include <png.h>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;

namespace {

struct PngSpec {
  int width, height, bit_depth, colour_type;
  bool interlaced = false;
  std::vector<png_color> palette = {};
  std::vector<png_byte> palette_alpha = {};
};

/// Writes rows of file samples as they are, so that the reader's conversions are seen.
void write_raw_png(const std::filesystem::path& path, const PngSpec& spec,
                   std::vector<std::vector<png_byte>> rows) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, static_cast<png_uint_32>(spec.width), static_cast<png_uint_32>(spec.height),
               spec.bit_depth, spec.colour_type, spec.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!spec.palette.empty())
    png_set_PLTE(png, info, spec.palette.data(), static_cast<int>(spec.palette.size()));
  if (!spec.palette_alpha.empty())
    png_set_tRNS(png, info, spec.palette_alpha.data(), static_cast<int>(spec.palette_alpha.size()), nullptr);
  png_write_info(png, info);
  std::vector<png_bytep> pointers;
  for (auto& row : rows)
    pointers.push_back(row.data());
  png_write_image(png, pointers.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

/// The 8 bytes of a PNG and an IHDR chunk for 8-bit RGB with a right checksum.
std::string png_header(unsigned width, unsigned height) {
  std::string chunk = "IHDR";
  for (const unsigned side : {width, height})
    for (int shift = 24; shift >= 0; shift -= 8)
      chunk += static_cast<char>(side >> shift);
  chunk += std::string("\x08\x02\0\0\0", 5);
  unsigned crc = ~0u;
  for (const char c : chunk) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit)
      crc = crc & 1 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
  }
  std::string file = "\x89PNG\r\n\x1a\n" + std::string("\0\0\0\x0d", 4) + chunk;
  for (int shift = 24; shift >= 0; shift -= 8)
    file += static_cast<char>(~crc >> shift);
  return file;
}

std::vector<int> first_pixels(const Image& image, int count) {
  return {image.rgba.begin(), image.rgba.begin() + 4 * count};
}

} // namespace

TEST_CASE("a picture survives PNG, with and without alpha") {
  const TemporaryFolder folder;
  Image image = asymmetric_image(37, 23);
  save_image(folder / "a.png", image);
  CHECK(load_image(folder / "a.png") == image);
  CHECK(read_bytes(folder / "a.png")[25] == PNG_COLOR_TYPE_RGB);

  image.pixel(36, 22)[3] = 7;
  save_image(folder / "a.png", image);
  CHECK(load_image(folder / "a.png") == image);
  CHECK(read_bytes(folder / "a.png")[25] == PNG_COLOR_TYPE_RGBA);
}

TEST_CASE("16-bit samples are rounded to 8") {
  const TemporaryFolder folder;
  write_raw_png(folder / "a.png", {1, 1, 16, PNG_COLOR_TYPE_RGB}, {{0xFF, 0xFF, 0x80, 0x7F, 0x01, 0xFF}});
  // 0x01FF / 257 = 1.99
  CHECK(first_pixels(load_image(folder / "a.png"), 1) == std::vector<int>{255, 128, 2, 255});
}

TEST_CASE("grey of 1 and 16 bits with alpha becomes RGBA") {
  const TemporaryFolder folder;
  write_raw_png(folder / "1.png", {3, 1, 1, PNG_COLOR_TYPE_GRAY}, {{0b10100000}});
  CHECK(first_pixels(load_image(folder / "1.png"), 3) ==
        std::vector<int>{255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 255});
  write_raw_png(folder / "16.png", {1, 1, 16, PNG_COLOR_TYPE_GRAY_ALPHA}, {{0x40, 0x40, 0x10, 0x10}});
  CHECK(first_pixels(load_image(folder / "16.png"), 1) == std::vector<int>{64, 64, 64, 16});
}

TEST_CASE("a palette with transparency becomes RGBA") {
  const TemporaryFolder folder;
  PngSpec spec{2, 1, 4, PNG_COLOR_TYPE_PALETTE};
  spec.palette = {{10, 20, 30}, {40, 50, 60}};
  spec.palette_alpha = {99};
  write_raw_png(folder / "a.png", spec, {{0x10}});
  CHECK(first_pixels(load_image(folder / "a.png"), 2) == std::vector<int>{40, 50, 60, 255, 10, 20, 30, 99});
}

TEST_CASE("an interlaced picture is put together") {
  const TemporaryFolder folder;
  const Image image = asymmetric_image(13, 11);
  std::vector<std::vector<png_byte>> rows;
  for (int y = 0; y < image.height; ++y)
    rows.emplace_back(image.pixel(0, y), image.pixel(0, y) + 4 * image.width);
  write_raw_png(folder / "a.png", {13, 11, 8, PNG_COLOR_TYPE_RGBA, true}, rows);
  CHECK(load_image(folder / "a.png") == image);
}

TEST_CASE("a PNG cut off anywhere is an error that names the file") {
  const TemporaryFolder folder;
  save_image(folder / "whole.png", asymmetric_image(19, 7));
  const std::string whole = read_bytes(folder / "whole.png");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write_bytes(folder / "cut.png", whole.substr(0, size));
    CAPTURE(size);
    CHECK_THROWS_WITH(load_image(folder / "cut.png"), Contains("cut.png: "));
  }
}

TEST_CASE("a damaged byte is an error or a picture, nothing worse") {
  const TemporaryFolder folder;
  save_image(folder / "whole.png", asymmetric_image(19, 7));
  const std::string whole = read_bytes(folder / "whole.png");
  int errors = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x55);
    write_bytes(folder / "damaged.png", damaged);
    try {
      load_image(folder / "damaged.png");
    } catch (const InputError&) {
      ++errors;
    }
  }
  CHECK(errors > static_cast<int>(whole.size()) * 9 / 10);
}

TEST_CASE("garbage is no picture") {
  const TemporaryFolder folder;
  write_bytes(folder / "empty.png", "");
  CHECK_THROWS_WITH(load_image(folder / "empty.png"), Contains("is empty"));
  write_bytes(folder / "text.png", "hello, this is no picture");
  CHECK_THROWS_WITH(load_image(folder / "text.png"), Contains("neither a PNG nor a binary PPM"));
  write_bytes(folder / "magic.png", "\x89PNG\r\n\x1a\n and then nothing of the kind");
  CHECK_THROWS_AS(load_image(folder / "magic.png"), InputError);
}

TEST_CASE("the size a PNG declares is checked before memory is taken") {
  const TemporaryFolder folder;
  // An empty IDAT ends the header.
  const std::string idat("\0\0\0\0IDAT\x35\xaf\x06\x1e", 12);
  write_bytes(folder / "huge.png", png_header(0x7FFFFFFF, 0x7FFFFFFF) + idat);
  CHECK_THROWS_WITH(load_image(folder / "huge.png"), Contains("too large"));
  write_bytes(folder / "wide.png", png_header(0x7FFFFFFF, 1) + idat);
  CHECK_THROWS_WITH(load_image(folder / "wide.png"), Contains("too large"));
  // Within the limits, but 300 MB of samples cannot come out of 100 bytes.
  write_bytes(folder / "bomb.png", png_header(10000, 10000) + idat);
  CHECK_THROWS_WITH(load_image(folder / "bomb.png"), Contains("too short for the size"));
  write_bytes(folder / "zero.png", png_header(0, 5) + idat);
  CHECK_THROWS_AS(load_image(folder / "zero.png"), InputError);
}
