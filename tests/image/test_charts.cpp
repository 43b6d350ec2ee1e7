// Charts as SVG, and parts of files that runs have left behind.
#include "image/file.hpp"
#include "image/seekable.hpp"
#include "image/svg.hpp"
#include "picture_files.hpp"

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("a chart, word by word") {
  image::Svg svg(320.25, 200, 12);
  svg.line(1, 2, 3.25, 4, "red", 1.5);
  svg.box(5, 6, 7, 8, "#abc");
  svg.dot(9, 10, 11.5, "blue");
  svg.text(12, 13, "end", "a < b & c > d");
  svg.title(14, 15, "Title");
  svg.rising_text(16, 17.5, "up");
  CHECK(svg.finish() ==
        "<svg xmlns='http://www.w3.org/2000/svg' width='320.2' height='200.0' viewBox='0 0 320.2 200.0' "
        "font-family='sans-serif' font-size='12'>\n"
        "<rect width='100%' height='100%' fill='white'/>\n"
        "<line x1='1.0' y1='2.0' x2='3.2' y2='4.0' stroke='red' stroke-width='1.5'/>\n"
        "<rect x='5.0' y='6.0' width='7.0' height='8.0' fill='#abc'/>\n"
        "<circle cx='9.0' cy='10.0' r='11.5' fill='blue'/>\n"
        "<text x='12.0' y='13.0' text-anchor='end'>a &lt; b &amp; c &gt; d</text>\n"
        "<text x='14.0' y='15.0' text-anchor='start' font-weight='bold'>Title</text>\n"
        "<text x='16.0' y='17.5' text-anchor='middle' transform='rotate(-90 16.000000 17.500000)'>up</text>\n"
        "</svg>\n");
}

TEST_CASE("parts that a process has left are removed, and nothing else") {
  const TemporaryFolder folder;
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0); // there is no such process from here on
  const std::string gone = std::to_string(child), alive = std::to_string(getpid());
  const std::vector<std::string> stay = {"a.png",
                                         "a.png." + alive + "-0.part",
                                         "b.png." + gone + "-0.part",
                                         "a.png." + gone + "-0.parts",
                                         "a.png." + gone + ".part",
                                         "a.png.x" + gone + "-0.part",
                                         "a.png.-" + gone + "-0.part",
                                         "a.png.0-0.part",
                                         "a.png." + gone + "+0.part",
                                         "a.png..part",
                                         "a.png.part"};
  for (const std::string& name : stay)
    write_bytes(folder / name, "x");
  write_bytes(folder / ("a.png." + gone + "-0.part"), "x");
  write_bytes(folder / ("a.png." + gone + "-17.part"), "x");
  fs::create_directory(folder / "other");
  write_bytes(folder / ("other/c.png." + gone + "-1.part"), "x");
  image::remove_abandoned_parts({folder / "a.png", folder / "other/c.png"});
  for (const std::string& name : stay) {
    CAPTURE(name);
    CHECK(fs::exists(folder / name));
  }
  CHECK(static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), {})) ==
        stay.size() + 1);
  CHECK(fs::is_empty(folder / "other"));
  CHECK_NOTHROW(image::remove_abandoned_parts({folder / "missing/a.png"}));
}

TEST_CASE("a file that is being written is beside its target, and closed to those whom that is closed to") {
  const TemporaryFolder folder;
  const mode_t before = umask(0);
  const auto part = [&] {
    for (const auto& entry : fs::directory_iterator(folder.path()))
      if (entry.path().extension() == ".part") return entry.path();
    return fs::path();
  };
  const auto mode = [](const fs::path& path) {
    struct stat status = {};
    stat(path.c_str(), &status);
    return status.st_mode & 07777;
  };
  {
    image::OutputFile file(folder / "a.png");
    const std::string name = part().filename().string(), start = "a.png." + std::to_string(getpid()) + "-";
    CHECK(name.substr(0, start.size()) == start);
    CHECK(mode(part()) == 0666);
    image::OutputFile second(folder / "a.png"); // has another name
  }
  CHECK(part().empty());
  write_bytes(folder / "a.png", "old");
  {
    image::OutputFile file(folder / "a.png");
    CHECK(mode(part()) == 0600);
  }
  umask(before);
}

TEST_CASE("links are followed as often as the system does") {
  const TemporaryFolder folder;
  write_bytes(folder / "0", "here");
  for (int i = 1; i <= 41; ++i)
    fs::create_symlink(std::to_string(i - 1), folder / std::to_string(i));
  CHECK(image::follow_links(folder / "1") == fs::canonical(folder / "0"));
  CHECK(image::follow_links(folder / "40") == fs::canonical(folder / "0"));
  fs::create_symlink("nowhere", folder / "dangling");
  CHECK(image::follow_links(folder / "dangling") == fs::canonical(folder.path()) / "nowhere");
  CHECK(image::descriptor_named(folder / "0") == -1);
  CHECK(image::descriptor_named("/dev/fd/x") == -1);
  CHECK(image::descriptor_named("/dev/fd/1x") == -1);
  CHECK(image::descriptor_named("/proc/self/fd/0") == 0);
  CHECK(image::is_stream("/dev/null"));
  CHECK(image::is_stream("/dev/fd/0"));
  CHECK_FALSE(image::is_stream(folder / "0"));
  CHECK_FALSE(image::is_stream(folder.path()));
  CHECK_FALSE(image::is_stream(folder / "missing"));
}

TEST_CASE("a descriptor that is read only, or closed, is not written") {
  const TemporaryFolder folder;
  write_bytes(folder / "a", "x");
  const int reading = open((folder / "a").c_str(), O_RDONLY);
  REQUIRE(reading >= 0);
  const std::string name = "/dev/fd/" + std::to_string(reading);
  CHECK_THROWS_WITH(image::check_output(name), Contains("it is not open for writing"));
  CHECK_THROWS_AS(image::OutputFile(name), InputError);
  close(reading);
  CHECK_THROWS_WITH(image::check_output(name), Contains("cannot be written"));
  CHECK_THROWS_AS(image::OutputFile(name), InputError);
  const int writing = open((folder / "a").c_str(), O_WRONLY);
  CHECK_NOTHROW(image::check_output("/dev/fd/" + std::to_string(writing)));
  close(writing);
}

TEST_CASE("bytes are written in any order, to files, memory and spools") {
  const TemporaryFolder folder;
  // Behind what is there; to the end of a file that is always appended to; the same by a file of its own.
  for (const auto& [mode, expected] : {std::pair("r+b", 10), {"ab", 10}, {"ab", 65 << 20}}) {
    CAPTURE(mode, expected);
    write_bytes(folder / "a", "front|");
    const image::File file(std::fopen((folder / "a").c_str(), mode));
    REQUIRE(file);
    std::fseek(file.get(), 0, SEEK_END);
    image::SeekableFile out(file.get(), static_cast<std::uint64_t>(expected));
    CHECK(out.position() == 0);
    out.write("0123456789", 10);
    CHECK(out.position() == 10);
    out.seek(2);
    out.write("ab", 2);
    CHECK(out.position() == 4);
    out.seek(9);
    out.write("XYZ", 3);
    out.seek(0);
    out.write("-", 1);
    out.finish();
    std::fputs("|back", file.get());
    std::fflush(file.get());
    CHECK(read_bytes(folder / "a") == "front|-1ab45678XYZ|back");
  }
  // More than is copied at a time.
  write_bytes(folder / "a", "");
  const image::File file(std::fopen((folder / "a").c_str(), "ab"));
  image::SeekableFile out(file.get(), 65u << 20);
  const std::string large((2u << 20) + 7, 'x');
  out.write(large.data(), large.size());
  out.seek(large.size() - 1);
  out.write("y", 1);
  out.finish();
  std::fflush(file.get());
  CHECK(read_bytes(folder / "a") == large.substr(1) + "y");
}
