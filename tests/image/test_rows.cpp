// Pictures that are written row by row.
#include "image/file.hpp"
#include "image/row_writer.hpp"
#include "picture_files.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;

namespace {

image::RowFormat rows_for(int width, int height, int channels, int bits) {
  image::RowFormat rows;
  rows.width = width;
  rows.height = height;
  rows.channels = channels;
  rows.bits = bits;
  return rows;
}

/// Writes a picture in parts of a few rows.
template <class Channel>
void write_in_parts(const std::filesystem::path& path, ImageFormat format, const image::RowFormat& rows,
                    const BasicImage<Channel>& image) {
  image::OutputFile file(path);
  const auto out = image::open_rows(file.get(), format, rows);
  int y = 0;
  for (const int wanted : {1, 0, 3, 2, 17, 1000}) {
    const int count = std::min(wanted, image.height - y);
    out->write(image.rgba.data() + 4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(y),
               count);
    y += count;
  }
  out->finish();
  file.commit();
}

ColourImage colours(int width, int height) {
  ColourImage image(width, height);
  for (std::size_t i = 0; i < image.rgba.size(); ++i)
    if (i % 4 != 3) image.rgba[i] = static_cast<float>(i % 101) / 100.0f;
  return image;
}

struct Case {
  ImageFormat format;
  const char* name;
};

} // namespace

TEST_CASE("a picture that is written in parts has the bytes of one that is saved") {
  const TemporaryFolder folder;
  std::vector<Case> cases = {{ImageFormat::png, "a.png"},
                             {ImageFormat::ppm, "a.ppm"},
                             {ImageFormat::tga, "a.tga"},
                             {ImageFormat::bmp, "a.bmp"}};
  const Image image = asymmetric_image(23, 41);
  const DeepImage deep = asymmetric_image<std::uint16_t>(23, 41);
  const ColourImage numbers = colours(23, 41);
  for (const auto& [format, name] : cases) {
    CAPTURE(name);
    save_image(folder / name, image);
    write_in_parts(folder / "parts", format, rows_for(23, 41, 3, 8), image);
    CHECK(read_bytes(folder / "parts") == read_bytes(folder / name));
    if (format != ImageFormat::png && format != ImageFormat::ppm) continue;
    save_image(folder / name, deep);
    write_in_parts(folder / "parts", format, rows_for(23, 41, 3, 16), deep);
    CHECK(read_bytes(folder / "parts") == read_bytes(folder / name));
  }
  save_image(folder / "a.hdr", numbers);
  write_in_parts(folder / "parts", ImageFormat::hdr, rows_for(23, 41, 3, 8), numbers);
  CHECK(read_bytes(folder / "parts") == read_bytes(folder / "a.hdr"));
#ifdef CELLTRACE_HAS_OPENEXR
  for (const int bits : {16, 32}) {
    save_image(folder / "a.exr", numbers, {bits == 32, nullptr});
    write_in_parts(folder / "parts", ImageFormat::exr, rows_for(23, 41, 3, bits), numbers);
    CHECK(read_bytes(folder / "parts") == read_bytes(folder / "a.exr"));
  }
#endif
}

TEST_CASE("colours as numbers are encoded for files of 8 and 16 bits") {
  const TemporaryFolder folder;
  ColourImage numbers = colours(23, 41);
  save_image(folder / "a.png", numbers);
  CHECK(load_image(folder / "a.png") == to_image(numbers));
  FileOptions deep;
  deep.bits = 16;
  save_image(folder / "a.png", numbers, {}, deep);
  save_image(folder / "b.png", to_deep_image(numbers));
  CHECK(read_bytes(folder / "a.png") == read_bytes(folder / "b.png"));

  // Premultiplied, as in front of black, where the file has no alpha.
  ColourImage clear(1, 1);
  clear.rgba = {0.25f, 0, 0, 0.5f};
  save_image(folder / "a.ppm", clear);
  CHECK(load_image(folder / "a.ppm").rgba == std::vector<std::uint8_t>{137, 0, 0, 255});
  save_image(folder / "a.tga", clear);
  CHECK(load_image(folder / "a.tga").rgba == std::vector<std::uint8_t>{188, 0, 0, 128});
}

TEST_CASE("a large PNG is compressed in parts") {
  const TemporaryFolder folder;
  Image image = asymmetric_image(5000, 4600); // 69 MB of pixels
  // Noise does not compress: it takes more than one part.
  std::minstd_rand random(1);
  std::generate_n(image.rgba.begin(), 2 << 20, [&] { return static_cast<std::uint8_t>(random() >> 8); });
  for (std::size_t alpha = 3; alpha < image.rgba.size(); alpha += 4)
    image.rgba[alpha] = 255;
  save_image(folder / "a.png", image);
  CHECK((load_image(folder / "a.png") == image));
}

TEST_CASE("rows need no more memory than a part of the picture") {
  const TemporaryFolder folder;
  const auto resident = [] {
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss; // kB, the most until now
  };
  const std::vector<std::uint8_t> row(4 * 20000, 200);
  const long before = resident();
  for (const ImageFormat format : {ImageFormat::png, ImageFormat::bmp, ImageFormat::tga}) {
    std::FILE* const null = std::fopen("/dev/null", "wb");
    REQUIRE(null != nullptr);
    // To what cannot seek, a BMP goes by a file.
    const auto out = image::open_rows(null, format, rows_for(20000, 10000, 3, 8));
    for (int y = 0; y < 10000; ++y)
      out->write(row.data(), 1);
    out->finish();
    std::fclose(null);
  }
  CHECK(resident() - before < 100'000); // of 600 MB
}

TEST_CASE("alpha is in the file if it is asked for, whatever pixels are") {
  const TemporaryFolder folder;
  FileOptions with, without;
  with.alpha = true;
  without.alpha = false;
  Image clear = asymmetric_image(4, 4);
  clear.pixel(1, 1)[3] = 9;
  for (const std::string name : {"a.png", "a.tga", "a.bmp"}) {
    CAPTURE(name);
    save_image(folder / name, asymmetric_image(4, 4), with);
    const std::string opaque = read_bytes(folder / name);
    save_image(folder / name, asymmetric_image(4, 4));
    CHECK(opaque.size() != read_bytes(folder / name).size());
    save_image(folder / name, clear, without);
    CHECK(load_image(folder / name) == asymmetric_image(4, 4));
  }
  save_image(folder / "a.png", asymmetric_image(4, 4), with);
  CHECK(read_bytes(folder / "a.png")[25] == 6);
  save_image(folder / "a.ppm", asymmetric_image(4, 4), with); // has none
  CHECK(load_image(folder / "a.ppm") == asymmetric_image(4, 4));
}

TEST_CASE("grey pictures have the luminance, weighed as POV-Ray does") {
  const TemporaryFolder folder;
  ColourImage numbers(1, 1);
  numbers.rgba = {0.3889f, 0.11664f, 0.03888f, 1};
  FileOptions grey;
  grey.grey = true;
  grey.bits = 16;
  save_image(folder / "a.ppm", numbers, {}, grey);
  const std::string bytes = read_bytes(folder / "a.ppm");
  REQUIRE(bytes.substr(0, 13) == "P5\n1 1\n65535\n");
  // povray 3.7 writes 30903 for this pixel.
  CHECK(256 * static_cast<std::uint8_t>(bytes[13]) + static_cast<std::uint8_t>(bytes[14]) ==
        Approx(30903).margin(4));

  save_image(folder / "a.png", numbers, {}, grey);
  CHECK(read_bytes(folder / "a.png").substr(24, 2) == std::string("\x10\x00", 2));
  numbers.rgba[3] = 0.5f;
  save_image(folder / "a.png", numbers, {}, grey);
  CHECK(read_bytes(folder / "a.png").substr(24, 2) == std::string("\x10\x04", 2));
  // Encoded colours are made light first.
  grey.bits = 8;
  Image image(1, 1);
  image.rgba = {255, 0, 0, 255};
  save_image(folder / "b.png", image, grey);
  CHECK(load_image(folder / "b.png").rgba[0] == 148); // sRGB of 0.297
  CHECK_THROWS_WITH(save_image(folder / "b.bmp", image, grey), Contains("b.bmp: ") && Contains("no grey"));
}

TEST_CASE("files have the gamma that is asked for, and a PNG says so") {
  const TemporaryFolder folder;
  ColourImage numbers(1, 1);
  numbers.rgba = {0.25f, 0.5f, 1, 1};
  FileOptions options;
  options.gamma.power = 2.0;
  save_image(folder / "a.png", numbers, {}, options);
  CHECK(load_image(folder / "a.png").rgba == std::vector<std::uint8_t>{128, 180, 255, 255});
  CHECK(read_bytes(folder / "a.png").substr(33, 12) == std::string("\0\0\0\4gAMA\0\0\xC3\x50", 12)); // 50000
  save_image(folder / "a.tga", numbers, {}, options);
  CHECK(load_image(folder / "a.tga").rgba == std::vector<std::uint8_t>{128, 180, 255, 255});
  // Colours that are for display as they are stay so.
  numbers.gamma = std::nullopt;
  save_image(folder / "a.png", numbers, {}, options);
  CHECK(load_image(folder / "a.png").rgba == std::vector<std::uint8_t>{64, 128, 255, 255});
  CHECK_THAT(read_bytes(folder / "a.png"), !Contains("gAMA"));
}

TEST_CASE("rows that do not fit the picture or its format are refused") {
  std::FILE* const null = std::fopen("/dev/null", "wb");
  REQUIRE(null != nullptr);
  const std::vector<std::uint8_t> row(4 * 4);
  const std::vector<std::uint16_t> deep_row(4 * 4);
  const auto out = image::open_rows(null, ImageFormat::png, rows_for(4, 2, 3, 8));
  CHECK_THROWS_WITH(out->write(deep_row.data(), 1), Contains("rows of 16"));
  out->write(row.data(), 1);
  CHECK_THROWS_WITH(out->finish(), Contains("1 of its 2 rows"));
  CHECK_THROWS_WITH(out->write(row.data(), 2), Contains("more rows"));
  CHECK_THROWS_WITH(image::open_rows(null, ImageFormat::hdr, rows_for(4, 2, 3, 8))->write(row.data(), 1),
                    Contains("numbers"));
  const auto refused = [&](ImageFormat format, const image::RowFormat& rows, const std::string& why) {
    CAPTURE(why);
    CHECK_THROWS_WITH(image::open_rows(null, format, rows), Contains(why));
  };
  refused(ImageFormat::png, rows_for(0, 2, 3, 8), "is empty");
  refused(ImageFormat::png, rows_for(4, 2, 3, 12), "12 bits");
  refused(ImageFormat::png, rows_for(4, 2, 5, 8), "channels");
  refused(ImageFormat::tga, rows_for(4, 2, 3, 16), "16 bits");
  refused(ImageFormat::tga, rows_for(65536, 2, 3, 8), "65535 pixels a side");
  refused(ImageFormat::jpeg, rows_for(2, 65501, 3, 8), "65500 pixels a side");
  refused(ImageFormat::bmp, rows_for(40000, 40000, 3, 8), "too large for a BMP");
  refused(ImageFormat::bmp, rows_for(4, 4, 1, 8), "no grey");
  refused(ImageFormat::exr, rows_for(4, 4, 3, 8), "8 bits");
  refused(ImageFormat::dds, rows_for(4, 4, 3, 8), "blocks");
  std::fclose(null);
}
