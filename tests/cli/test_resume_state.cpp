#include "cli/resume_state.hpp"

#include "celltrace/error.hpp"
#include "cli/partial_picture.hpp"
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
  const ResumeState first(folder / "p.png", kSettings);
  RowsFile written = first.rows_of(3, kFiles);
  CHECK(written.is_kept());
  CHECK(written.count() == 0);
  picture.append_to(written);
  picture.append_to(written); // nothing is new
  CHECK(written.count() == 38);
  ResumeState state(folder / "p.png", kSettings);
  state.load();
  CHECK(state.rows_of(2, kFiles).count() == 0);
  RowsFile read = state.rows_of(3, kFiles);
  CHECK(read.count() == 38);
  PartialPicture loaded(options(colours));
  loaded.take(read);
  CHECK(loaded.missing_rows() == 32);
  CHECK(loaded.image() == picture.image());
  CHECK(loaded.colours() == picture.colours());
  PartialPicture other(options(!colours));
  other.take(read);
  CHECK(other.is_empty());
  state.remove();
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("a run that goes on appends to the rows of the one before") {
  const TemporaryFolder folder;
  const ResumeState state(folder / "p.png", kSettings);
  {
    RowsFile file = state.rows_of(0, kFiles);
    with_rows(0, 32).append_to(file);
  }
  const auto before = std::filesystem::file_size(folder / "p.png.rows");
  {
    RowsFile file = state.rows_of(0, kFiles);
    with_rows(0, 64).append_to(file);
  }
  const std::string both = read_bytes(folder / "p.png.rows");
  CHECK(both.size() < 2 * before);
  RowsFile file = state.rows_of(0, kFiles);
  CHECK(file.count() == 64);
  REQUIRE(file.next(1));
  CHECK(file.next(1)->top == 32);
  CHECK(file.next(1)->bottom == 64);
  CHECK_FALSE(file.next(33));
  // Those of another frame take its place.
  RowsFile other = state.rows_of(1, kFiles);
  CHECK(other.count() == 0);
  with_rows(0, 32).append_to(other);
  CHECK(state.rows_of(0, kFiles).count() == 0);
  CHECK(state.rows_of(1, kFiles).count() == 32);
}

TEST_CASE("rows of other settings and of files that changed are refused") {
  const TemporaryFolder folder;
  RowsFile file = ResumeState(folder / "p.png", kSettings).rows_of(0, kFiles);
  with_rows(0, 32).append_to(file);
  CHECK_THROWS_WITH(ResumeState(folder / "p.png", {{"width", "6"}, {"height", "70"}}).rows_of(0, kFiles),
                    Contains("p.png.rows: ") && Contains("width was 5, now 6"));
  CHECK_THROWS_WITH(ResumeState(folder / "p.png", kSettings).rows_of(0, {{"a.pov", "1"}, {"b.inc", "2"}}),
                    Contains("b.inc was none, now 2"));
  CHECK_THROWS_WITH(ResumeState(folder / "p.png", kSettings).rows_of(0, {{"a.pov", "2"}}),
                    Contains("a.pov was 1, now 2"));
}

TEST_CASE("of rows that are damaged or cut off the others count") {
  const TemporaryFolder folder;
  const ResumeState state(folder / "p.png", kSettings);
  {
    RowsFile file = state.rows_of(0, kFiles);
    with_rows(0, 64).append_to(file);
  }
  const std::string good = read_bytes(folder / "p.png.rows");
  const PartialPicture expected = with_rows(0, 64);
  const auto load = [&](const std::string& bytes) {
    write_bytes(folder / "p.png.rows", bytes);
    RowsFile file = state.rows_of(0, kFiles);
    PartialPicture picture(options());
    picture.take(file);
    return picture;
  };
  const auto is_right = [&](const PartialPicture& picture) {
    bool right = true;
    for (int y = 0; y < 64; ++y) // missing rows are clear, or whatever was there: they are rendered again
      right = right && (picture.missing_rows() > 6 ||
                        std::equal(picture.image().pixel(0, y), picture.image().pixel(0, y) + 4 * kWidth,
                                   expected.image().pixel(0, y)));
    return right;
  };
  for (std::size_t size = 0; size < good.size(); size += 13) {
    const PartialPicture picture = load(good.substr(0, size));
    CHECK((picture.missing_rows() == 70 || picture.missing_rows() == 38));
  }
  int damaged = 0;
  for (std::size_t at = 0; at < good.size(); at += 31) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 4);
    const PartialPicture picture = load(bad);
    CHECK(picture.missing_rows() >= 38);
    damaged += picture.missing_rows() == 38 ? 1 : 0;
  }
  CHECK(damaged > 0); // one of two parts is whole
  CHECK(is_right(load(good)));
  // What was cut off is rendered and appended again.
  write_bytes(folder / "p.png.rows", good.substr(0, good.size() - 7));
  RowsFile file = state.rows_of(0, kFiles);
  CHECK(file.count() == 32);
  expected.append_to(file);
  CHECK(read_bytes(folder / "p.png.rows") == good);
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
  CHECK_THROWS_WITH(ResumeState(folder / "p.png", {{"width", "6"}}).load(), Contains("width was 5, now 6"));
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
    RowsFile rows = state.rows_of(0, kFiles);
    with_rows(0, 32).append_to(rows);
    CHECK_FALSE(rows.is_kept());
    state.remove();
  }
}
