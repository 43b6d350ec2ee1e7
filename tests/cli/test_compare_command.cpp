#include "cli/compare_command.hpp"

#include "image/picture_files.hpp"

#include <iostream>
#include <sstream>

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::cli;
using namespace celltrace::test;

namespace {

struct Output {
  int exit_code;
  std::string text;
};

Output run(const CompareRequest& request) {
  std::ostringstream captured;
  std::streambuf* const before = std::cout.rdbuf(captured.rdbuf());
  const int exit_code = run_compare(request);
  std::cout.rdbuf(before);
  return {exit_code, captured.str()};
}

} // namespace

TEST_CASE("compare prints one line and holds pictures to the bars it is given") {
  const TemporaryFolder folder;
  save_image(folder / "a.png", uniform(8, 8, 100));
  save_image(folder / "b.ppm", uniform(8, 8, 110));
  CompareRequest request;
  request.a = folder / "a.png";
  request.b = folder / "b.ppm";
  // MSE 100: PSNR 28.13; SSIM 0.99548
  CHECK(run(request).exit_code == 0);
  CHECK(run(request).text ==
        "PSNR 28.13 dB, worst 8x8 SSIM 0.9955 at (0, 0), 64 of 64 pixels differ, by 10 at most\n");
  request.min_psnr = 28;
  request.min_ssim = 0.99;
  CHECK(run(request).exit_code == 0);
  request.min_psnr = 29;
  CHECK(run(request).exit_code == 1);
  request.min_psnr.reset();
  request.min_ssim = 0.999;
  CHECK(run(request).exit_code == 1);
}

TEST_CASE("an identical picture passes every bar") {
  const TemporaryFolder folder;
  save_image(folder / "a.png", asymmetric_image(8, 8));
  CompareRequest request;
  request.a = request.b = folder / "a.png";
  request.min_psnr = 1000;
  request.min_ssim = 1;
  CHECK(run(request).exit_code == 0);
  request.json = true;
  CHECK(run(request).text.find("\"identical\": true") != std::string::npos);
}

TEST_CASE("compare writes the difference") {
  const TemporaryFolder folder;
  save_image(folder / "a.png", uniform(9, 9, 100));
  save_image(folder / "b.png", uniform(9, 9, 110));
  CompareRequest request;
  request.a = folder / "a.png";
  request.b = folder / "b.png";
  request.difference = folder / "d.png";
  run(request);
  CHECK(load_image(folder / "d.png") == uniform(9, 9, 80));
}
