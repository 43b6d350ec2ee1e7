// <stdio.h> besides its formats: streams, files, names.
#include "celltrace/error.hpp"
#include "simulator/elf_image.hpp"
#include "simulator/fake_spe.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <random>

#include <sys/stat.h>

using namespace celltrace::test;
using celltrace::cell_emu::PpeCallsConfig;

namespace {

enum Operation : unsigned {
  kClearerr = 1,
  kFclose,
  kFeof,
  kFerror,
  kFflush,
  kFgetc,
  kFgetpos,
  kFgets,
  kFileno,
  kFopen,
  kFputc,
  kFputs,
  kFread,
  kFreopen,
  kFseek,
  kFsetpos,
  kFtell,
  kFwrite,
  kGetc,
  kGetchar,
  kGets,
  kPerror,
  kPutc,
  kPutchar,
  kPuts,
  kRemove,
  kRename,
  kRewind,
  kSetbuf,
  kSetvbuf,
  kSystem,
  kTmpfile,
  kTmpnam,
  kUngetc,
  kVfprintf,
  kVfscanf
};
constexpr std::uint32_t kBuffer = 0x3000;
constexpr int kStdin = 1, kStdout = 2, kStderr = 3;
constexpr std::uint32_t kEnoent = 2, kEbadf = 9, kEacces = 13, kEfault = 14, kEinval = 22, kEmfile = 24,
                        kEspipe = 29;

PpeCallsConfig with_folder(const TemporaryFolder& folder) {
  PpeCallsConfig config;
  config.folders = {folder.path()};
  return config;
}

PpeCallsConfig with_input(std::string text) {
  PpeCallsConfig config;
  config.standard_input = std::move(text);
  return config;
}

std::string contents(const std::string& path) {
  const Bytes bytes = read_file(path);
  return {bytes.begin(), bytes.end()};
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path) << text;
}

} // namespace

TEST_CASE("text goes to standard output and error") {
  FakeSpe spe;
  CHECK(spe.c99(kPuts, {spe.text("line")}).value >= 0);
  CHECK(spe.c99(kPutchar, {'c'}).value == 'c');
  CHECK(spe.c99(kPutchar, {0x1FF}).value == 0xFF);
  CHECK(spe.c99(kFputs, {spe.text("text"), kStdout}).value >= 0);
  CHECK(spe.c99(kPutc, {'!', kStdout}).value == '!');
  CHECK(spe.c99(kFputc, {'\n', kStdout}).value == '\n');
  CHECK(spe.c99(kFwrite, {spe.text("abcdef"), 2, 3, kStdout}).value == 3);
  CHECK(spe.out() == "line\nc\xFFtext!\nabcdef");
  CHECK(spe.c99(kFputs, {spe.text("error"), kStderr}).spu_errno == 0);
  CHECK(spe.err() == "error");
  CHECK(spe.c99(kFflush, {0}).value == 0);
  CHECK(spe.c99(kFflush, {kStdout}).value == 0);
  CHECK(spe.c99(kFileno, {kStdin}).value == 0);
  CHECK(spe.c99(kFileno, {kStderr}).value == 2);
}

TEST_CASE("errors are described") {
  FakeSpe spe;
  spe.c99(kPerror, {spe.text("open"), 2});
  spe.c99(kPerror, {0, 13});
  spe.c99(kPerror, {spe.text(""), 9999});
  CHECK(spe.err() == "open: No such file or directory\nPermission denied\nUnknown error\n");
}

TEST_CASE("lines and characters come from standard input") {
  FakeSpe spe(with_input("first\nsecond line\nthird\nlast"));
  CHECK(spe.c99(kFgets, {kBuffer, 100, kStdin}).value == kBuffer);
  CHECK(spe.text_at(kBuffer) == "first\n");
  CHECK(spe.c99(kFgets, {kBuffer, 7, kStdin}).value == kBuffer);
  CHECK(spe.text_at(kBuffer) == "second");
  CHECK(spe.c99(kGets, {kBuffer}).value == kBuffer);
  CHECK(spe.text_at(kBuffer) == " line");
  CHECK(spe.c99(kGetchar, {}).value == 't');
  CHECK(spe.c99(kUngetc, {'T', kStdin}).value == 'T');
  CHECK(spe.c99(kUngetc, {'>', kStdin}).value == '>');
  CHECK(spe.c99(kUngetc, {-1, kStdin}).value == -1);
  CHECK(spe.c99(kFgetc, {kStdin}).value == '>');
  CHECK(spe.c99(kGetc, {kStdin}).value == 'T');
  CHECK(spe.c99(kFread, {kBuffer, 3, 2, kStdin}).value == 2);
  CHECK(spe.load<std::uint8_t>(kBuffer + 5) == 'l');
  CHECK(spe.c99(kFread, {kBuffer, 2, 100, kStdin}).value == 1);
  CHECK(spe.c99(kFeof, {kStdin}).value != 0);
  CHECK(spe.c99(kFgets, {kBuffer, 100, kStdin}).value == 0);
  CHECK(spe.c99(kGetchar, {}).value == -1);
  CHECK(spe.c99(kFerror, {kStdin}).value == 0);
  spe.c99(kClearerr, {kStdin});
  CHECK(spe.c99(kFeof, {kStdin}).value == 0);
  CHECK(spe.c99(kFseek, {kStdin, 0, 0}).spu_errno == kEspipe);
}

TEST_CASE("the wrong direction is an error of the stream") {
  FakeSpe spe;
  CHECK(spe.c99(kFputs, {spe.text("x"), kStdin}).spu_errno == kEbadf);
  CHECK(spe.c99(kFerror, {kStdin}).value != 0);
  CHECK(spe.c99(kFgetc, {kStdout}).spu_errno == kEbadf);
  CHECK(spe.c99(kFerror, {kStdout}).value != 0);
  CHECK(spe.c99(kUngetc, {'x', kStdout}).value == -1);
}

TEST_CASE("files are written, read and changed") {
  TemporaryFolder folder;
  FakeSpe spe(with_folder(folder));
  const std::uint32_t name = spe.text("data.txt");
  const Answer opened = spe.c99(kFopen, {name, spe.text("w")});
  REQUIRE(opened.value == 4);
  const int file = opened.value;
  CHECK(spe.c99(kFileno, {file}).value == 3);
  CHECK(spe.c99(kFputs, {spe.text("0123456789"), file}).value >= 0);
  CHECK(spe.c99(kFgetc, {file}).spu_errno == kEbadf);
  CHECK(spe.c99(kFclose, {file}).value == 0);
  CHECK(spe.c99(kFclose, {file}).spu_errno == kEbadf);
  CHECK(contents(folder / "data.txt") == "0123456789");

  REQUIRE(spe.c99(kFopen, {name, spe.text("r+b")}).value == file);
  CHECK(spe.c99(kFseek, {file, 4, 0}).value == 0);
  CHECK(spe.c99(kFgetc, {file}).value == '4');
  CHECK(spe.c99(kFtell, {file}).value == 5);
  CHECK(spe.c99(kUngetc, {'x', file}).value == 'x');
  CHECK(spe.c99(kFtell, {file}).value == 4);
  CHECK(spe.c99(kFseek, {file, 2, 1}).value == 0);
  CHECK(spe.c99(kFgetpos, {file, kBuffer}).value == 0);
  CHECK(spe.c99(kFputc, {'S', file}).value == 'S');
  CHECK(spe.c99(kFseek, {file, -1, 2}).value == 0);
  CHECK(spe.c99(kFgetc, {file}).value == '9');
  CHECK(spe.c99(kFgetc, {file}).value == -1);
  CHECK(spe.c99(kFsetpos, {file, kBuffer}).value == 0);
  CHECK(spe.c99(kFeof, {file}).value == 0);
  CHECK(spe.c99(kFgetc, {file}).value == 'S');
  spe.c99(kRewind, {file});
  CHECK(spe.c99(kFread, {kBuffer, 1, 100, file}).value == 10);
  CHECK(spe.c99(kFseek, {file, 0, 3}).spu_errno == kEinval);
  CHECK(spe.c99(kFseek, {file, -1, 0}).spu_errno == kEinval);
  CHECK(spe.c99(kSetvbuf, {file, 0, 2, 0}).value == 0);
  CHECK(spe.c99(kSetvbuf, {file, 0, 3, 0}).spu_errno == kEinval);
  spe.c99(kSetbuf, {file, 0});
  CHECK(spe.c99(kFclose, {file}).value == 0);
  CHECK(contents(folder / "data.txt") == "012345S789");

  REQUIRE(spe.c99(kFopen, {name, spe.text("a")}).value == file);
  spe.c99(kFputs, {spe.text("+"), file});
  CHECK(contents(folder / "data.txt") == "012345S789+");
  CHECK(spe.c99(kFopen, {spe.text("none"), spe.text("r")}).spu_errno == kEnoent);
  CHECK(spe.c99(kFopen, {name, spe.text("wx")}).value == 0);
  CHECK(spe.c99(kFopen, {name, spe.text("q")}).spu_errno == kEinval);
  CHECK(spe.c99(kFopen, {name, spe.text("")}).spu_errno == kEinval);
}

TEST_CASE("streams are opened anew, standard output among them") {
  TemporaryFolder folder;
  FakeSpe spe(with_folder(folder));
  CHECK(spe.c99(kFreopen, {spe.text("out"), spe.text("w"), kStdout}).value == kStdout);
  spe.c99(kPuts, {spe.text("into the file")});
  CHECK(spe.out().empty());
  CHECK(contents(folder / "out") == "into the file\n");
  CHECK(spe.c99(kFileno, {kStdout}).value == 1);
  CHECK(spe.c99(kFreopen, {0, spe.text("wb"), kStdout}).value == kStdout);
  CHECK(spe.c99(kFreopen, {spe.text("none"), spe.text("r"), kStdout}).spu_errno == kEnoent);
  CHECK(spe.c99(kPuts, {spe.text("nowhere")}).spu_errno == kEbadf);
  CHECK(spe.c99(kFreopen, {spe.text("x"), spe.text("w"), 17}).spu_errno == kEbadf);
}

TEST_CASE("temporary files, names, renaming and removing") {
  TemporaryFolder folder;
  FakeSpe spe(with_folder(folder));
  const int file = spe.c99(kTmpfile, {}).value;
  REQUIRE(file == 4);
  CHECK(std::filesystem::is_empty(folder.path()));
  spe.c99(kFputs, {spe.text("abc"), file});
  spe.c99(kRewind, {file});
  CHECK(spe.c99(kFgetc, {file}).value == 'a');

  CHECK(spe.c99(kTmpnam, {kBuffer}).value == kBuffer);
  const std::string name = spe.text_at(kBuffer);
  CHECK_FALSE(std::filesystem::exists(folder / name));
  CHECK(spe.c99(kTmpnam, {0}).value == 0);

  write_text(folder / "one", "1");
  CHECK(spe.c99(kRename, {spe.text("one"), spe.text("two")}).value == 0);
  CHECK(contents(folder / "two") == "1");
  CHECK(spe.c99(kRename, {spe.text("one"), spe.text("two")}).spu_errno == kEnoent);
  CHECK(spe.c99(kRename, {spe.text("two"), spe.text("/tmp/two")}).spu_errno == kEacces);
  CHECK(spe.c99(kRemove, {spe.text("two")}).value == 0);
  std::filesystem::create_directory(folder / "sub");
  CHECK(spe.c99(kRemove, {spe.text("sub")}).value == 0);
  CHECK(spe.c99(kRemove, {spe.text("sub")}).spu_errno == kEnoent);
}

TEST_CASE("commands are not run") {
  FakeSpe spe;
  CHECK(spe.c99(kSystem, {0}).value == 0);
  const Answer answer = spe.c99(kSystem, {spe.text("true")});
  CHECK(answer.value == -1);
  CHECK(answer.spu_errno == 38);
}

TEST_CASE("without folders there are no files") {
  FakeSpe spe;
  for (const char* name : {"file", "/etc/passwd", "/nowhere/at/all", "."})
    CHECK(spe.c99(kFopen, {spe.text(name), spe.text("r")}).spu_errno == kEacces);
  CHECK(spe.c99(kTmpfile, {}).spu_errno == kEacces);
  CHECK(spe.c99(kTmpnam, {kBuffer}).spu_errno == kEacces);
  CHECK(spe.c99(kRemove, {spe.text("file")}).spu_errno == kEacces);
}

TEST_CASE("no name leads out of the folders") {
  TemporaryFolder outside, folder;
  write_text(outside / "secret", "secret");
  write_text(folder / "inside", "inside");
  std::filesystem::create_directory(folder / "sub");
  std::filesystem::create_symlink(outside / "secret", folder / "link");
  std::filesystem::create_symlink(outside.path(), folder / "folder");
  std::filesystem::create_symlink(outside / "new", folder / "dangling");
  std::filesystem::create_symlink("inside", folder / "good");
  std::filesystem::create_symlink("loop", folder / "loop");
  FakeSpe spe(with_folder(folder));
  const auto error_of = [&](const std::string& name, const char* mode) {
    const Answer answer = spe.c99(kFopen, {spe.text(name), spe.text(mode)});
    if (answer.value != 0) spe.c99(kFclose, {answer.value});
    return answer.spu_errno;
  };
  CHECK(error_of("inside", "r") == 0);
  CHECK(error_of("./sub/../inside", "r") == 0);
  CHECK(error_of(folder / "inside", "r") == 0);
  CHECK(error_of("good", "r") == 0);
  CHECK(error_of("link", "r") == kEacces);
  CHECK(error_of("link", "w") == kEacces);
  CHECK(error_of("folder/secret", "r") == kEacces);
  CHECK(error_of("folder/none", "w") == kEacces);
  CHECK(error_of("dangling", "w") != 0);
  CHECK(error_of("loop", "r") == 40);
  CHECK(error_of(outside / "secret", "r") == kEacces);
  CHECK(error_of(outside / "none", "r") == kEacces);
  CHECK(error_of("../" + outside.path().filename().string() + "/secret", "r") == kEacces);
  CHECK(error_of("sub/../../x", "w") == kEacces);
  CHECK(error_of(folder.path().string() + "-other", "w") == kEacces);
  CHECK(error_of("/dev/null", "r") == kEacces);
  CHECK(error_of("", "r") == kEnoent);
  CHECK(error_of(std::string(5000, 'x'), "r") == 36);
  CHECK(error_of("inside/x", "r") == 20);
  CHECK(error_of(".", "w") == 21);
  CHECK(contents(outside / "secret") == "secret");
  CHECK_FALSE(std::filesystem::exists(outside / "new"));
  // A link itself may be removed, but not what it leads to.
  CHECK(spe.c99(kRemove, {spe.text("link")}).value == 0);
  CHECK(contents(outside / "secret") == "secret");
}

TEST_CASE("pipes are not opened") {
  TemporaryFolder folder;
  FakeSpe spe(with_folder(folder));
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(spe.c99(kFopen, {spe.text("pipe"), spe.text("r")}).spu_errno == kEacces);
}

TEST_CASE("a folder that is none is refused at once") {
  PpeCallsConfig config;
  config.folders = {"/nowhere/at/all"};
  CHECK_THROWS_AS(FakeSpe(std::move(config)), celltrace::InputError);
}

TEST_CASE("there is an end to open files") {
  TemporaryFolder folder;
  PpeCallsConfig config = with_folder(folder);
  config.max_open_files = 2;
  FakeSpe spe(std::move(config));
  const std::uint32_t name = spe.text("file"), mode = spe.text("w");
  CHECK(spe.c99(kFopen, {name, mode}).value == 4);
  CHECK(spe.c99(kFopen, {name, mode}).value == 5);
  CHECK(spe.c99(kFopen, {name, mode}).spu_errno == kEmfile);
  CHECK(spe.c99(kTmpfile, {}).spu_errno == kEmfile);
  CHECK(spe.c99(kFclose, {4}).value == 0);
  CHECK(spe.c99(kFopen, {name, mode}).value == 4);
}

TEST_CASE("what lies outside local store is an error") {
  TemporaryFolder folder;
  write_text(folder / "file", std::string(100, 'x'));
  FakeSpe spe(with_folder(folder));
  const int file = spe.c99(kFopen, {spe.text("file"), spe.text("r+")}).value;
  const std::uint32_t end = FakeSpe::kBytes - 8;
  CHECK(spe.c99(kFwrite, {end, 3, 3, file}).spu_errno == kEfault);
  CHECK(spe.c99(kFwrite, {0, -1, -1, file}).spu_errno == kEfault);
  CHECK(spe.c99(kFread, {end, 1, 100, file}).value == 8);
  CHECK(spe.c99(kFputs, {end, file}).spu_errno == kEfault);
  CHECK(spe.c99(kFgets, {end, 100, file}).value == static_cast<int>(end));
  CHECK(spe.text_at(end) == "xxxxxxx");
  CHECK(spe.c99(kFgets, {kBuffer, 0, file}).value == 0);
  CHECK(spe.c99(kFgetpos, {file, FakeSpe::kBytes - 4}).spu_errno == kEfault);
  // Bits above local store do not count, as on the hardware.
  CHECK(spe.c99(kFread, {0x80000000 + kBuffer, 1, 4, file}).value == 4);
  CHECK(spe.load<std::uint8_t>(kBuffer) == 'x');
}

TEST_CASE("calls that are none are left to others") {
  FakeSpe spe;
  for (const unsigned code : {0x2000u, 0x2100u, 0x2101u, 0x2102u, 0x2103u, 0x2105u, 0x2106u, 0x3FFFu}) {
    spe.call(code, 0, {});
    CHECK_FALSE(spe.known());
    CHECK(spe.load<std::uint32_t>(FakeSpe::kBlock) == 0xEEEEEEEE);
    spe.call(code, 200, {});
    CHECK_FALSE(spe.known());
  }
}

TEST_CASE("a block of arguments may lie at the end of local store") {
  FakeSpe spe;
  spe.call(0x2100, kPutchar, {'e'}, FakeSpe::kBytes - 16);
  CHECK(spe.out() == "e");
  // The second argument's place is 0 then.
  const std::uint32_t text = spe.text("wrapped");
  spe.store<std::uint32_t>(0, kStdout);
  CHECK(spe.call(0x2100, kFputs, {text}, FakeSpe::kBytes - 16).value == 1);
  CHECK(spe.out() == "ewrapped");
}

TEST_CASE("what the output does not take leaves the call") {
  PpeCallsConfig config;
  config.standard_output = [](std::string_view) { throw celltrace::Cancelled(); };
  FakeSpe spe(std::move(config));
  CHECK_THROWS_AS(spe.c99(kPutchar, {'x'}), celltrace::Cancelled);
  CHECK(spe.c99(kFputs, {spe.text("still there"), kStderr}).value >= 0);
}

TEST_CASE("no call whatsoever does harm") {
  TemporaryFolder folder;
  write_text(folder / "file", std::string(1000, '7'));
  std::mt19937 random(5);
  PpeCallsConfig config = with_folder(folder);
  config.standard_input = std::string(100, '3');
  config.max_ea_bytes = 1 << 20;
  config.max_open_files = 4;
  FakeSpe spe(std::move(config));
  const std::uint32_t texts[] = {spe.text("file"), spe.text("r+"),      spe.text("%s%d%n"),
                                 spe.text("new"),  spe.text("a%9$d[^"), spe.text("tmpXXXXXX")};
  for (int i = 0; i < 30000; ++i) {
    std::vector<Slot> arguments;
    for (int n = 0; n < 6; ++n) {
      const std::uint32_t value = random();
      switch (random() % 6) {
      case 0:
        arguments.push_back(value);
        break;
      case 1:
        arguments.push_back(value % 8);
        break;
      case 2:
        arguments.push_back(texts[value % std::size(texts)]);
        break;
      case 3:
        arguments.push_back(value % FakeSpe::kBytes);
        break;
      case 4:
        arguments.push_back(FakeSpe::kBytes - value % 64);
        break;
      default:
        arguments.push_back(0x20000000u + value % 256 * 128);
      }
      if (random() % 8 == 0) arguments.back() = Slot::wide(arguments.back().doubleword >> 32);
    }
    static constexpr unsigned kCodes[] = {0x2100, 0x2101, 0x2105, 0x2104};
    spe.call(kCodes[random() % 4], random() % 72, arguments,
             random() % 64 == 0 ? random() % FakeSpe::kBytes & ~3u : FakeSpe::kBlock);
    if (i % 100 == 0)
      for (std::size_t n = 0; n < std::size(texts); ++n)
        spe.set_bytes(texts[n],
                      std::vector<std::string>{"file", "r+", "%s%d%n", "new", "a%9$d[^", "tmpXXXXXX"}[n] +
                          '\0');
  }
  SUCCEED();
}
