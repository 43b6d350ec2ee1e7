#include "image/limits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include <nlohmann/json.hpp>

namespace celltrace {

namespace {

constexpr int kBlock = 8;

void check_pair(const Image& a, const Image& b) {
  image::check_image(a);
  image::check_image(b);
  if (a.width == b.width && a.height == b.height) return;
  throw InputError("the pictures differ in size: " + std::to_string(a.width) + "x" +
                   std::to_string(a.height) + " and " + std::to_string(b.width) + "x" +
                   std::to_string(b.height));
}

double psnr(const Image& a, const Image& b) {
  std::int64_t squares = 0; // at most 3 * 2^27 * 255^2
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    const int difference = i % 4 == 3 ? 0 : a.rgba[i] - b.rgba[i];
    squares += difference * difference;
  }
  if (squares == 0) return std::numeric_limits<double>::infinity();
  const double samples = 3.0 * a.width * a.height;
  return 10 * std::log10(255.0 * 255.0 * samples / static_cast<double>(squares));
}

void count_differences(const Image& a, const Image& b, Comparison& result) {
  for (std::size_t pixel = 0; pixel < a.rgba.size(); pixel += 4) {
    int largest = 0;
    for (std::size_t i = pixel; i < pixel + 4; ++i)
      largest = std::max(largest, std::abs(a.rgba[i] - b.rgba[i]));
    result.differing_pixels += largest > 0;
    result.max_difference = std::max(result.max_difference, largest);
  }
}

/// Returns the Rec. 601 luma, 0..255.
double luma(const std::uint8_t* rgb) {
  return 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
}

struct Block {
  int x, y, width, height;
};

/// Returns the SSIM of a block: Wang et al. (2004), equation 13, with K1 = 0.01, K2 = 0.03 and population
/// statistics.
double ssim(const Image& a, const Image& b, const Block& block) {
  double sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x) {
      const double luma_a = luma(a.pixel(x, y));
      const double luma_b = luma(b.pixel(x, y));
      sum_a += luma_a;
      sum_b += luma_b;
      sum_aa += luma_a * luma_a;
      sum_bb += luma_b * luma_b;
      sum_ab += luma_a * luma_b;
    }
  const double count = block.width * block.height;
  const double mean_a = sum_a / count, mean_b = sum_b / count;
  const double variance_a = sum_aa / count - mean_a * mean_a;
  const double variance_b = sum_bb / count - mean_b * mean_b;
  const double covariance = sum_ab / count - mean_a * mean_b;
  constexpr double c1 = (0.01 * 255) * (0.01 * 255);
  constexpr double c2 = (0.03 * 255) * (0.03 * 255);
  return (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
         ((mean_a * mean_a + mean_b * mean_b + c1) * (variance_a + variance_b + c2));
}

void find_worst_block(const Image& a, const Image& b, Comparison& result) {
  const int block_width = std::min(kBlock, a.width);
  const int block_height = std::min(kBlock, a.height);
  for (int top = 0; top < a.height; top += kBlock)
    for (int left = 0; left < a.width; left += kBlock) {
      const Block block{std::min(left, a.width - block_width), std::min(top, a.height - block_height),
                        block_width, block_height};
      const double value = ssim(a, b, block);
      if (value >= result.worst_ssim) continue;
      result.worst_ssim = value;
      result.worst_x = block.x;
      result.worst_y = block.y;
    }
}

} // namespace

Comparison compare_images(const Image& a, const Image& b) {
  check_pair(a, b);
  Comparison result;
  result.width = a.width;
  result.height = a.height;
  result.psnr = psnr(a, b);
  count_differences(a, b, result);
  if (!std::isinf(result.psnr)) find_worst_block(a, b, result);
  return result;
}

std::string to_text(const Comparison& c) {
  char line[200];
  const long long differing = c.differing_pixels;
  const long long pixels = static_cast<long long>(c.width) * c.height;
  if (differing == 0)
    std::snprintf(line, sizeof line, "identical, %dx%d pixels", c.width, c.height);
  else
    std::snprintf(line, sizeof line,
                  "PSNR %.2f dB, worst 8x8 SSIM %.4f at (%d, %d), %lld of %lld pixels differ, by %d at most",
                  c.psnr, c.worst_ssim, c.worst_x, c.worst_y, differing, pixels, c.max_difference);
  return line;
}

std::string to_json(const Comparison& c) {
  nlohmann::ordered_json json;
  json["width"] = c.width;
  json["height"] = c.height;
  json["identical"] = c.differing_pixels == 0;
  json["psnr"] = std::isinf(c.psnr) ? nlohmann::ordered_json() : nlohmann::ordered_json(c.psnr);
  json["worst_ssim"] = c.worst_ssim;
  json["worst_x"] = c.worst_x;
  json["worst_y"] = c.worst_y;
  json["differing_pixels"] = c.differing_pixels;
  json["max_difference"] = c.max_difference;
  return json.dump(2);
}

Image difference_image(const Image& a, const Image& b, int gain) {
  check_pair(a, b);
  if (gain < 1 || gain > 255) throw InputError("the gain of a difference picture is 1..255");
  Image result(a.width, a.height);
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    if (i % 4 != 3)
      result.rgba[i] = static_cast<std::uint8_t>(std::min(255, gain * std::abs(a.rgba[i] - b.rgba[i])));
  return result;
}

} // namespace celltrace
