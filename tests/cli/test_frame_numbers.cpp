#include "cli/frame_numbers.hpp"

#include "celltrace/error.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::cli;
using Frames = std::vector<int>;

namespace {

Animation animation(int initial, int last, bool cyclic = false) {
  Animation a;
  a.initial_frame = initial;
  a.final_frame = last;
  a.cyclic = cyclic;
  return a;
}

Frames part(std::optional<double> start, std::optional<double> end, Animation a = animation(1, 10)) {
  a.start_frame = start;
  a.end_frame = end;
  return frames_to_render(a);
}

} // namespace

TEST_CASE("an animation has the frames that POV-Ray renders") {
  CHECK_FALSE(Animation().is_on());
  CHECK(animation(1, 2).is_on());
  CHECK(animation(0, 1).is_on());
  CHECK(frames_to_render(animation(1, 3)) == Frames{1, 2, 3});
  CHECK(frames_to_render(animation(0, 2)) == Frames{0, 1, 2});
  CHECK(frames_to_render(animation(5, 5)) == Frames{5});
  CHECK(frames_to_render(animation(1, 3, true)) == Frames{1, 2, 3});
}

TEST_CASE("parts of an animation are frames or fractions") {
  CHECK(part(3, 4) == Frames{3, 4});
  CHECK(part(0.3, 0.6) == Frames{3, 4, 5, 6});
  CHECK(part(0.25, 0.75) == Frames{2, 3, 4, 5, 6, 7});
  CHECK(part(0, 0.2) == Frames{1, 2});
  CHECK(part(0.99, {}) == Frames{9, 10});
  CHECK(part(1, 1) == Frames{1});
  CHECK(part(1.5, 2.5) == Frames{1, 2});
  CHECK(part({}, 0.5, animation(10, 20)) == Frames{10});
  Animation stepped = animation(1, 10);
  stepped.step = 3;
  CHECK(frames_to_render(stepped) == Frames{1, 4, 7, 10});
  CHECK(part(2, {}, stepped) == Frames{2, 5, 8});
}

TEST_CASE("parts of an animation end where POV-Ray ends them") {
  CHECK(part(8, 12) == Frames{8, 9, 10, 11, 12});
  CHECK(part(3, {}, animation(5, 7)) == Frames{5, 6, 7});
  CHECK(part(2, 6, animation(5, 9)) == Frames{5, 6});
  CHECK(part(8, 3) == Frames{8});
  CHECK(part(0, 0) == Frames{1});
  CHECK(part(15, {}) == Frames{15});
  // In single precision these are whole numbers.
  CHECK(part(0.29, 0.29, animation(1, 100)) == Frames{29});
  CHECK(part(0.58, 0.58, animation(1, 100)) == Frames{58});
  CHECK_THROWS_AS(part(1e300, {}), InputError);
  CHECK_THROWS_AS(part({}, 1e300), InputError);
}

TEST_CASE("clocks are POV-Ray's to the bit") {
  // What POV-Ray 3.7.0.10 prints by str(clock, 0, 17).
  const Animation ten = animation(1, 10);
  CHECK(clock_of(ten, 1) == 0);
  CHECK(clock_of(ten, 3) == 0.22222222387790680);
  CHECK(clock_of(ten, 6) == 0.55555558204650879);
  CHECK(clock_of(ten, 8) == 0.77777779102325439);
  CHECK(clock_of(ten, 10) == 1);
  CHECK(clock_of(animation(1, 3, true), 3) == 0.66666668653488159);
  Animation other = animation(1, 3);
  other.initial_clock = 0.1;
  other.final_clock = 0.7;
  CHECK(clock_of(other, 2) == 0.39999997615814209);
  other.initial_clock = 5;
  other.final_clock = 1;
  CHECK(clock_of(other, 2) == 3);
  CHECK(clock_of(animation(4, 4), 4) == 0);
}

TEST_CASE("a scene knows its place in the animation as POV-Ray says it") {
  const AnimationFrame frame = frame_of(animation(2, 11), 5);
  CHECK(frame.clock_on);
  CHECK(frame.number == 5);
  CHECK(frame.initial_number == 2);
  CHECK(frame.final_number == 11);
  CHECK(frame.initial_clock == 0);
  CHECK(frame.final_clock == 1);
  CHECK(frame.clock_delta == 0.111111);
  const AnimationFrame cyclic = frame_of(animation(1, 3, true), 1);
  CHECK(cyclic.final_number == 4);
  CHECK(cyclic.clock_delta == 0.333333);
}

TEST_CASE("pictures have as many digits as the last number") {
  CHECK(picture_of("a.png", animation(1, 10), 3) == "a03.png");
  CHECK(picture_of("out/a.b.ppm", animation(1, 9), 3) == "out/a.b3.ppm");
  CHECK(picture_of("/x/a.png", animation(1, 1000), 1000) == "/x/a1000.png");
  CHECK(picture_of("a.png", animation(1, 9, true), 8) == "a08.png"); // as in POV-Ray
  CHECK(picture_of("a.png", Animation(), 0) == "a.png");
  CHECK(picture_of("a.png", animation(1, 9), 12) == "a12.png");
  Animation one;
  one.has_one_frame = true;
  CHECK(picture_of("a.png", one, 1) == "a1.png");
}
