// TGA, BMP and JPEG: their bytes, and what they are read back as, here and by ImageMagick.
#include "hex.hpp"
#include "other_programs.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;

namespace {

/// A picture with an alpha of its own in each pixel.
Image clear_image(int width, int height) {
  Image image = asymmetric_image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.pixel(x, y)[3] = static_cast<std::uint8_t>(255 - 3 * x - 5 * y);
  return image;
}

/// A picture with runs of pixels that are equal, longer than a packet has room for.
Image image_of_runs() {
  Image image(300, 4);
  for (int x = 0; x < 300; ++x) {
    image.pixel(x, 0)[0] = 9;                            // one run
    image.pixel(x, 1)[1] = static_cast<std::uint8_t>(x); // none
    image.pixel(x, 2)[2] = static_cast<std::uint8_t>(x / 2);
    image.pixel(x, 3)[0] = static_cast<std::uint8_t>(x % 7 == 0 ? x : 3);
  }
  return image;
}

/// A picture that JPEG keeps: colours that change slowly.
Image smooth_image(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      image.pixel(x, y)[0] = static_cast<std::uint8_t>(40 + 3 * x);
      image.pixel(x, y)[1] = static_cast<std::uint8_t>(200 - 4 * y);
      image.pixel(x, y)[2] = static_cast<std::uint8_t>(x + y);
    }
  return image;
}

std::vector<std::string> rows_of(const std::string& bytes, std::size_t first, std::size_t row_bytes) {
  std::vector<std::string> rows;
  for (std::size_t at = first; at + row_bytes <= bytes.size(); at += row_bytes)
    rows.push_back(bytes.substr(at, row_bytes));
  return rows;
}

bool has_jpeg(const TemporaryFolder& folder) {
  try {
    check_image_path(folder / "a.jpg");
    return true;
  } catch (const InputError& error) {
    CHECK_THAT(error.what(), Contains("cannot write libjpeg files"));
    WARN("skipped: a build without libjpeg");
    return false;
  }
}

} // namespace

TEST_CASE("a TGA has its rows from the top, blue first, and says what alpha means") {
  const TemporaryFolder folder;
  Image image(2, 2);
  image.pixel(0, 0)[0] = 1;
  image.pixel(1, 0)[1] = 2;
  image.pixel(0, 1)[2] = 3;
  save_image(folder / "a.tga", image);
  std::string bytes = read_bytes(folder / "a.tga");
  CHECK(hex(bytes.substr(0, 30)) == "000002000000000000000000020002001820"
                                    "000001000200"
                                    "030000000000");
  REQUIRE(bytes.size() == 18 + 12 + 495 + 26);
  CHECK(bytes.substr(bytes.size() - 18) == std::string("TRUEVISION-XFILE.\0", 18));
  CHECK(bytes[bytes.size() - 27] == 0); // no alpha

  image.pixel(1, 1)[3] = 7;
  save_image(folder / "a.tga", image);
  bytes = read_bytes(folder / "a.tga");
  CHECK(hex(bytes.substr(16, 18)) == "2028"
                                     "000001ff"
                                     "000200ff"
                                     "030000ff"
                                     "00000007");
  CHECK(bytes[bytes.size() - 27] == 3); // not premultiplied
}

TEST_CASE("a TGA survives, compressed or not, with and without alpha, and grey") {
  const TemporaryFolder folder;
  for (const bool run_lengths : {false, true})
    for (const Image& image : {asymmetric_image(37, 23), clear_image(19, 11), image_of_runs(), Image(1, 1)}) {
      CAPTURE(run_lengths, image.width);
      FileOptions options;
      options.run_lengths = run_lengths;
      save_image(folder / "a.tga", image, options);
      CHECK(load_image(folder / "a.tga") == image);
      options.grey = true;
      save_image(folder / "grey.tga", uniform(5, 3, 77), options);
      CHECK(load_image(folder / "grey.tga") == uniform(5, 3, 77));
    }
  FileOptions compressed;
  compressed.run_lengths = true;
  save_image(folder / "a.tga", Image(256, 2), compressed);
  CHECK(hex(read_bytes(folder / "a.tga").substr(18, 8)) ==
        "ff000000ff000000"); // two packets of 128 pixels a row
}

TEST_CASE("a BMP has its rows from the bottom, each of whole words") {
  const TemporaryFolder folder;
  Image image(1, 2);
  image.pixel(0, 0)[0] = 1;
  image.pixel(0, 1)[2] = 3;
  save_image(folder / "a.bmp", image);
  const std::string bytes = read_bytes(folder / "a.bmp");
  CHECK(hex(bytes.substr(0, 30)) == "424d"
                                    "3e000000"
                                    "00000000"
                                    "36000000"
                                    "28000000"
                                    "01000000"
                                    "02000000"
                                    "0100"
                                    "1800");
  CHECK(rows_of(bytes, 54, 4) == std::vector<std::string>{{"\3\0\0\0", 4}, {"\0\0\1\0", 4}});
}

TEST_CASE("a BMP survives, with and without alpha") {
  const TemporaryFolder folder;
  for (const Image& image : {asymmetric_image(37, 23), asymmetric_image(4, 1), clear_image(19, 11)}) {
    save_image(folder / "a.bmp", image);
    CHECK(load_image(folder / "a.bmp") == image);
  }
  // To a pipe and to memory it comes as to a file.
  const auto encoded = encode_image(clear_image(19, 11), ImageFormat::bmp);
  CHECK(read_bytes(folder / "a.bmp") == std::string(encoded.begin(), encoded.end()));
  printed_by(folder, "mkfifo pipe && (cat pipe >piped & echo $! >cat.txt)");
  FileOptions options;
  options.format = ImageFormat::bmp;
  save_image(folder / "pipe", clear_image(19, 11), options);
  printed_by(folder, "while kill -0 $(cat cat.txt) 2>/dev/null; do sleep 0.01; done");
  CHECK(read_bytes(folder / "piped") == read_bytes(folder / "a.bmp"));
}

TEST_CASE("a JPEG has the quality that is asked for") {
  const TemporaryFolder folder;
  if (!has_jpeg(folder)) return;
  const Image image = smooth_image(61, 37);
  FileOptions options;
  std::uintmax_t bytes = 0;
  double last = 0;
  for (const int quality : {0, 30, 85, 100}) {
    CAPTURE(quality);
    options.jpeg_quality = quality;
    save_image(folder / "a.jpg", image, options);
    CHECK(std::filesystem::file_size(folder / "a.jpg") > bytes);
    bytes = std::filesystem::file_size(folder / "a.jpg");
    const double psnr = compare_images(load_image(folder / "a.jpg"), image).psnr;
    CHECK(psnr > last);
    last = psnr;
    if (quality == 85) CHECK(psnr > 38);
  }
  save_image(folder / "b.jpeg", image);
  options.jpeg_quality = 85;
  save_image(folder / "a.jpg", image, options);
  CHECK(read_bytes(folder / "a.jpg") == read_bytes(folder / "b.jpeg"));
  options.grey = true;
  save_image(folder / "grey.jpg", uniform(9, 9, 77), options);
  CHECK(compare_images(load_image(folder / "grey.jpg"), uniform(9, 9, 77)).max_difference <= 1);
  CHECK(printed_by(folder, "head -c 3 grey.jpg | od -An -tx1") == " ff d8 ff\n");
}

TEST_CASE("ImageMagick reads TGA, BMP and JPEG as they are read here") {
  const TemporaryFolder folder;
  if (!imagemagick_reads("TGA") || !imagemagick_reads("BMP")) return;
  FileOptions compressed;
  compressed.run_lengths = true;
  for (const Image& image : {asymmetric_image(37, 23), clear_image(19, 11), image_of_runs()}) {
    for (const std::string name : {"a.tga", "a.bmp"}) {
      CAPTURE(name, image.width);
      save_image(folder / name, image);
      CHECK(by_imagemagick(folder, name) == image);
    }
    save_image(folder / "c.tga", image, compressed);
    CHECK(by_imagemagick(folder, "c.tga") == image);
  }
  if (!has_jpeg(folder)) return;
  save_image(folder / "a.jpg", smooth_image(61, 37));
  CHECK(compare_images(by_imagemagick(folder, "a.jpg"), load_image(folder / "a.jpg")).max_difference <= 1);
}

TEST_CASE("a TGA, BMP or JPEG that is cut, or of another kind, is refused") {
  const TemporaryFolder folder;
  save_image(folder / "whole.bmp", clear_image(19, 11));
  std::vector<std::string> names = {"whole.bmp"};
  if (has_jpeg(folder)) {
    save_image(folder / "whole.jpg", smooth_image(61, 37));
    names.push_back("whole.jpg");
  }
  for (const std::string& name : names) {
    const std::string bytes = read_bytes(folder / name);
    for (std::size_t length = 3; length < bytes.size(); length += 7) {
      CAPTURE(name, length);
      write_bytes(folder / "cut", bytes.substr(0, length));
      CHECK_THROWS_WITH(load_image(folder / "cut"), Contains("cut: "));
    }
  }
  // A TGA is known by its end: pixels are left out before it.
  FileOptions compressed;
  compressed.run_lengths = true;
  for (const FileOptions& options : {FileOptions(), compressed}) {
    save_image(folder / "whole.tga", image_of_runs(), options);
    const std::string bytes = read_bytes(folder / "whole.tga");
    const std::string footer = bytes.substr(bytes.size() - 26);
    for (std::size_t length = 0; length + 600 < bytes.size(); length += 17) {
      write_bytes(folder / "cut.tga", bytes.substr(0, length) + footer);
      CHECK_THROWS_AS(load_image(folder / "cut.tga"), InputError);
    }
    for (const auto& [at, value] : {std::pair(1, 1), {2, 1}, {2, 33}, {16, 16}, {16, 8}, {17, 0x21}}) {
      CAPTURE(at, value);
      std::string other = bytes;
      other[static_cast<std::size_t>(at)] = static_cast<char>(value);
      write_bytes(folder / "other.tga", other);
      CHECK_THROWS_WITH(load_image(folder / "other.tga"), Contains("of a kind that is not read"));
    }
  }
  std::string bytes = read_bytes(folder / "whole.bmp");
  bytes[28] = 8;
  write_bytes(folder / "other.bmp", bytes);
  CHECK_THROWS_WITH(load_image(folder / "other.bmp"), Contains("of a kind that is not read"));
}
