// Options at the ends of what is taken, and one beyond.
#include "celltrace/error.hpp"
#include "render/camera_setup.hpp"
#include "render/frame_setup.hpp"
#include "render/picture_options.hpp"

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

using namespace celltrace;
using Catch::Matchers::Contains;

namespace {

std::string refusal(const std::function<void(RenderOptions&)>& change) {
  RenderOptions options;
  change(options);
  try {
    check(options);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

} // namespace

TEST_CASE("Options are taken up to their bounds") {
  const auto takes = [](const std::function<void(RenderOptions&)>& change) {
    CHECK(refusal(change).empty());
  };
  const auto refuses = [](const char* why, const std::function<void(RenderOptions&)>& change) {
    CHECK_THAT(refusal(change), Contains(why));
  };
  takes([](RenderOptions& o) { o.width = o.height = 1; });
  takes([](RenderOptions& o) { o.width = 65535; });
  takes([](RenderOptions& o) { o.height = 65535; });
  takes([](RenderOptions& o) { o.width = 1 << 14, o.height = 1 << 13; });
  refuses("8193 pixels is too large to be in memory as a whole",
          [](RenderOptions& o) { o.width = 1 << 14, o.height = (1 << 13) + 1; });
  refuses("have to be 1 to 65535", [](RenderOptions& o) { o.width = 65536; });
  refuses("have to be 1 to 65535", [](RenderOptions& o) { o.height = 0; });
  takes([](RenderOptions& o) { o.max_trace_level = 1; });
  takes([](RenderOptions& o) { o.max_trace_level = 256; });
  refuses("1 to 256", [](RenderOptions& o) { o.max_trace_level = 0; });
  refuses("1 to 256", [](RenderOptions& o) { o.max_trace_level = 257; });
  takes([](RenderOptions& o) { o.adc_bailout = 0; });
  refuses("must not be negative", [](RenderOptions& o) { o.adc_bailout = -1e-9; });
  takes([](RenderOptions& o) { o.quality = 0; });
  takes([](RenderOptions& o) { o.quality = 11; });
  refuses("0 to 11", [](RenderOptions& o) { o.quality = -1; });
  refuses("0 to 11", [](RenderOptions& o) { o.quality = 12; });
  takes([](RenderOptions& o) { o.most_seconds = 0; });
  takes([](RenderOptions& o) { o.most_seconds = std::numeric_limits<double>::infinity(); });
  refuses("seconds must not be negative", [](RenderOptions& o) { o.most_seconds = -1e-9; });

  takes([](RenderOptions& o) { o.region = PictureRegion{0, 640, 0, 480}; });
  takes([](RenderOptions& o) { o.region = PictureRegion{639, 640, 479, 480}; });
  for (const PictureRegion& region : {PictureRegion{-1, 640, 0, 480},
                                      {0, 641, 0, 480},
                                      {0, 640, -1, 480},
                                      {0, 640, 0, 481},
                                      {9, 9, 0, 480},
                                      {0, 640, 9, 9},
                                      {9, 8, 0, 1},
                                      {0, 1, 9, 8}})
    refuses("the region to render", [&](RenderOptions& o) { o.region = region; });

  const auto sampled = [](const std::function<void(Antialiasing&)>& change) {
    return [change](RenderOptions& o) { change(o.antialiasing.emplace()); };
  };
  takes(sampled([](Antialiasing& a) { a.depth = 1, a.threshold = 0, a.jitter = 0; }));
  takes(sampled([](Antialiasing& a) { a.depth = 9, a.jitter = 1, a.gamma = 1e-9; }));
  refuses("1 to 9", sampled([](Antialiasing& a) { a.depth = 0; }));
  refuses("1 to 9", sampled([](Antialiasing& a) { a.depth = 10; }));
  refuses("threshold", sampled([](Antialiasing& a) { a.threshold = -1e-9; }));
  refuses("threshold",
          sampled([](Antialiasing& a) { a.threshold = std::numeric_limits<double>::infinity(); }));
  refuses("jitter", sampled([](Antialiasing& a) { a.jitter = 1.01; }));
  refuses("jitter", sampled([](Antialiasing& a) { a.jitter = -0.01; }));
  refuses("gamma", sampled([](Antialiasing& a) { a.gamma = 0; }));
  refuses("gamma", sampled([](Antialiasing& a) { a.gamma = std::numeric_limits<double>::infinity(); }));
}

TEST_CASE("A picture takes so many bytes a pixel") {
  const auto bytes = [](const std::function<void(RenderOptions&)>& change) {
    const std::string all = refusal([&](RenderOptions& o) {
      o.width = o.height = 10;
      o.most_memory = 1;
      change(o);
    });
    return all.empty() ? 0 : std::stoi(all.substr(18)) / 100;
  };
  CHECK_THAT(refusal([](RenderOptions& o) { o.most_memory = 1; }),
             Contains("the picture takes 1228800 bytes, and 1 are allowed"));
  CHECK(bytes([](RenderOptions&) {}) == 4);
  CHECK(bytes([](RenderOptions& o) { o.antialiasing.emplace(); }) == 20);
  CHECK(bytes([](RenderOptions& o) { o.colours = true; }) == 36);
  CHECK(bytes([](RenderOptions& o) { o.alpha = true; }) == 36);
  CHECK(bytes([](RenderOptions& o) { o.colours = o.alpha = true; }) == 36);
  CHECK(bytes([](RenderOptions& o) { o.first_hits = true; }) == 56);
  CHECK(bytes([](RenderOptions& o) { o.most_memory = 400; }) == 0);
  CHECK(bytes([](RenderOptions& o) { o.most_memory = 399; }) == 4);
  CHECK(bytes([](RenderOptions& o) { o.most_memory = 0; }) == 0);
  // Of rows, as many as there are at once.
  CHECK(bytes([](RenderOptions& o) { o.height = 1000, o.rows_at_once = 32, o.most_memory = 1279; }) == 12);
  CHECK(bytes([](RenderOptions& o) { o.height = 1000, o.rows_at_once = 32, o.most_memory = 1280; }) == 0);
}

TEST_CASE("Rows at once are a multiple of a step, or all") {
  const auto refused = [](
                           int rows,
                           const std::function<void(RenderOptions&)>& change = [](RenderOptions&) {}) {
    return refusal([&](RenderOptions& o) {
      o.rows_at_once = rows;
      change(o);
    });
  };
  const int step = Renderer::kRowStep;
  CHECK(refused(step).empty());
  CHECK(refused(480).empty());
  CHECK(refused(481).empty());
  CHECK_THAT(refused(step + 1), Contains("have to be a multiple of"));
  CHECK_THAT(refused(-step), Contains("have to be a multiple of"));
  CHECK(refused(7, [](RenderOptions& o) { o.region = PictureRegion{0, 640, 100, 107}; }).empty());
  CHECK_THAT(refused(7,
                     [](RenderOptions& o) {
                       o.region = PictureRegion{0, 640, 100, 108};
                     }),
             Contains("multiple"));
  const auto tall = [](RenderOptions& o) { o.width = o.height = 65535; };
  CHECK(refused(2048 - step, tall).empty());
  CHECK_THAT(refused(2048 + step, tall), Contains("have to have at most 134217728 pixels"));
  CHECK_THAT(refused(step, [](RenderOptions& o) { o.model = Model::pipeline; }),
             Contains("shared programming model"));
  CHECK(refused(480, [](RenderOptions& o) { o.model = Model::pipeline; }).empty());
  CHECK_THAT(refused(480, [](RenderOptions& o) { o.blocks = true; }), Contains("rendered as a whole"));
}

TEST_CASE("What goes with one programming model, or with no other kind of picture") {
  const auto shared_only = [](const char* why, const std::function<void(RenderOptions&)>& change) {
    CHECK(refusal(change).empty());
    CHECK_THAT(refusal([&](RenderOptions& o) {
                 change(o);
                 o.model = Model::offload;
               }),
               Contains(why));
  };
  shared_only("antialiasing is for the shared", [](RenderOptions& o) { o.antialiasing.emplace(); });
  shared_only("colours as numbers are for the shared", [](RenderOptions& o) { o.colours = true; });
  shared_only("pictures with alpha are for the shared", [](RenderOptions& o) { o.alpha = true; });
  shared_only("what is seen first is told by the shared", [](RenderOptions& o) { o.first_hits = true; });
  shared_only("pictures in blocks are for the shared", [](RenderOptions& o) { o.blocks = true; });
  const char* const split = "the split pipeline finds objects by the grid";
  const auto by = [](Model model, Accelerator accelerator) {
    return refusal([=](RenderOptions& o) {
      o.model = model;
      o.accelerator = accelerator;
    });
  };
  CHECK_THAT(by(Model::pipeline_split, Accelerator::bvh), Contains(split));
  CHECK(by(Model::pipeline_split, Accelerator::grid).empty());
  CHECK(by(Model::pipeline, Accelerator::bvh).empty());
  for (const std::function<void(RenderOptions&)>& change :
       {std::function<void(RenderOptions&)>([](RenderOptions& o) { o.antialiasing.emplace(); }),
        std::function<void(RenderOptions&)>([](RenderOptions& o) {
          o.region = PictureRegion{0, 1, 0, 1};
        }),
        std::function<void(RenderOptions&)>([](RenderOptions& o) { o.alpha = true; }),
        std::function<void(RenderOptions&)>([](RenderOptions& o) { o.colours = true; }),
        std::function<void(RenderOptions&)>([](RenderOptions& o) { o.first_hits = true; })})
    CHECK_THAT(refusal([&](RenderOptions& o) {
                 o.blocks = true;
                 change(o);
               }),
               Contains("without antialiasing, region"));
  CHECK_THAT(refusal([](RenderOptions& o) {
               o.blocks = true;
               o.finished_block = [](const PictureBlock&) {};
             }),
             Contains("cannot be watched"));
  CHECK(refusal([](RenderOptions& o) { o.finished_block = [](const PictureBlock&) {}; }).empty());
}

TEST_CASE("A region is the whole picture unless it is given") {
  RenderOptions options;
  CHECK(region_of(options).right == 640);
  CHECK(region_of(options).bottom == 480);
  CHECK(region_of(options).left == 0);
  CHECK_FALSE(brings_colours(options));
  options.region = PictureRegion{3, 50, 7, 70};
  CHECK(region_of(options).left == 3);
  CHECK(region_of(options).top == 7);
  const PictureOnGrid whole = picture_on_grid(RenderOptions());
  CHECK(whole.width == 640);
  CHECK(whole.height == 480);
  options.colours = true;
  CHECK(brings_colours(options));
}

TEST_CASE("A grid has about eight voxels an object, as cubic as they can be") {
  const auto cells = [](const Vec3& size, std::uint32_t objects) {
    kernel::ImageHeader header{};
    header.object_count = objects;
    for (int axis = 0; axis < 3; ++axis) {
      header.bounds_min[axis] = -1;
      header.bounds_max[axis] = static_cast<float>(size[axis]) - 1;
    }
    const kernel::GridRecord grid = choose_grid(header);
    CHECK(grid.row_of_cells == grid.cells[0] * grid.cells[1]);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(grid.cell_size[axis] * static_cast<float>(grid.cells[axis]) ==
            Approx(grid.max[axis] - grid.min[axis]).margin(1e-6));
      CHECK(grid.cell_size[axis] * grid.inverse_cell_size[axis] == Approx(1));
      CHECK(0.5f * (grid.min[axis] + grid.max[axis]) == Approx(0.5 * size[axis] - 1));
    }
    return std::vector<std::uint32_t>(grid.cells, grid.cells + 3);
  };
  using Cells = std::vector<std::uint32_t>;
  CHECK(cells({1, 1, 1}, 1) == Cells{2, 2, 2});
  CHECK(cells({1, 1, 1}, 1000) == Cells{20, 20, 20});
  CHECK(cells({4, 2, 1}, 1000) == Cells{40, 20, 10});
  CHECK(cells({1, 1, 0}, 1250) == Cells{100, 100, 1}); // a flat one
  CHECK(cells({100, 0, 0}, 64) == Cells{512, 1, 1});
  CHECK(cells({1, 1, 1}, 1u << 30) == Cells{256, 256, 256});
}
