#include "picture_files.hpp"

#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace celltrace;
using celltrace::test::asymmetric_image;
using celltrace::test::uniform;

TEST_CASE("identical pictures have an infinite PSNR") {
  const Comparison c = compare_images(asymmetric_image(17, 9), asymmetric_image(17, 9));
  CHECK(std::isinf(c.psnr));
  CHECK(c.worst_ssim == 1);
  CHECK(c.differing_pixels == 0);
  CHECK(c.max_difference == 0);
  CHECK(to_text(c) == "identical, 17x9 pixels");

  const auto json = nlohmann::json::parse(to_json(c));
  CHECK(json["identical"] == true);
  CHECK(json["psnr"].is_null());
  CHECK(json["worst_ssim"] == 1.0);
  CHECK(json["width"] == 17);
}

TEST_CASE("PSNR follows its definition") {
  // One channel of one of four pixels is off by 51: MSE = 51^2 / 12, PSNR = 10 log10(25 * 12).
  Image a(2, 2);
  Image b = a;
  b.pixel(1, 0)[1] = 51;
  const Comparison c = compare_images(a, b);
  CHECK(c.psnr == Approx(24.7712).epsilon(1e-5));
  CHECK(c.differing_pixels == 1);
  CHECK(c.max_difference == 51);

  // Black and white: MSE is the peak squared.
  CHECK(compare_images(uniform(5, 3, 0), uniform(5, 3, 255)).psnr == Approx(0).margin(1e-12));
}

TEST_CASE("SSIM of flat blocks is its luminance term") {
  // No variance: (2*100*110 + 6.5025) / (100^2 + 110^2 + 6.5025).
  const Comparison c = compare_images(uniform(8, 8, 100), uniform(8, 8, 110));
  CHECK(c.worst_ssim == Approx(22006.5025 / 22106.5025).epsilon(1e-9));
}

TEST_CASE("SSIM of opposite checks is nearly minus one") {
  Image a(8, 8), b(8, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (int channel = 0; channel < 3; ++channel)
        ((x + y) % 2 ? a : b).pixel(x, y)[channel] = 200;
  // Means 100, variances 10000, covariance -10000: (58.5225 - 20000) / (58.5225 + 20000).
  CHECK(compare_images(a, b).worst_ssim == Approx(-19941.4775 / 20058.5225).epsilon(1e-9));
}

TEST_CASE("the worst block is found, also at an edge that is no multiple of eight") {
  const Image a = asymmetric_image(20, 19);
  Image b = a;
  b.pixel(19, 18)[0] ^= 0x80;
  const Comparison c = compare_images(a, b);
  CHECK(c.worst_ssim < 1);
  CHECK(c.worst_x == 12);
  CHECK(c.worst_y == 11);
  CHECK(c.differing_pixels == 1);
  CHECK(c.max_difference == 128);
}

TEST_CASE("a picture of one pixel has a block of one pixel") {
  CHECK(compare_images(uniform(1, 1, 0), uniform(1, 1, 255)).worst_ssim ==
        Approx(6.5025 / (255.0 * 255.0 + 6.5025)));
}

TEST_CASE("alpha counts as a difference but not for PSNR") {
  const Image a(3, 3);
  Image b = a;
  b.pixel(2, 2)[3] = 250;
  const Comparison c = compare_images(a, b);
  CHECK(std::isinf(c.psnr));
  CHECK(c.differing_pixels == 1);
  CHECK(c.max_difference == 5);
  CHECK(to_text(c) == "PSNR inf dB, worst 8x8 SSIM 1.0000 at (0, 0), 1 of 9 pixels differ, by 5 at most");
  CHECK(nlohmann::json::parse(to_json(c))["identical"] == false);
}

TEST_CASE("pictures of different sizes are not compared") {
  CHECK_THROWS_WITH(compare_images(Image(2, 3), Image(3, 2)), "the pictures differ in size: 2x3 and 3x2");
  CHECK_THROWS_AS(compare_images(Image(), Image()), InputError);
}

TEST_CASE("the difference picture is amplified and clipped") {
  Image a(2, 1), b(2, 1);
  a.pixel(0, 0)[0] = 10;
  b.pixel(0, 0)[1] = 3;
  b.pixel(1, 0)[2] = 200;
  const Image difference = difference_image(a, b, 8);
  CHECK(difference.rgba == std::vector<std::uint8_t>{80, 24, 0, 255, 0, 0, 255, 255});
  CHECK_THROWS_AS(difference_image(a, b, 0), InputError);
}
