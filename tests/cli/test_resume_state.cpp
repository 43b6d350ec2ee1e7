#include "cli/resume_state.hpp"

#include "celltrace/error.hpp"
#include "files.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::cli;
using namespace celltrace::test;
using Catch::Matchers::Contains;

namespace {

constexpr int kWidth = 5, kHeight = 70; // two blocks of rows and a rest
const Settings kSettings = {{"width", "5"}, {"height", "70"}}, kFiles = {{"a.pov", "1"}};

RenderOptions options(bool colours = false) {
  RenderOptions options;
  options.width = kWidth;
  options.height = kHeight;
  options.colours = colours;
  return options;
}

/// Rows whose pixels say where they are.
RenderResult rendered(bool colours = false) {
  RenderResult result;
  result.image = Image(kWidth, kHeight);
  if (colours) {
    result.colours = ColourImage(kWidth, kHeight);
    result.colours.gamma = 2.2;
  }
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      result.image.pixel(x, y)[0] = static_cast<std::uint8_t>(7 * x + y);
      if (colours) result.colours.pixel(x, y)[1] = static_cast<float>(x) / static_cast<float>(y + 1);
    }
  return result;
}

PartialPicture with_rows(int top, int bottom, bool colours = false) {
  PartialPicture picture(options(colours));
  picture.take(rendered(colours), {top, bottom}, true);
  return picture;
}

} // namespace

TEST_CASE("a partial picture knows which rows are missing") {
  PartialPicture picture(options());
  CHECK(picture.is_empty());
  CHECK(picture.missing_rows() == 70);
  CHECK(picture.next().top == 0);
  CHECK(picture.next().bottom == 70);
  picture.take(rendered(), {32, 64}, true);
  CHECK_FALSE(picture.is_empty());
  CHECK(picture.missing_rows() == 38);
  CHECK(picture.next().bottom == 32);
  picture.take(rendered(), {0, 32}, true);
  CHECK(picture.next().top == 64);
  CHECK(picture.next().bottom == 70);
  picture.take(rendered(), {64, 70}, true);
  CHECK(picture.is_complete());
  CHECK(picture.image() == rendered().image);
}

TEST_CASE("of rows that were broken off those stay that are final") {
  RenderResult cut = rendered();
  cut.complete = false;
  cut.image.pixel(4, 40)[3] = 0;
  PartialPicture picture(options());
  picture.take(cut, {0, 70}, true);
  CHECK(picture.missing_rows() == 32);
  CHECK(picture.next().top == 32);
  // With antialiasing a pixel that is there may be its first ray's only.
  PartialPicture sampled(options());
  sampled.take(cut, {0, 70}, false);
  CHECK(sampled.is_empty());
  CHECK(sampled.image().pixel(1, 0)[0] == 7); // to be looked at all the same
}

TEST_CASE("rows come back as they were") {
  const bool colours = GENERATE(false, true);
  const TemporaryFolder folder;
  const PartialPicture picture = with_rows(32, 70, colours);
  ResumeState(folder / "p.png", kSettings).save_rows(3, kFiles, picture);
  ResumeState state(folder / "p.png", kSettings);
  state.load();
  PartialPicture loaded(options(colours));
  CHECK_FALSE(state.load_rows(2, kFiles, loaded));
  REQUIRE(state.load_rows(3, kFiles, loaded));
  CHECK(loaded.missing_rows() == 32);
  CHECK(loaded.image() == picture.image());
  CHECK(loaded.colours() == picture.colours());
  PartialPicture other(options(!colours));
  CHECK_FALSE(state.load_rows(3, kFiles, other));
  state.remove();
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("rows of other settings and of files that changed are refused") {
  const TemporaryFolder folder;
  ResumeState(folder / "p.png", kSettings).save_rows(0, kFiles, with_rows(0, 32));
  PartialPicture picture(options());
  CHECK_THROWS_WITH(
      ResumeState(folder / "p.png", {{"width", "6"}, {"height", "70"}}).load_rows(0, kFiles, picture),
      Contains("p.png.rows: ") && Contains("width was 5 and is 6"));
  CHECK_THROWS_WITH(
      ResumeState(folder / "p.png", kSettings).load_rows(0, {{"a.pov", "1"}, {"b.inc", "2"}}, picture),
      Contains("b.inc was none and is 2"));
  CHECK_THROWS_WITH(ResumeState(folder / "p.png", kSettings).load_rows(0, {{"a.pov", "2"}}, picture),
                    Contains("a.pov was 1 and is 2"));
  CHECK(picture.is_empty());
}

TEST_CASE("rows that are damaged or cut off are none") {
  const TemporaryFolder folder;
  const ResumeState state(folder / "p.png", kSettings);
  ResumeState(folder / "p.png", kSettings).save_rows(0, kFiles, with_rows(0, 64));
  const std::string good = read_bytes(folder / "p.png.rows");
  PartialPicture picture(options());
  const auto loads = [&](const std::string& bytes) {
    write_bytes(folder / "p.png.rows", bytes);
    return state.load_rows(0, kFiles, picture);
  };
  for (std::size_t size = 0; size < good.size(); size += 13)
    CHECK_FALSE(loads(good.substr(0, size)));
  for (std::size_t at = 0; at < good.size(); at += 31) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 4);
    CHECK_FALSE(loads(bad));
  }
  CHECK(picture.is_empty());
  CHECK(loads(good));
}

TEST_CASE("finished frames are known as long as their files are what they were") {
  const TemporaryFolder folder;
  const auto picture = [&](int frame) { return folder / std::to_string(frame).append(".png"); };
  {
    ResumeState first(folder / "p.png", kSettings);
    for (int frame = 1; frame <= 3; ++frame) {
      write_bytes(picture(frame), std::string(static_cast<std::size_t>(frame), 'x'));
      first.finish_frame(frame, picture(frame));
    }
  }
  // A line that was being written counts for nothing.
  write_bytes(folder / "p.png.resume", read_bytes(folder / "p.png.resume") + "frame 4 1");
  write_bytes(picture(4), "x");
  write_bytes(picture(2), "other");
  std::filesystem::remove(picture(3));
  ResumeState state(folder / "p.png", kSettings);
  state.load();
  CHECK(state.has_frame(1, picture(1)));
  CHECK_FALSE(state.has_frame(2, picture(2)));
  CHECK_FALSE(state.has_frame(3, picture(3)));
  CHECK_FALSE(state.has_frame(4, picture(4)));
  state.finish_frame(4, picture(4));
  ResumeState again(folder / "p.png", kSettings);
  again.load();
  CHECK(again.has_frame(1, picture(1)));
  CHECK(again.has_frame(4, picture(4)));
  CHECK_THROWS_WITH(ResumeState(folder / "p.png", {{"width", "6"}}).load(), Contains("width was 5 and is 6"));
  write_bytes(folder / "p.png.resume", "something else");
  CHECK_THROWS_WITH(again.load(), Contains("p.png.resume: is not what celltrace leaves there"));
}

TEST_CASE("nothing is kept beside what is no file") {
  const TemporaryFolder folder;
  for (const char* name : {"", "-", "/dev/null"}) {
    ResumeState state(name, kSettings);
    CHECK_FALSE(state.is_kept());
    state.load();
    state.finish_frame(0, name);
    state.save_rows(0, kFiles, with_rows(0, 32));
    state.remove();
  }
}
