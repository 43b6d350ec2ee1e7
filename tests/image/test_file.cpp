// Files that take the place of others, and streams.
#include "image/file.hpp"
#include "picture_files.hpp"

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

void put(const fs::path& path, const std::string& text) {
  image::OutputFile file(path);
  std::fputs(text.c_str(), file.get());
  file.commit();
}

unsigned mode_of(const fs::path& path) {
  struct stat status = {};
  REQUIRE(stat(path.c_str(), &status) == 0);
  return status.st_mode & 07777;
}

ino_t node_of(const fs::path& path) {
  struct stat status = {};
  REQUIRE(stat(path.c_str(), &status) == 0);
  return status.st_ino;
}

auto files_in(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), {});
}

} // namespace

TEST_CASE("a file that is overwritten keeps its mode") {
  const TemporaryFolder folder;
  const mode_t before = umask(022);
  put(folder / "new", "new");
  CHECK(mode_of(folder / "new") == 0644);
  for (const mode_t mode : {0640, 0600, 0666, 0200, 0755}) {
    write_bytes(folder / "a", "old");
    chmod((folder / "a").c_str(), mode);
    put(folder / "a", "new");
    CHECK(mode_of(folder / "a") == mode);
    if ((mode & 0400) != 0 || geteuid() == 0) CHECK(read_bytes(folder / "a") == "new");
  }
  umask(before);
  CHECK(files_in(folder.path()) == 2);
}

TEST_CASE("a file that is overwritten keeps its owner") {
  if (geteuid() != 0) {
    WARN("skipped, as only root gives files away");
    return;
  }
  const TemporaryFolder folder;
  write_bytes(folder / "a", "old");
  REQUIRE(chown((folder / "a").c_str(), 1234, 2345) == 0);
  put(folder / "a", "new");
  struct stat status = {};
  stat((folder / "a").c_str(), &status);
  CHECK(status.st_uid == 1234);
  CHECK(status.st_gid == 2345);
}

TEST_CASE("the other names of a file that is overwritten stay names of it") {
  const TemporaryFolder folder;
  write_bytes(folder / "a", "something that is longer");
  fs::create_hard_link(folder / "a", folder / "b");
  fs::create_symlink("a", folder / "c");
  put(folder / "c", "new");
  CHECK(read_bytes(folder / "a") == "new");
  CHECK(read_bytes(folder / "b") == "new");
  CHECK(node_of(folder / "a") == node_of(folder / "b"));
  CHECK(fs::is_symlink(folder / "c"));
  CHECK(files_in(folder.path()) == 3);
}

TEST_CASE("a file that is overwritten keeps its extended attributes") {
  const TemporaryFolder folder;
  write_bytes(folder / "a", "something that is longer");
  if (setxattr((folder / "a").c_str(), "user.celltrace", "kept", 4, 0) != 0) {
    WARN("skipped, as the file system has no extended attributes");
    return;
  }
  put(folder / "a", "new");
  CHECK(read_bytes(folder / "a") == "new");
  char value[8] = {};
  CHECK(getxattr((folder / "a").c_str(), "user.celltrace", value, sizeof value) == 4);
  CHECK(std::string(value) == "kept");
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("a write-protected file is an error, for root too") {
  const TemporaryFolder folder;
  write_bytes(folder / "a.png", "old");
  chmod((folder / "a.png").c_str(), 0444);
  CHECK_THROWS_WITH(image::OutputFile(folder / "a.png"), Contains("write-protected"));
  CHECK_THROWS_WITH(image::check_output(folder / "a.png"), Contains("write-protected"));
  CHECK_THROWS_WITH(check_image_path(folder / "a.png"), Contains("a.png: is write-protected"));
  CHECK(read_bytes(folder / "a.png") == "old");
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("a file is written though its folder is not") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "closed");
  write_bytes(folder / "closed/a", "old and long");
  const bool is_root = geteuid() == 0;
  chmod((folder / "closed").c_str(), 0555);
  if (is_root) {
    // Root may write into any folder: as somebody else.
    REQUIRE(chmod(folder.path().c_str(), 0777) == 0);
    REQUIRE(chown((folder / "closed/a").c_str(), 65534, 65534) == 0);
    REQUIRE(seteuid(65534) == 0);
  }
  CHECK_NOTHROW(image::check_output(folder / "closed/a"));
  CHECK_NOTHROW(put(folder / "closed/a", "new"));
  CHECK_THROWS_WITH(image::check_output(folder / "closed/b"), Contains("cannot be written"));
  CHECK_THROWS_WITH(image::OutputFile(folder / "closed/b"), Contains("cannot be written"));
  if (is_root) REQUIRE(seteuid(0) == 0);
  CHECK(read_bytes(folder / "closed/a") == "new");
  CHECK(files_in(folder / "closed") == 1);
  chmod((folder / "closed").c_str(), 0755);
}

TEST_CASE("a file that is given up leaves the old one as it was") {
  const TemporaryFolder folder;
  write_bytes(folder / "a", "old");
  fs::create_hard_link(folder / "a", folder / "b");
  {
    image::OutputFile file(folder / "a");
    std::fputs("half", file.get());
  }
  CHECK(read_bytes(folder / "a") == "old");
  CHECK(files_in(folder.path()) == 2);
}

TEST_CASE("open descriptors have names") {
  const TemporaryFolder folder;
  const int descriptor = open((folder / "a").c_str(), O_RDWR | O_CREAT, 0666);
  REQUIRE(descriptor >= 0);
  REQUIRE(write(descriptor, "front ", 6) == 6);
  const std::string number = std::to_string(descriptor);
  for (const std::string& name : {"/dev/fd/" + number, "/proc/self/fd/" + number}) {
    CHECK(image::descriptor_named(name) == descriptor);
    CHECK(image::is_stream(name));
    put(name, "back "); // where the descriptor stands
  }
  CHECK(read_bytes(folder / "a") == "front back back ");
  fs::create_symlink("/dev/fd/" + number, folder / "link");
  CHECK(image::descriptor_named(folder / "link") == descriptor);
  close(descriptor);
  CHECK_THROWS_WITH(image::check_output("/dev/fd/" + number), Contains("not open for writing"));
  CHECK_THROWS_AS(image::OutputFile("/dev/fd/" + number), InputError);

  CHECK(image::descriptor_named("/dev/stdout") == 1);
  CHECK(image::descriptor_named(folder / "a") == -1);
  CHECK(image::descriptor_named("/dev/null") == -1);
  CHECK(image::is_stream("/dev/null"));
  CHECK_FALSE(image::is_stream(folder / "a"));
  CHECK_FALSE(image::is_stream(folder / "nothing"));
  CHECK_FALSE(image::is_stream(folder.path()));
}
