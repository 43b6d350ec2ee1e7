// Pictures in blocks of BC1: the SPEs encode what they would put as pixels.
#include "render/all_machines.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace celltrace;
using namespace celltrace::test;

namespace {

RenderOptions in_blocks(const TestBackend& backend, int width, int height, unsigned spes) {
  RenderOptions options = backend.options(width, height, spes);
  options.blocks = true;
  return options;
}

} // namespace

TEST_CASE("The SPEs' blocks are those of their pixels, to the bit, on every backend") {
  const Scene scene = scene_named("glass and mirrors");
  std::optional<BlockImage> first;
  for (const TestBackend& backend : all_machines())
    for (const auto& [width, height] : {std::pair{43, 26}, std::pair{32, 8}, std::pair{3, 2}}) {
      INFO(backend.spu() << " " << width << "x" << height);
      const RenderResult blocks = render(scene, in_blocks(backend, width, height, 2));
      const RenderResult pixels = render(scene, backend.options(width, height, 2));
      CHECK(blocks.blocks.blocks == encode_blocks(pixels.image).blocks.blocks);
      CHECK(blocks.image == to_image(blocks.blocks));
      REQUIRE(blocks.statistics.block_psnr());
      CHECK(*blocks.statistics.block_psnr() == Approx(compare_images(blocks.image, pixels.image).psnr));
      if (width != 43) continue;
      CHECK(*blocks.statistics.block_psnr() > 28);
      if (!first) first = blocks.blocks;
      if (backend.backend != Backend::cell_sim) CHECK(blocks.blocks.blocks == first->blocks);
    }
}

TEST_CASE("Pixels in blocks take an eighth of the bytes") {
  const Scene scene = scene_named("glass and mirrors");
  const TestBackend backend{Backend::cell_emu, SimdLevel::automatic};
  const RenderStatistics blocks = render(scene, in_blocks(backend, 64, 48, 1)).statistics;
  const RenderStatistics pixels = render(scene, backend.options(64, 48, 1)).statistics;
  CHECK(pixels.pixel_bytes == 64 * 48 * 4);
  CHECK(blocks.pixel_bytes == 64 * 48 / 2);
  CHECK(pixels.dma_bytes_written - blocks.dma_bytes_written == 64 * 48 * 7 / 2);
  CHECK_FALSE(pixels.block_psnr());
}

TEST_CASE("Pictures in blocks can be rendered part by part") {
  const Scene scene = scene_named("glass and mirrors");
  for (const TestBackend& backend : backends()) {
    INFO(backend.spu());
    Renderer renderer(in_blocks(backend, 75, 45, 2));
    REQUIRE(renderer.prepare(scene));
    const RenderResult upper = renderer.render_rows(0, 32), lower = renderer.render_rows(32, 45);
    const RenderResult whole = renderer.render(scene);
    std::vector<std::uint8_t> parts = upper.blocks.blocks;
    constexpr std::size_t kUpper = 8 * 19 * 8;
    std::copy(lower.blocks.blocks.begin() + kUpper, lower.blocks.blocks.end(), parts.begin() + kUpper);
    CHECK(parts == whole.blocks.blocks);
    RenderStatistics sum = upper.statistics;
    add_rows(sum, lower.statistics);
    CHECK(*sum.block_psnr() == *whole.statistics.block_psnr());
    CHECK(sum.pixel_bytes == whole.statistics.pixel_bytes);
  }
}

TEST_CASE("Blocks of one colour, of two, and of a slope are as good as BC1 can be") {
  const auto psnr = [](const std::function<int(int x, int y, int channel)>& value) {
    Image image(16, 16);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        for (int channel = 0; channel < 3; ++channel)
          image.pixel(x, y)[channel] = static_cast<std::uint8_t>(value(x, y, channel));
    const EncodedPicture encoded = encode_blocks(image);
    RenderStatistics statistics;
    statistics.width = statistics.height = 16;
    statistics.block_error = encoded.error;
    const double compared = compare_images(to_image(encoded.blocks), image).psnr;
    CHECK((*statistics.block_psnr() == compared || std::fabs(*statistics.block_psnr() - compared) < 1e-6));
    return *statistics.block_psnr();
  };
  CHECK(std::isinf(psnr([](int, int, int) { return 255; })));
  CHECK(std::isinf(psnr([](int, int, int) { return 0; })));
  CHECK(std::isinf(psnr([](int x, int, int channel) { return x % 2 == 0 ? 255 : channel == 1 ? 255 : 0; })));
  CHECK(psnr([](int x, int y, int) { return 8 * x + 7 * y; }) > 35);
  CHECK(psnr([](int x, int y, int channel) { return channel == 0 ? 100 : 90 + x + y; }) > 38);
}

TEST_CASE("A picture in blocks that is broken off is black where nothing has been rendered") {
  Renderer renderer(in_blocks(backends().front(), 75, 45, 1));
  const Scene scene = scene_named("glass and mirrors");
  const RenderResult none = renderer.render(scene, [](double) { return false; });
  CHECK_FALSE(none.complete);
  CHECK(none.blocks.blocks.size() == 19 * 12 * 8);
  CHECK(renderer.render(scene).complete);
}

TEST_CASE("Blocks are for one model, and hold pixels alone") {
  RenderOptions options = in_blocks(backends().front(), 8, 8, 4);
  options.alpha = true;
  CHECK_THROWS_AS(Renderer(options), InputError);
  options.alpha = false;
  options.antialiasing.emplace();
  CHECK_THROWS_AS(Renderer(options), InputError);
  options.antialiasing.reset();
  options.model = Model::offload;

  CHECK_THROWS_AS(Renderer(options), InputError);
}
