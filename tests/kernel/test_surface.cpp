// From colours to bytes: encoding against the exact formulas, and where the pixels go.
#include "kernel/program/pixel_writer.hpp"
#include "lanes.hpp"
#include "reference/shading.hpp"
#include "scene_image/scene_image.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

/// A picture of `width` x `height` pixels in packets, as the renderer lays it out.
class Surface {
public:
  Surface(std::uint32_t width, std::uint32_t height, GammaEncoding gamma = GammaEncoding::none,
          float assumed = 1)
      : columns_((width + 3) / 4), rows_((height + 3) / 4), block_(std::size_t{columns_} * rows_ * 64) {
    frame_.width = width;
    frame_.height = height;
    frame_.packet_columns = columns_;
    frame_.packet_rows = rows_;
    frame_.surface_pitch = columns_ * 16;
    frame_.surface = reinterpret_cast<std::uintptr_t>(block_.data());
    frame_.gamma_encoding = static_cast<std::uint32_t>(gamma);
    frame_.assumed_gamma = assumed;
  }
  const FrameBlock& frame() const { return frame_; }
  std::uint32_t columns() const { return columns_; }
  std::uint32_t rows() const { return rows_; }
  const std::uint8_t* pixel(std::uint32_t x, std::uint32_t y) const {
    return reinterpret_cast<const std::uint8_t*>(block_.data()) + y * frame_.surface_pitch + x * 4;
  }

private:
  std::uint32_t columns_, rows_;
  AlignedBlock block_;
  FrameBlock frame_{};
};

void check_encoding(GammaEncoding gamma, GammaMode mode, double assumed) {
  const Surface surface(4, 4, gamma, static_cast<float>(assumed));
  DirectSpu spu;
  PixelWriter<DirectSpu> writer(spu, surface.frame());
  const int kPackets = times(20000);
  long off = 0;
  int most = 0;
  for (int k = 0; k < kPackets; ++k) {
    FloatLanes value;
    for (int l = 0; l < 16; ++l)
      value.lane[l] =
          static_cast<float>((k * 16 + l) * 1.02 / (kPackets * 16) - 0.01); // a little past both ends
    writer.put(0, 0, {load(value), F(0.25f), load(value)});
    writer.flush();
    for (unsigned l = 0; l < 16; ++l) {
      const std::uint8_t* p = surface.pixel(l % 4, l / 4);
      const int expected = reference::encode(value.lane[l], mode, assumed);
      most = std::max(most, std::abs(p[0] - expected));
      off += p[0] != expected ? 1 : 0;
      REQUIRE(p[2] == p[0]);
      REQUIRE(p[1] == reference::encode(0.25, mode, assumed));
      REQUIRE(p[3] == 255);
    }
  }
  INFO("gamma " << assumed << ": " << off << " values off");
  CHECK(most <= 1);
  CHECK(off < kPackets * 16 / 1000);
}

} // namespace

TEST_CASE("Values become bytes by the exact formulas, hardly any a step off") {
  check_encoding(GammaEncoding::none, GammaMode::none, 1);
  for (double assumed : {1.0, 1.8, 2.2, 0.5})
    check_encoding(GammaEncoding::assumed, GammaMode::assumed, assumed);
}

TEST_CASE("Colours far out of range are clipped") {
  for (GammaEncoding gamma : {GammaEncoding::none, GammaEncoding::assumed}) {
    const Surface surface(4, 4, gamma, 2.2f);
    DirectSpu spu;
    PixelWriter<DirectSpu> writer(spu, surface.frame());
    writer.put(0, 0, {F(1e30f), F(-1e30f), F(std::numeric_limits<float>::denorm_min())});
    writer.flush();
    for (unsigned l = 0; l < 16; ++l) {
      const std::uint8_t* p = surface.pixel(l % 4, l / 4);
      REQUIRE(int{p[0]} == 255);
      REQUIRE(int{p[1]} == 0);
      REQUIRE(int{p[2]} == 0);
    }
  }
}

/// Writes a picture whose pixels say where they belong, in blocks of `kRows` x `kRows` packets.
template <std::uint32_t kRows> void check_places() {
  for (const auto& [width, height] :
       {std::pair{1u, 1u}, {4u, 4u}, {5u, 3u}, {33u, 17u}, {100u, 4u}, {250u, 90u}}) {
    const Surface surface(width, height);
    DirectSpu spu;
    PixelWriter<DirectSpu, kRows> writer(spu, surface.frame());
    const auto put = [&](std::uint32_t column, std::uint32_t row) {
      FloatLanes x, y;
      for (unsigned l = 0; l < 16; ++l) {
        x.lane[l] = static_cast<float>(column * 4 + l % 4) / 255;
        y.lane[l] = static_cast<float>(row * 4 + l / 4) / 255;
      }
      writer.put(column, row, {load(x), load(y), F(1.0f)});
    };
    for (std::uint32_t top = 0; top < surface.rows(); top += kRows)
      for (std::uint32_t left = 0; left < surface.columns(); left += kRows)
        for (std::uint32_t row = top; row < std::min(top + kRows, surface.rows()); ++row)
          for (std::uint32_t column = left; column < std::min(left + kRows, surface.columns()); ++column)
            put(column, row);
    writer.flush();
    for (std::uint32_t y = 0; y < surface.rows() * 4; ++y)
      for (std::uint32_t x = 0; x < surface.columns() * 4; ++x) {
        const std::uint8_t* p = surface.pixel(x, y);
        REQUIRE(int{p[0]} == static_cast<int>(x));
        REQUIRE(int{p[1]} == static_cast<int>(y));
        REQUIRE(int{p[2]} == 255);
        REQUIRE(int{p[3]} == 255);
      }
  }
}

TEST_CASE("Every block of pixels goes to its own place, red first") {
  check_places<1>();
  check_places<2>();
  check_places<4>();
}

TEST_CASE("A block of one colour is filled like packet by packet, between others") {
  Random random(70);
  const Surface filled(80, 32), put(80, 32);
  DirectSpu spu;
  PixelWriter<DirectSpu, 4> filling(spu, filled.frame());
  PixelWriter<DirectSpu, 4> putting(spu, put.frame());
  for (std::uint32_t row = 0; row < 8; row += 4)
    for (std::uint32_t column = 0; column < 20; column += 4) {
      const Vec colour = {F(static_cast<float>(random.uniform(0, 1))),
                          F(static_cast<float>(random.uniform(0, 1))),
                          F(static_cast<float>(random.uniform(0, 1)))};
      const bool fill = random.below(2) == 0;
      if (fill) filling.fill(column, row, colour);
      for (std::uint32_t i = 0; i < 16; ++i) {
        putting.put(column + i % 4, row + i / 4, colour);
        if (!fill) filling.put(column + i % 4, row + i / 4, colour);
      }
    }
  filling.flush();
  putting.flush();
  for (std::uint32_t y = 0; y < 32; ++y)
    for (std::uint32_t x = 0; x < 80; ++x)
      REQUIRE(std::equal(filled.pixel(x, y), filled.pixel(x, y) + 4, put.pixel(x, y)));
}
