// The bytes of files that other programs read, from the first to the last, and files that other programs
// write.
#include "hex.hpp"
#include "image/format_table.hpp"
#include "image/limits.hpp"
#include "picture_files.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;

namespace {

std::string from_hex(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2)
    bytes += static_cast<char>(std::stoi(text.substr(i, 2), nullptr, 16));
  return bytes;
}

template <class Picture, class... Options>
std::string encoded(const Picture& picture, ImageFormat format, const Options&... options) {
  const auto bytes = encode_image(picture, format, options...);
  return {bytes.begin(), bytes.end()};
}

Image decoded(const std::string& bytes) {
  return decode_image(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::string refusal(const std::string& bytes) {
  try {
    decoded(bytes);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

std::vector<int> pixel_of(const Image& image, int x, int y) {
  return {image.pixel(x, y), image.pixel(x, y) + 4};
}

using Rgba = std::vector<int>;

/// A grey row of these values.
Image grey_row(const std::vector<int>& values) {
  Image image(static_cast<int>(values.size()), 1);
  for (std::size_t x = 0; x < values.size(); ++x)
    for (std::size_t channel = 0; channel < 3; ++channel)
      image.rgba[4 * x + channel] = static_cast<std::uint8_t>(values[x]);
  return image;
}

const std::string kTgaEnd = std::string(8, '\0') + std::string("TRUEVISION-XFILE.\0", 18);

/// A TGA by its image type, bits a pixel, descriptor and pixels; of 2x2 pixels.
std::string tga(int type, int bits, int descriptor, const std::string& pixels, const std::string& id = "") {
  std::string header(18, '\0');
  header[0] = static_cast<char>(id.size());
  header[2] = static_cast<char>(type);
  header[12] = header[14] = 2;
  header[16] = static_cast<char>(bits);
  header[17] = static_cast<char>(descriptor);
  return header + id + pixels + kTgaEnd;
}

} // namespace

TEST_CASE("a DirectDraw surface, from the first byte to the last") {
  BlockImage image;
  image.width = 0x105;
  image.height = 3;
  image.blocks.resize(8 * 66);
  for (std::size_t i = 0; i < image.blocks.size(); ++i)
    image.blocks[i] = static_cast<std::uint8_t>(i);
  const std::string bytes = encoded(image, ImageFormat::dds);
  CHECK(hex(bytes.substr(0, 128)) == "44445320"
                                     "7c000000"
                                     "07100800"
                                     "03000000"
                                     "05010000"
                                     "10020000" +
                                         std::string(8 * 13, '0') +
                                         "20000000"
                                         "04000000"
                                         "44585431" +
                                         std::string(8 * 5, '0') + "00100000" + std::string(8 * 4, '0'));
  CHECK(bytes.substr(128) == std::string(image.blocks.begin(), image.blocks.end()));
}

TEST_CASE("every colour of a block, in every place") {
  BlockImage image;
  image.width = 8;
  image.height = 8;
  image.blocks.resize(32);
  // Ends of 5, 6 and 5 bits that are not 0 or all ones; bits of all pixels; below the first block, right of
  // it.
  const std::uint8_t four[8] = {0x34, 0xA2, 0xE9, 0x15, 0b00011011, 0b11100100, 0b01000000, 0b00000001};
  const std::uint8_t three[8] = {0xE9, 0x15, 0x34, 0xA2, 0b00011011, 0, 0, 0b11000000};
  std::copy_n(four, 8, image.blocks.begin() + 24);
  std::copy_n(three, 8, image.blocks.begin() + 8);
  const Image pixels = to_image(image);
  const Rgba first = {165, 69, 165, 255}, second = {16, 190, 74, 255};
  const Rgba third = {115, 109, 134, 255}, fourth = {65, 149, 104, 255}, middle = {90, 129, 119, 255};
  CHECK(pixel_of(pixels, 4, 4) == fourth);
  CHECK(pixel_of(pixels, 5, 4) == third);
  CHECK(pixel_of(pixels, 6, 4) == second);
  CHECK(pixel_of(pixels, 7, 4) == first);
  CHECK(pixel_of(pixels, 4, 5) == first);
  CHECK(pixel_of(pixels, 7, 5) == fourth);
  CHECK(pixel_of(pixels, 6, 6) == first);
  CHECK(pixel_of(pixels, 7, 6) == second);
  CHECK(pixel_of(pixels, 4, 7) == second);
  CHECK(pixel_of(pixels, 5, 7) == first);
  // The first end is not the greater: the middle, and black.
  CHECK(pixel_of(pixels, 4, 0) == Rgba{0, 0, 0, 255});
  CHECK(pixel_of(pixels, 5, 0) == middle);
  CHECK(pixel_of(pixels, 6, 0) == first);
  CHECK(pixel_of(pixels, 7, 0) == second);
  CHECK(pixel_of(pixels, 4, 1) == second);
  CHECK(pixel_of(pixels, 7, 3) == Rgba{0, 0, 0, 255});
  CHECK(pixel_of(pixels, 3, 0) == Rgba{0, 0, 0, 255});
  // Equal ends are three colours, too.
  image.blocks[26] = image.blocks[24];
  image.blocks[27] = image.blocks[25];
  CHECK(pixel_of(to_image(image), 4, 4) == Rgba{0, 0, 0, 255});
  CHECK(pixel_of(to_image(image), 5, 4) == first);
}

TEST_CASE("a TGA, from the first byte to the last") {
  FileOptions options;
  std::string bytes = encoded(Image(0x103, 0x102), ImageFormat::tga);
  CHECK(hex(bytes.substr(0, 18)) == "000002000000000000000000030102011820");
  const std::size_t pixels = 3 * 0x103 * 0x102;
  REQUIRE(bytes.size() == 18 + pixels + 495 + 26);
  const std::string end = bytes.substr(18 + pixels);
  CHECK(hex(end.substr(0, 2)) == "ef01");
  CHECK(end.substr(2, 424) == std::string(424, '\0'));
  CHECK(end.substr(426, 10) == std::string("celltrace\0", 10));
  CHECK(end.substr(436, 42) == std::string(42, '\0'));
  CHECK(hex(end.substr(478, 4)) == "9808e803"); // 2200 / 1000
  CHECK(end.substr(482, 13) == std::string(13, '\0'));
  const std::size_t extension = 18 + pixels;
  CHECK(hex(end.substr(495, 8)) == hex({static_cast<char>(extension), static_cast<char>(extension >> 8),
                                        static_cast<char>(extension >> 16), 0, 0, 0, 0, 0}));
  CHECK(end.substr(503) == std::string("TRUEVISION-XFILE.\0", 18));

  options.gamma.power = 1.8;
  options.run_lengths = true;
  options.alpha = true;
  bytes = encoded(Image(1, 1), ImageFormat::tga, options);
  CHECK(hex(bytes.substr(0, 23)) == "00000a000000000000000000010001002028"
                                    "00000000ff");
  CHECK(hex(bytes.substr(23 + 478, 4)) == "0807e803");
  options.grey = true;
  CHECK(hex(encoded(Image(1, 1), ImageFormat::tga, options).substr(0, 21)) ==
        "00000b00000000000000000001000100102800"
        "00ff");
  options = {};
  options.grey = true;
  CHECK(hex(encoded(uniform(1, 1, 77), ImageFormat::tga, options).substr(0, 19)) ==
        "000003000000000000000000010001000820"
        "4d");
}

TEST_CASE("run lengths of a TGA") {
  FileOptions options;
  options.run_lengths = true;
  options.grey = true;
  const auto packets = [&](const std::vector<int>& values) {
    const std::string bytes = encoded(grey_row(values), ImageFormat::tga, options);
    return hex(bytes.substr(18, bytes.size() - 18 - 495 - 26));
  };
  CHECK(packets({9}) == "0009");
  CHECK(packets({9, 9}) == "8109");
  CHECK(packets({8, 9}) == "010809");
  CHECK(packets({8, 9, 9}) == "00088109");
  CHECK(packets({9, 9, 8}) == "81090008");
  CHECK(packets({1, 2, 3, 3, 3, 4, 5}) == "010102"
                                          "8203"
                                          "010405");
  CHECK(packets({1, 1, 2, 2, 3}) == "810181020003");
  CHECK(packets(std::vector<int>(128, 7)) == "ff07");
  CHECK(packets(std::vector<int>(129, 7)) == "ff070007");
  std::vector<int> different(129);
  for (std::size_t i = 0; i < different.size(); ++i)
    different[i] = static_cast<int>(i);
  CHECK(packets(different).substr(0, 4) == "7f00");
  CHECK(packets(different).substr(2 * 129) == "0080");
  different.resize(128);
  CHECK(packets(different).size() == 2 * 129);
}

TEST_CASE("TGAs of other programs: from any corner, with a name, of any kind") {
  const std::string three = from_hex("010203"
                                     "040506"
                                     "070809"
                                     "0a0b0c");
  const auto corner = [&](int descriptor) { return decoded(tga(2, 24, descriptor, three)).pixel(0, 0)[2]; };
  CHECK(corner(0x20) == 1);
  CHECK(corner(0x30) == 4);
  CHECK(corner(0x00) == 7);
  CHECK(corner(0x10) == 10);
  CHECK(pixel_of(decoded(tga(2, 24, 0x20, three)), 1, 0) == Rgba{6, 5, 4, 255});
  CHECK(pixel_of(decoded(tga(2, 24, 0x20, three, "a name")), 0, 1) == Rgba{9, 8, 7, 255});
  CHECK(pixel_of(decoded(tga(2, 32, 0x28,
                             from_hex("01020304"
                                      "05060708"
                                      "090a0b0c"
                                      "0d0e0f10"))),
                 1, 1) == Rgba{15, 14, 13, 16});
  CHECK(pixel_of(decoded(tga(3, 8, 0x20, from_hex("01020304"))), 1, 0) == Rgba{2, 2, 2, 255});
  CHECK(pixel_of(decoded(tga(3, 16, 0x28, from_hex("0102030405060708"))), 1, 0) == Rgba{3, 3, 3, 4});
  const Image runs = decoded(tga(10, 24, 0x20, from_hex("8101020301040506070809")));
  CHECK(pixel_of(runs, 1, 0) == Rgba{3, 2, 1, 255});
  CHECK(pixel_of(runs, 0, 1) == Rgba{6, 5, 4, 255});
  CHECK(pixel_of(runs, 1, 1) == Rgba{9, 8, 7, 255});
  CHECK(pixel_of(decoded(tga(11, 8, 0x20, from_hex("8305"))), 1, 1) == Rgba{5, 5, 5, 255});
  // A run may go on in the next row, but not beyond the end.
  CHECK(pixel_of(decoded(tga(11, 8, 0x20, from_hex("00078205"))), 1, 1) == Rgba{5, 5, 5, 255});
  for (const auto& [type, bits, descriptor] : {std::tuple(1, 8, 0),
                                               {9, 8, 0},
                                               {2, 8, 0},
                                               {2, 16, 0},
                                               {2, 40, 0},
                                               {3, 24, 0},
                                               {3, 4, 0},
                                               {2, 24, 1},
                                               {2, 25, 0},
                                               {0, 24, 0},
                                               {34, 24, 0},
                                               {18, 24, 0}}) {
    CAPTURE(type, bits, descriptor);
    CHECK_THAT(refusal(tga(type, bits, descriptor, std::string(64, '\1'))),
               Contains("of a kind that is not read"));
  }
  std::string palette = tga(2, 24, 0, three);
  palette[1] = 1;
  CHECK_THAT(refusal(palette), Contains("of a kind that is not read"));
  std::string large = tga(2, 24, 0, three);
  large[13] = 2; // 514 pixels wide
  CHECK_THAT(refusal(large), Contains("too short for the size it declares"));
  large = tga(10, 24, 0, three);
  large[13] = large[15] = 2;
  CHECK_THAT(refusal(large), Contains("too short for the size it declares"));
  large[15] = 0;
  CHECK_THAT(refusal(large), Contains("is truncated"));
  std::string empty = tga(2, 24, 0, three);
  empty[14] = 0;
  CHECK_THAT(refusal(empty), Contains("is empty"));
  std::string other = tga(2, 24, 0, three);
  other[other.size() - 2] = '!';
  CHECK_THAT(refusal(other), Contains("is neither a PNG"));
}

TEST_CASE("a BMP with alpha, from the first byte to the last") {
  Image image(2, 3);
  for (std::size_t i = 0; i < image.rgba.size(); ++i)
    image.rgba[i] = static_cast<std::uint8_t>(i + 1);
  CHECK(hex(encoded(image, ImageFormat::bmp)) == "424d"
                                                 "4e000000"
                                                 "00000000"
                                                 "36000000"
                                                 "28000000"
                                                 "02000000"
                                                 "03000000"
                                                 "0100"
                                                 "2000"
                                                 "00000000"
                                                 "18000000"
                                                 "00000000"
                                                 "00000000"
                                                 "00000000"
                                                 "00000000"
                                                 "13121114"
                                                 "17161518"
                                                 "0b0a090c"
                                                 "0f0e0d10"
                                                 "03020104"
                                                 "07060508");
  const std::string wide = encoded(Image(0x203, 1), ImageFormat::bmp);
  CHECK(hex(wide.substr(2, 4)) == "42060000"); // rows of whole words
  CHECK(hex(wide.substr(18, 8)) == "0302000001000000");
  CHECK(hex(wide.substr(34, 4)) == "0c060000");
}

TEST_CASE("BMPs of other programs: from the top, and with masks") {
  const auto bmp = [](int info, int width, int height, int bits, int compression, const std::string& more,
                      const std::string& pixels) {
    const auto number = [](int value, int bytes) {
      std::string text;
      for (int i = 0; i < bytes; ++i)
        text += static_cast<char>(i < 4 ? value >> 8 * i : 0);
      return text;
    };
    const int first = 54 + static_cast<int>(more.size());
    return "BM" + number(0, 4) + number(0, 4) + number(first, 4) + number(info, 4) + number(width, 4) +
           number(height, 4) + number(1, 2) + number(bits, 2) + number(compression, 4) + number(0, 20) +
           more + pixels;
  };
  const std::string rows = from_hex("010203"
                                    "00"
                                    "040506"
                                    "00") +
                           std::string(40, '\0');
  CHECK(pixel_of(decoded(bmp(40, 1, 2, 24, 0, "", rows)), 0, 0) == Rgba{6, 5, 4, 255});
  CHECK(pixel_of(decoded(bmp(40, 1, -2, 24, 0, "", rows)), 0, 0) == Rgba{3, 2, 1, 255});
  CHECK(decoded(bmp(40, 1, -2, 24, 0, "", rows)).height == 2);
  const std::string clear = from_hex("01020304"
                                     "05060700") +
                            std::string(40, '\0');
  CHECK(pixel_of(decoded(bmp(40, 2, 1, 32, 0, "", clear)), 0, 0) == Rgba{3, 2, 1, 4});
  CHECK(pixel_of(decoded(bmp(40, 2, 1, 32, 0, "", clear)), 1, 0) == Rgba{7, 6, 5, 0});
  // Alpha that is 0 everywhere is none.
  const std::string empty = from_hex("01020300"
                                     "05060700") +
                            std::string(40, '\0');
  CHECK(pixel_of(decoded(bmp(40, 2, 1, 32, 0, "", empty)), 0, 0) == Rgba{3, 2, 1, 255});
  CHECK(pixel_of(decoded(bmp(40, 2, 1, 32, 0, "", empty)), 1, 0) == Rgba{7, 6, 5, 255});
  const std::string last = from_hex("01020300"
                                    "05060701") +
                           std::string(40, '\0');
  CHECK(pixel_of(decoded(bmp(40, 2, 1, 32, 0, "", last)), 0, 0) == Rgba{3, 2, 1, 0});
  CHECK(pixel_of(decoded(bmp(40, 2, 1, 32, 0, "", last)), 1, 0) == Rgba{7, 6, 5, 1});
  // Masks of version 3 and 4.
  const std::string masks = from_hex("0000ff00"
                                     "00ff0000"
                                     "ff000000"),
                    alpha = from_hex("000000ff");
  CHECK(pixel_of(decoded(bmp(40, 2, 1, 32, 3, masks, clear)), 0, 0) == Rgba{3, 2, 1, 4});
  CHECK(pixel_of(decoded(bmp(56, 2, 1, 32, 3, masks + alpha, clear)), 0, 0) == Rgba{3, 2, 1, 4});
  CHECK(pixel_of(decoded(bmp(56, 2, 1, 32, 3, masks + std::string(4, '\0'), clear)), 0, 0) ==
        Rgba{3, 2, 1, 255});
  CHECK(pixel_of(decoded(bmp(55, 2, 1, 32, 3, masks + std::string(4, '\0'), clear)), 0, 0) ==
        Rgba{3, 2, 1, 4});
  const std::string kind = "of a kind that is not read";
  for (const char* other : {"ff000000"
                            "00ff0000"
                            "0000ff00",
                            "0000ff00"
                            "00ff0000"
                            "00ff0000",
                            "0000ff00"
                            "ff000000"
                            "ff000000"})
    CHECK_THAT(refusal(bmp(40, 2, 1, 32, 3, from_hex(other), clear)), Contains(kind));
  CHECK_THAT(refusal(bmp(40, 2, 1, 24, 3, masks, clear)), Contains(kind));
  CHECK_THAT(refusal(bmp(39, 2, 1, 24, 0, "", clear)), Contains(kind));
  CHECK_THAT(refusal(bmp(12, 2, 1, 24, 0, "", clear)), Contains(kind));
  CHECK_THAT(refusal(bmp(40, 2, 1, 16, 0, "", clear)), Contains(kind));
  CHECK_THAT(refusal(bmp(40, 2, 1, 24, 1, "", clear)), Contains(kind));
  CHECK_THAT(refusal(bmp(40, 0, 1, 24, 0, "", clear)), Contains("is empty"));
  CHECK_THAT(refusal(bmp(40, -2, 1, 24, 0, "", clear)), Contains("is empty"));
  CHECK_THAT(refusal(bmp(40, 2, 0, 24, 0, "", clear)), Contains("is empty"));
  // One byte less than there have to be.
  const std::string whole = bmp(40, 1, 2, 24, 0, "", std::string(8, '\1'));
  CHECK(refusal(whole).empty());
  CHECK_THAT(refusal(whole.substr(0, whole.size() - 1)), Contains("is truncated"));
  CHECK_THAT(refusal(whole.substr(0, 53)), Contains("is truncated"));
}

TEST_CASE("a Radiance file, from the first byte to the last") {
  const auto row = [](const std::vector<float>& red) {
    ColourImage image(static_cast<int>(red.size()), 1);
    for (std::size_t x = 0; x < red.size(); ++x)
      image.rgba[4 * x] = red[x];
    const std::string bytes = encoded(image, ImageFormat::hdr);
    const std::string header = "#?RADIANCE\nSOFTWARE=celltrace\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X " +
                               std::to_string(red.size()) + "\n";
    REQUIRE(bytes.substr(0, header.size()) == header);
    return hex(bytes.substr(header.size()));
  };
  // Mantissas that end at 256, which carries, and exponents.
  CHECK(row({1}) == "80000081");
  CHECK(row({0.5f}) == "80000080");
  CHECK(row({0.75f}) == "c0000080");
  CHECK(row({255.0f / 256}) == "ff000080");
  CHECK(row({255.4f / 256}) == "ff000080");
  CHECK(row({255.6f / 256}) == "80000081");
  CHECK(row({0.9e-32f}) == "00000000");
  CHECK(row({1.1e-32f}) != "00000000");
  CHECK(row({1e38f}) == row({3e38f}));
  ColourImage pixel(1, 1);
  pixel.rgba = {1, 0.5f, -0.25f, 1};
  CHECK(encoded(pixel, ImageFormat::hdr).substr(64) == from_hex("80400081"));
  // Rows of 8 pixels and more are of runs, channel by channel.
  CHECK(row(std::vector<float>(7, 1)).size() == 2 * 28);
  CHECK(row(std::vector<float>(8, 1)) == "02020008"
                                         "8880"
                                         "8800"
                                         "8800"
                                         "8881");
  const float a = 0.5f, b = 0.75f, c = 0.625f, d = 0.875f; // 80 c0 a0 e0, one exponent
  CHECK(row({a, a, a, b, b, b, b, c}) == "02020008"
                                         "03808080"
                                         "84c0"
                                         "01a0"
                                         "8800"
                                         "8800"
                                         "8880");
  CHECK(row({a, b, c, d, d, d, d, d, a}) == "02020009"
                                            "0380c0a0"
                                            "85e0"
                                            "0180"
                                            "8900"
                                            "8900"
                                            "8980");
  CHECK(row({a, b, a, b, a, b, a, b}) == "02020008"
                                         "0880c080c080c080c0"
                                         "8800"
                                         "8800"
                                         "8880");
  CHECK(row(std::vector<float>(127, a)) == "0202007f"
                                           "ff80"
                                           "ff00"
                                           "ff00"
                                           "ff80");
  CHECK(row(std::vector<float>(128, a)) == "02020080"
                                           "ff800180"
                                           "ff000100"
                                           "ff000100"
                                           "ff800180");
  std::vector<float> changing(129);
  for (std::size_t i = 0; i < changing.size(); ++i)
    changing[i] = i % 2 == 0 ? a : b;
  CHECK(row(changing).substr(8, 2) == "80");
  CHECK(row(changing).substr(8 + 2 * 129, 4) == "0180");
  CHECK(row(std::vector<float>(300, a)).substr(0, 8) == "0202012c");
  CHECK(row(std::vector<float>(32767, a)).size() < 10000);
  CHECK(row(std::vector<float>(32768, a)).size() == 2 * 4 * 32768);
}

TEST_CASE("samples of a PPM are rounded") {
  const auto sample = [](const std::string& maximum, const std::string& three) {
    const Image image = decoded("P6 1 1 " + maximum + "\n" + three);
    return Rgba(image.rgba.begin(), image.rgba.begin() + 3);
  };
  CHECK(sample("\t\v\f1", std::string("\0\1\1", 3)) == Rgba{0, 255, 255});
  CHECK(sample("7", std::string("\1\2\7", 3)) == Rgba{36, 73, 255});
  CHECK(sample("254", std::string("\x7F\x80\xFE", 3)) == Rgba{128, 129, 255});
  CHECK(sample("256", std::string("\1\0\0\x80\0\1", 6)) == Rgba{255, 128, 1});
  CHECK(sample("65535", std::string("\x80\x00\x7F\xFF\x01\x02", 6)) == Rgba{128, 127, 1});
  CHECK_THAT(refusal("P6 1 1 256\n\1\1\1\1\1\1"), Contains("over its own maximum"));
  CHECK_THAT(refusal("P6 1 1 65536\n\1\1\1\1\1\1"), Contains("maximum outside"));
  CHECK(refusal("P6 000000001 1 255\n\1\1\1").empty());
  CHECK_THAT(refusal("P6 0000000001 1 255\n\1\1\1"), Contains("too large"));
  CHECK_THAT(refusal("P6 1 1 255x\1\1\1"), Contains("damaged PPM header"));
  CHECK_THAT(refusal("P6 1 1 255\n\1\1"), Contains("is truncated"));
  CHECK(refusal("P6#a comment that ends\r1#\n1 255\n\1\1\1").find("damaged") != std::string::npos);
  CHECK(refusal("P6 # a comment that ends\r1 1 255\n\1\1\1").empty());
}

TEST_CASE("sizes of pictures at their limits") {
  using image::check_size;
  const std::int64_t side = kMaxImageSide, pixels = kMaxImagePixels;
  CHECK_NOTHROW(check_size(1, 1));
  CHECK_NOTHROW(check_size(side, 1));
  CHECK_NOTHROW(check_size(1, side));
  CHECK_NOTHROW(check_size(1 << 14, pixels >> 14));
  CHECK_THROWS_WITH(check_size((1 << 14) + 1, pixels >> 14), Contains("too large"));
  CHECK_THROWS_WITH(check_size(1, side + 1), Contains("too large: 65535 pixels a side and 134217728 in all"));
  CHECK_THROWS_WITH(check_size(side + 1, 1), Contains("too large"));
  CHECK_THROWS_WITH(check_size(0, 1), Contains("a picture of 0x1 pixels is empty"));
  CHECK_THROWS_WITH(check_size(1, 0), Contains("is empty"));
}

TEST_CASE("formats by their names") {
  CHECK(image::extensions() == ".png, .ppm, .exr, .hdr, .dds, .tga, .bmp and .jpg");
  for (const auto& [extension, format] : {std::pair(".PnG", ImageFormat::png),
                                          {".pnm", ImageFormat::ppm},
                                          {".ppm", ImageFormat::ppm},
                                          {".hdr", ImageFormat::hdr},
                                          {".DDS", ImageFormat::dds},
                                          {".tga", ImageFormat::tga},
                                          {".bmp", ImageFormat::bmp},
                                          {".exr", ImageFormat::exr},
                                          {".jpg", ImageFormat::jpeg},
                                          {".jpeg", ImageFormat::jpeg}}) {
    CAPTURE(extension);
    REQUIRE(image::find_format(extension) != nullptr);
    CHECK(image::find_format(extension)->format == format);
  }
  for (const char* extension : {"", "png", ".", ".pngx", ".pn", "x.png"})
    CHECK(image::find_format(extension) == nullptr);
}

TEST_CASE("formats hold what is as large as they can") {
  std::FILE* const null = std::fopen("/dev/null", "wb");
  REQUIRE(null != nullptr);
  const auto opens = [null](ImageFormat format, std::int64_t width, std::int64_t height, int channels,
                            int bits = 8) {
    image::RowFormat rows;
    rows.width = width;
    rows.height = height;
    rows.channels = channels;
    rows.bits = bits;
    try {
      image::open_rows(null, format, rows);
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  CHECK(opens(ImageFormat::tga, 65535, 1, 3).empty());
  CHECK_THAT(opens(ImageFormat::tga, 65536, 1, 3), Contains("65535 pixels a side, and the picture 65536x1"));
  CHECK(opens(ImageFormat::tga, 65535, 21845, 3).empty()); // 2^32 - 1 bytes less a header
  CHECK_THAT(opens(ImageFormat::tga, 65535, 21846, 3), Contains("too large for a TGA"));
  CHECK(opens(ImageFormat::tga, 65535, 65535, 1).empty());
  CHECK_THAT(opens(ImageFormat::tga, 65535, 65535, 2), Contains("too large for a TGA"));
  CHECK(opens(ImageFormat::png, 1, 1 << 28, 3).empty());
  CHECK_THAT(opens(ImageFormat::png, 1, (1 << 28) + 1, 3), Contains("pixels a side"));
  CHECK(opens(ImageFormat::bmp, 1, 1 << 28, 3).empty());
  CHECK_THAT(opens(ImageFormat::bmp, 4, 1 << 28, 4), Contains("too large for a BMP"));
  CHECK(opens(ImageFormat::ppm, 1, 1, 1).empty());
  CHECK(opens(ImageFormat::ppm, 1, 1, 4).empty());
  CHECK_THAT(opens(ImageFormat::ppm, 1, 1, 0), Contains("1 to 4 channels, not 0"));
  CHECK_THAT(opens(ImageFormat::ppm, 1, 1, 5), Contains("1 to 4 channels, not 5"));
  CHECK_THAT(opens(ImageFormat::ppm, 1, 0, 3), Contains("is empty"));
  CHECK_THAT(opens(ImageFormat::bmp, 1, 1, 2), Contains("no grey"));
  CHECK_THAT(opens(ImageFormat::hdr, 1, 1, 3, 16), Contains("16 bits"));
  CHECK_THAT(opens(ImageFormat::hdr, 1, 1, 1), Contains("no grey"));
  std::fclose(null);
  // What has no alpha leaves it out.
  Image clear = grey_row({1, 2});
  clear.rgba[3] = 9;
  FileOptions grey;
  grey.grey = grey.alpha.emplace(true);
  CHECK(encoded(clear, ImageFormat::ppm, grey).size() == 11 + 2);
  CHECK(encoded(clear, ImageFormat::ppm).size() == 11 + 6);
}

TEST_CASE("luminance and sRGB, channel by channel") {
  FileOptions grey;
  grey.grey = true;
  grey.bits = 16;
  grey.gamma.power = 1.0;
  const auto value = [&](float red, float green, float blue) {
    ColourImage image(1, 1);
    image.rgba = {red, green, blue, 1};
    const std::string bytes = encoded(image, ImageFormat::ppm, ExrOptions(), grey).substr(13);
    return 256 * static_cast<std::uint8_t>(bytes[0]) + static_cast<std::uint8_t>(bytes[1]);
  };
  CHECK(value(1, 0, 0) == std::lround(0.297 * 65535));
  CHECK(value(0, 1, 0) == std::lround(0.589 * 65535));
  CHECK(value(0, 0, 1) == std::lround(0.114 * 65535));
  CHECK(value(0.5f, 0.25f, 0.125f) == std::lround((0.297 / 2 + 0.589 / 4 + 0.114 / 8) * 65535));
  Image image(2, 1);
  image.rgba = {10, 20, 250, 255, 0, 200, 7, 128};
  DeepImage deep(1, 1);
  deep.rgba = {2570, 5140, 64250, 65535};
  grey.bits = 8;
  grey.gamma = {};
  const std::string bytes = encoded(image, ImageFormat::ppm, grey).substr(11);
  CHECK(static_cast<int>(static_cast<std::uint8_t>(bytes[0])) == 95);
  CHECK(static_cast<int>(static_cast<std::uint8_t>(bytes[1])) == 158);
  const std::string two = encoded(deep, ImageFormat::ppm, grey).substr(13);
  CHECK(std::abs(256 * static_cast<std::uint8_t>(two[0]) + static_cast<std::uint8_t>(two[1]) - 257 * 95) <
        129);
}

TEST_CASE("alpha is at least the luminance, for every channel") {
  const auto pixel = [](float red, float green, float blue, float alpha) {
    ColourImage image(1, 1);
    image.gamma = std::nullopt;
    image.rgba = {red, green, blue, alpha};
    const Image made = to_image(image);
    return Rgba(made.rgba.begin(), made.rgba.end());
  };
  CHECK(pixel(0, 0, 1, 0.5f) == Rgba{0, 0, 255, 128}); // 0.114 is less
  CHECK(pixel(0, 1, 0, 0.5f) == Rgba{0, 255, 0, 150});
  CHECK(pixel(4, 4, 4, 0.5f) == Rgba{255, 255, 255, 255});
  CHECK(pixel(0.2f, 0.2f, 0.2f, 0.2f) == Rgba{255, 255, 255, 51});
  CHECK(pixel(0.25f, 0.125f, 0.0625f, 1) == Rgba{64, 32, 16, 255});
  CHECK(pixel(0.25f, 0.125f, 0.0625f, 2) == Rgba{64, 32, 16, 255});
  CHECK(pixel(0.25f, 0.125f, 0.0625f, 0.5f) == Rgba{128, 64, 32, 128});
  CHECK(pixel(0, 0, 0, -1) == Rgba{0, 0, 0, 0});
  CHECK(pixel(0, 0, 0, std::nanf("")) == Rgba{0, 0, 0, 0});
}
