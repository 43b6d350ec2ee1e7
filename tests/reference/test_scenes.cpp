// The reference and the backends on scene files: a group of features each, as far as the reference has them.
// tools/compare-with-povray holds the backends' pictures of the same files against POV-Ray's.
#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"
#include "reference/solids.hpp"
#include "reference/tracer.hpp"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace celltrace;

namespace {

constexpr int kWidth = 96, kHeight = 72;

Image picture_of(const Scene& scene, Backend backend) {
  RenderOptions options;
  options.backend = backend;
  options.width = kWidth;
  options.height = kHeight;
  options.spes = 2;
  return render(scene, options).image;
}

} // namespace

TEST_CASE("The backends render scene files as the reference does") {
  for (const char* name :
       {"shapes", "csg", "csg-bounds", "glass", "lights", "finishes", "area-light", "orthographic", "mesh",
        "mesh-csg", "cameras-cylinder", "cameras-fisheye", "cameras-omnimax", "cameras-spherical"}) {
    ParseOptions parse;
    parse.message = [](std::string_view) {};
    const Scene scene = parse_file(std::filesystem::path(OWN_SCENES) / (std::string(name) + ".pov"), parse);
    const Image expected = reference::Tracer(scene).render(kWidth, kHeight);
    for (const Backend backend : {Backend::native, Backend::cell_emu}) {
      const Comparison comparison = compare_images(expected, picture_of(scene, backend));
      INFO(name << " on " << name_of(backend) << ": " << to_text(comparison));
      CHECK(comparison.psnr >= 45);
    }
  }
}

TEST_CASE("Zeros of polynomials") {
  const auto zeros = [](std::vector<double> coefficients) { return reference::real_zeros(coefficients); };
  CHECK(zeros({}).empty());
  CHECK(zeros({3}).empty());
  CHECK(zeros({1, 0, 1}).empty());
  CHECK(zeros({-6, 2}) == std::vector<double>{3});
  // (x + 2) (x - 1) (x - 3) (x - 4)
  const std::vector<double> four = zeros({-24, 26, 3, -6, 1});
  REQUIRE(four.size() == 4);
  for (int i = 0; i < 4; ++i)
    CHECK(four[static_cast<std::size_t>(i)] ==
          Approx(std::vector<double>{-2, 1, 3, 4}[static_cast<std::size_t>(i)]));
  CHECK(zeros({-1, 0, 0, 1, 0}).size() == 1);
}
