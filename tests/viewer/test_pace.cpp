// How coarse the viewer's pictures are.
#include "viewer/pace.hpp"

#include <catch2/catch.hpp>

using celltrace::viewer::Pace;

TEST_CASE("Quick pictures come at once, and slow ones coarsely first") {
  constexpr double kPixels = 640 * 480;
  Pace pace;
  CHECK(pace.first_scale(kPixels) > 1); // nothing is known
  CHECK(pace.first_scale(100) == 1);
  pace.learn(0.01, kPixels);
  CHECK(pace.first_scale(kPixels) == 1);
  pace.learn(1, kPixels);
  const int scale = pace.first_scale(kPixels);
  CHECK(scale == 8);
  CHECK(pace.expected(kPixels, scale) <= Pace::kFirst);
  CHECK(pace.next_scale(kPixels, scale) == 4);
  CHECK(pace.next_scale(kPixels, 1) == 1);
  pace.learn(1000, kPixels);
  CHECK(pace.first_scale(kPixels) == Pace::kCoarsest);
}

TEST_CASE("What becomes slower counts at once, what becomes quicker little by little") {
  Pace pace;
  pace.learn(0.1, 1000);
  pace.learn(1, 1000);
  CHECK(pace.expected(1000, 1) == Approx(1));
  pace.learn(0.1, 1000);
  CHECK(pace.expected(1000, 1) == Approx(0.55));
  pace.learn(0, 1000); // a clock that did not move says nothing
  pace.learn(1, 0);
  CHECK(pace.expected(1000, 1) == Approx(0.55));
  CHECK(pace.expected(1000, 2) == Approx(0.55 / 4));
}

TEST_CASE("A picture that takes a quarter of a second comes as a whole after the first one") {
  Pace pace;
  pace.learn(0.2, 640 * 480);
  const int scale = pace.first_scale(640 * 480);
  CHECK(scale == 4);
  CHECK(pace.next_scale(640 * 480, scale) == 1);
}
