// POSIX, main memory and Linux, as far as the SPU's C library asks for them.
#include "simulator/elf_image.hpp"
#include "simulator/fake_spe.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <thread>

using namespace celltrace::test;
using celltrace::cell_emu::PpeCallsConfig;

namespace {

enum Operation : unsigned {
  kClose = 2,
  kCreat = 3,
  kFstat = 4,
  kGetpagesize = 6,
  kGettimeofday = 7,
  kLseek = 9,
  kLstat = 10,
  kMmap = 11,
  kMremap = 12,
  kMsync = 13,
  kMunmap = 14,
  kOpen = 15,
  kRead = 16,
  kStat = 23,
  kUnlink = 24,
  kWrite = 27,
  kFtruncate = 28,
  kAccess = 29,
  kDup = 30,
  kTime = 31,
  kNanosleep = 32,
  kChdir = 33,
  kFchdir = 34,
  kMkdir = 35,
  kRmdir = 37,
  kChmod = 38,
  kFchmod = 39,
  kChown = 40,
  kGetcwd = 43,
  kSymlink = 45,
  kReadlink = 46,
  kFsync = 48,
  kDup2 = 50,
  kLockf = 51,
  kTruncate = 52,
  kMkstemp = 53,
  kMktemp = 54,
  kOpendir = 55,
  kClosedir = 56,
  kReaddir = 57,
  kRewinddir = 58,
  kSeekdir = 59,
  kTelldir = 60,
  kUmask = 62,
  kUtime = 63,
  kUtimes = 64,
  kPread = 65,
  kPwrite = 66,
  kReadv = 67,
  kWritev = 68
};
constexpr unsigned kCalloc = 1, kFree = 2, kMalloc = 3, kRealloc = 4, kPosixMemalign = 5;
constexpr std::uint32_t kBuffer = 0x3000;
constexpr int kRdonly = 0, kWronly = 1, kRdwr = 2, kCreatFlag = 0x40, kExcl = 0x80, kTrunc = 0x200,
              kAppend = 0x400;
constexpr std::uint32_t kEperm = 1, kEnoent = 2, kEbadf = 9, kEnomem = 12, kEacces = 13, kEfault = 14,
                        kEexist = 17, kEnodev = 19, kEinval = 22, kEspipe = 29, kErange = 34, kEnosys = 38;

PpeCallsConfig with_folder(const TemporaryFolder& folder) {
  PpeCallsConfig config;
  config.folders = {folder.path()};
  return config;
}

std::string contents(const std::string& path) {
  const Bytes bytes = read_file(path);
  return {bytes.begin(), bytes.end()};
}

} // namespace

TEST_CASE("descriptors are opened, read, written and closed") {
  TemporaryFolder folder;
  FakeSpe spe(with_folder(folder));
  const std::uint32_t name = spe.text("file");
  CHECK(spe.posix(kOpen, {name, kRdonly, 0}).spu_errno == kEnoent);
  REQUIRE(spe.posix(kOpen, {name, kRdwr | kCreatFlag, 0644}).value == 3);
  CHECK(spe.posix(kOpen, {name, kRdwr | kCreatFlag | kExcl, 0644}).spu_errno == kEexist);
  CHECK(spe.posix(kOpen, {name, 3, 0}).spu_errno == kEinval);
  CHECK(spe.posix(kWrite, {3, spe.text("0123456789"), 10}).value == 10);
  CHECK(spe.posix(kLseek, {3, 2, 0}).value == 2);
  CHECK(spe.posix(kRead, {3, kBuffer, 3}).value == 3);
  spe.store<std::uint8_t>(kBuffer + 3, 0);
  CHECK(spe.text_at(kBuffer) == "234");
  CHECK(spe.posix(kLseek, {3, -1, 2}).value == 9);
  CHECK(spe.posix(kRead, {3, kBuffer, 100}).value == 1);
  CHECK(spe.posix(kRead, {3, kBuffer, 100}).value == 0);
  CHECK(spe.posix(kLseek, {3, 0, 5}).spu_errno == kEinval);
  CHECK(spe.posix(kPread, {3, kBuffer, 2, 8}).value == 2);
  CHECK(spe.posix(kPwrite, {3, spe.text("AB"), 2, 4}).value == 2);
  CHECK(spe.posix(kPread, {3, kBuffer, 2, -1}).spu_errno == kEinval);
  CHECK(spe.posix(kPread, {0, kBuffer, 2, 0}).spu_errno == kEspipe);
  CHECK(spe.posix(kFtruncate, {3, 8}).value == 0);
  CHECK(contents(folder / "file") == "0123AB67");
  CHECK(spe.posix(kTruncate, {name, 4}).value == 0);
  CHECK(contents(folder / "file") == "0123");
  CHECK(spe.posix(kFsync, {3}).value == 0);
  CHECK(spe.posix(kLockf, {3, 1, 0}).value == 0);
  CHECK(spe.posix(kClose, {3}).value == 0);
  CHECK(spe.posix(kClose, {3}).spu_errno == kEbadf);
  CHECK(spe.posix(kRead, {3, kBuffer, 1}).spu_errno == kEbadf);
  CHECK(spe.posix(kRead, {-1, kBuffer, 1}).spu_errno == kEbadf);
  CHECK(spe.posix(kRead, {1000000, kBuffer, 1}).spu_errno == kEbadf);

  CHECK(spe.posix(kOpen, {name, kWronly | kAppend, 0}).value == 3);
  CHECK(spe.posix(kWrite, {3, spe.text("+"), 1}).value == 1);
  CHECK(spe.posix(kRead, {3, kBuffer, 1}).spu_errno == kEbadf);
  CHECK(contents(folder / "file") == "0123+");
  CHECK(spe.posix(kOpen, {name, kWronly | kTrunc, 0}).value == 4);
  CHECK(contents(folder / "file").empty());
  CHECK(spe.posix(kCreat, {spe.text("other"), 0600}).value == 5);
}

TEST_CASE("standard descriptors are there") {
  PpeCallsConfig config;
  config.standard_input = "input";
  FakeSpe spe(std::move(config));
  CHECK(spe.posix(kRead, {0, kBuffer, 3}).value == 3);
  CHECK(spe.posix(kWrite, {1, spe.text("out"), 3}).value == 3);
  CHECK(spe.posix(kWrite, {2, spe.text("err"), 3}).value == 3);
  CHECK(spe.posix(kWrite, {0, spe.text("err"), 3}).spu_errno == kEbadf);
  CHECK(spe.posix(kLseek, {1, 0, 0}).spu_errno == kEspipe);
  CHECK(spe.posix(kFstat, {1, kBuffer}).value == 0);
  CHECK((spe.load<std::uint32_t>(kBuffer + 8) & 0170000) == 0020000); // a terminal
  CHECK(spe.posix(kFtruncate, {1, 0}).spu_errno == kEinval);
  CHECK(spe.out() == "out");
  CHECK(spe.err() == "err");
}

TEST_CASE("descriptors are duplicated") {
  TemporaryFolder folder;
  FakeSpe spe(with_folder(folder));
  CHECK(spe.posix(kOpen, {spe.text("file"), kWronly | kCreatFlag, 0644}).value == 3);
  CHECK(spe.posix(kDup, {1}).value == 4);
  CHECK(spe.posix(kDup2, {3, 1}).value == 1);
  CHECK(spe.posix(kWrite, {1, spe.text("file"), 4}).value == 4);
  spe.c99(25, {spe.text("stream")}); // puts
  CHECK(spe.posix(kDup2, {4, 1}).value == 1);
  CHECK(spe.posix(kWrite, {1, spe.text("out"), 3}).value == 3);
  CHECK(spe.out() == "out");
  CHECK(contents(folder / "file") == "filestream\n");
  CHECK(spe.posix(kDup2, {9, 1}).spu_errno == kEbadf);
  CHECK(spe.posix(kDup2, {1, 100000}).spu_errno == kEbadf);
}

TEST_CASE("lists of parts are read and written") {
  FakeSpe spe;
  const std::uint32_t first = spe.text("one "), second = spe.text("two");
  spe.store<std::uint32_t>(kBuffer, first);
  spe.store<std::uint32_t>(kBuffer + 4, 4);
  spe.store<std::uint32_t>(kBuffer + 8, second);
  spe.store<std::uint32_t>(kBuffer + 12, 3);
  CHECK(spe.posix(kWritev, {1, kBuffer, 2}).value == 7);
  CHECK(spe.out() == "one two");
  CHECK(spe.posix(kWritev, {1, kBuffer, -1}).spu_errno == kEinval);
  spe.store<std::uint32_t>(kBuffer + 12, 0x40000);
  CHECK(spe.posix(kWritev, {1, kBuffer, 2}).spu_errno == kEfault);
  CHECK(spe.posix(kReadv, {0, kBuffer, 1}).value == 0);
}

TEST_CASE("the status of files is told") {
  TemporaryFolder folder;
  std::ofstream(folder / "file") << "12345";
  std::filesystem::create_symlink("file", folder / "link");
  FakeSpe spe(with_folder(folder));
  CHECK(spe.posix(kStat, {spe.text("link"), kBuffer}).value == 0);
  CHECK((spe.load<std::uint32_t>(kBuffer + 8) & 0170000) == 0100000);
  CHECK(spe.load<std::uint32_t>(kBuffer + 28) == 5);
  CHECK(spe.load<std::uint32_t>(kBuffer + 44) > 1000000000);
  CHECK(spe.load<std::uint32_t>(kBuffer + 52) == 0xEEEEEEEE);
  CHECK(spe.posix(kLstat, {spe.text("link"), kBuffer}).value == 0);
  CHECK((spe.load<std::uint32_t>(kBuffer + 8) & 0170000) == 0120000);
  CHECK(spe.posix(kReadlink, {spe.text("link"), kBuffer, 100}).value == 4);
  CHECK(spe.posix(kStat, {spe.text("none"), kBuffer}).spu_errno == kEnoent);
  CHECK(spe.posix(kStat, {spe.text("file"), FakeSpe::kBytes - 48}).spu_errno == kEfault);
  CHECK(spe.posix(kAccess, {spe.text("file"), 4}).value == 0);
  CHECK(spe.posix(kAccess, {spe.text("none"), 0}).spu_errno == kEnoent);
  CHECK(spe.posix(kAccess, {spe.text("/etc/passwd"), 4}).spu_errno == kEacces);
  CHECK(spe.posix(kAccess, {spe.text("file"), 8}).spu_errno == kEinval);

  CHECK(spe.posix(kChmod, {spe.text("file"), 0640}).value == 0);
  CHECK(spe.posix(kStat, {spe.text("file"), kBuffer}).value == 0);
  CHECK((spe.load<std::uint32_t>(kBuffer + 8) & 0777) == 0640);
  spe.store<std::uint64_t>(kBuffer, 1000);
  spe.store<std::uint64_t>(kBuffer + 8, 2000);
  CHECK(spe.posix(kUtime, {spe.text("file"), kBuffer}).value == 0);
  CHECK(spe.posix(kStat, {spe.text("file"), kBuffer}).value == 0);
  CHECK(spe.load<std::uint32_t>(kBuffer + 40) == 1000);
  CHECK(spe.load<std::uint32_t>(kBuffer + 44) == 2000);
  spe.store<std::uint64_t>(kBuffer, 3000);
  spe.store<std::uint32_t>(kBuffer + 8, 0);
  spe.store<std::uint64_t>(kBuffer + 16, 4000);
  spe.store<std::uint32_t>(kBuffer + 24, 0);
  CHECK(spe.posix(kUtimes, {spe.text("file"), kBuffer}).value == 0);
  CHECK(spe.posix(kStat, {spe.text("file"), kBuffer}).value == 0);
  CHECK(spe.load<std::uint32_t>(kBuffer + 44) == 4000);
}

TEST_CASE("folders are made, entered, listed and removed") {
  TemporaryFolder folder;
  FakeSpe spe(with_folder(folder));
  CHECK(spe.posix(kUmask, {077}).value == 022);
  CHECK(spe.posix(kMkdir, {spe.text("sub"), 0777}).value == 0);
  CHECK(spe.posix(kMkdir, {spe.text("sub"), 0777}).spu_errno == kEexist);
  CHECK((std::filesystem::status(folder / "sub").permissions() & std::filesystem::perms::all) ==
        std::filesystem::perms::owner_all);
  CHECK(spe.posix(kChdir, {spe.text("sub")}).value == 0);
  CHECK(spe.posix(kGetcwd, {kBuffer, 1000}).value == kBuffer);
  CHECK(spe.text_at(kBuffer) == folder / "sub");
  CHECK(spe.posix(kGetcwd, {kBuffer, 5}).spu_errno == kErange);
  CHECK(spe.posix(kGetcwd, {kBuffer, 0}).spu_errno == kEinval);
  for (const char* name : {"b", "a", "c"})
    CHECK(spe.posix(kClose, {spe.posix(kCreat, {spe.text(name), 0600}).value}).value == 0);
  CHECK(std::filesystem::exists(folder / "sub/b"));
  CHECK(spe.posix(kChdir, {spe.text("../..")}).spu_errno == kEacces);
  CHECK(spe.posix(kChdir, {spe.text("..")}).value == 0);

  const Slot listing = Slot::wide(spe.posix(kOpendir, {spe.text("sub")}).wide);
  REQUIRE(listing.doubleword != 0);
  std::string names;
  while (spe.posix(kReaddir, {listing, kBuffer}).value == kBuffer) {
    names += spe.text_at(kBuffer + 4);
    names += ' ';
  }
  CHECK(names == ". .. a b c ");
  CHECK(spe.posix(kTelldir, {listing}).value == 5);
  spe.posix(kSeekdir, {listing, 3});
  CHECK(spe.posix(kReaddir, {listing, kBuffer}).value == kBuffer);
  CHECK(spe.text_at(kBuffer + 4) == "b");
  spe.posix(kRewinddir, {listing});
  CHECK(spe.posix(kTelldir, {listing}).value == 0);
  CHECK(spe.posix(kReaddir, {listing, FakeSpe::kBytes - 100}).spu_errno == kEfault);
  CHECK(spe.posix(kClosedir, {listing}).value == 0);
  CHECK(spe.posix(kClosedir, {listing}).spu_errno == kEbadf);
  CHECK(spe.posix(kOpendir, {spe.text("/")}).spu_errno == kEacces);

  CHECK(spe.posix(kOpen, {spe.text("sub"), kRdonly, 0}).value == 3);
  CHECK(spe.posix(kFchdir, {3}).value == 0);
  CHECK(spe.posix(kUnlink, {spe.text("a")}).value == 0);
  CHECK(spe.posix(kUnlink, {spe.text("b")}).value == 0);
  CHECK(spe.posix(kRmdir, {spe.text("../sub")}).spu_errno == 39);
  CHECK(spe.posix(kUnlink, {spe.text("c")}).value == 0);
  CHECK(spe.posix(kRmdir, {spe.text("../sub")}).value == 0);
  CHECK(spe.posix(kFchdir, {1}).value == -1);
}

TEST_CASE("temporary names are numbered") {
  TemporaryFolder folder;
  FakeSpe spe(with_folder(folder));
  const std::uint32_t name = spe.text("run-XXXXXX");
  CHECK(spe.posix(kMkstemp, {name}).value == 3);
  CHECK(std::filesystem::exists(folder / spe.text_at(name)));
  CHECK(spe.posix(kMkstemp, {name}).spu_errno == kEinval);
  const std::uint32_t second = spe.text("run-XXXXXX");
  CHECK(spe.posix(kMktemp, {second}).value == static_cast<int>(second));
  CHECK(spe.text_at(second) != spe.text_at(name));
}

TEST_CASE("what a guest may not do is refused") {
  TemporaryFolder folder;
  FakeSpe spe(with_folder(folder));
  CHECK(spe.posix(kSymlink, {spe.text("/etc"), spe.text("etc")}).spu_errno == kEperm);
  CHECK(spe.posix(kChown, {spe.text("."), 0, 0}).spu_errno == kEperm);
  for (const unsigned operation : {1u, 5u, 8u, 17u, 20u, 21u, 25u, 26u}) {
    CHECK(spe.posix(operation, {0, 0, 0}).spu_errno == kEnosys);
    CHECK(spe.known());
  }
}

TEST_CASE("time comes from the clock that is given") {
  PpeCallsConfig config;
  config.clock = [] { return std::chrono::microseconds(1234567890'250000); };
  FakeSpe spe(config);
  CHECK(spe.posix(kGettimeofday, {kBuffer, kBuffer + 32}).value == 0);
  CHECK(spe.load<std::uint64_t>(kBuffer) == 1234567890);
  CHECK(spe.load<std::uint32_t>(kBuffer + 8) == 250000);
  CHECK(spe.load<std::uint32_t>(kBuffer + 16) == 0xEEEEEEEE);
  CHECK(spe.load<std::uint64_t>(kBuffer + 32) == 0);
  CHECK(spe.posix(kTime, {0}).value == 1234567890);
  CHECK(spe.posix(kTime, {kBuffer + 64}).value == 1234567890);
  CHECK(spe.load<std::uint64_t>(kBuffer + 64) == 1234567890);
  spe.store<std::uint64_t>(kBuffer, 3);
  spe.store<std::uint32_t>(kBuffer + 8, 0);
  CHECK(spe.posix(kNanosleep, {kBuffer, 0}).value == 0);
  spe.store<std::uint32_t>(kBuffer + 8, 1000000000);
  CHECK(spe.posix(kNanosleep, {kBuffer, 0}).spu_errno == kEinval);

  config.time_has_32_bits = true;
  FakeSpe old(config);
  CHECK(old.posix(kGettimeofday, {kBuffer, 0}).value == 0);
  CHECK(old.load<std::uint32_t>(kBuffer) == 1234567890);
  CHECK(old.load<std::uint32_t>(kBuffer + 4) == 250000);
  CHECK(old.load<std::uint32_t>(kBuffer + 8) == 0xEEEEEEEE);

  FakeSpe without;
  CHECK(without.posix(kTime, {0}).value == 1167609600);
}

TEST_CASE("main memory is allocated, moved and freed") {
  PpeCallsConfig config;
  config.max_ea_bytes = 1 << 20;
  FakeSpe spe(std::move(config));
  const std::uint64_t first = spe.memory(kMalloc, {Slot::wide(1000)}).wide;
  REQUIRE(first != 0);
  CHECK(first % 128 == 0);
  CHECK(first >> 32 == 0); // where pointers of 32 bits reach
  auto* memory = reinterpret_cast<std::uint8_t*>(first);
  for (int i = 0; i < 1000; ++i)
    memory[i] = static_cast<std::uint8_t>(i);
  const std::uint64_t second = spe.memory(kCalloc, {Slot::wide(10), Slot::wide(100)}).wide;
  REQUIRE(second != 0);
  CHECK((second >= first + 1000 || second + 1000 <= first));
  CHECK(reinterpret_cast<std::uint8_t*>(second)[999] == 0);
  const std::uint64_t moved = spe.memory(kRealloc, {Slot::wide(first), Slot::wide(5000)}).wide;
  REQUIRE(moved != 0);
  CHECK(reinterpret_cast<std::uint8_t*>(moved)[999] == static_cast<std::uint8_t>(999));
  CHECK(spe.memory(kRealloc, {Slot::wide(first), Slot::wide(5000)}).spu_errno == kEinval);
  spe.memory(kFree, {Slot::wide(second)});
  spe.memory(kFree, {Slot::wide(second)});
  spe.memory(kFree, {Slot::wide(0x12345)});
  spe.memory(kFree, {Slot::wide(moved)});

  CHECK(spe.memory(kMalloc, {Slot::wide((1 << 20) + 1)}).spu_errno == kEnomem);
  CHECK(spe.memory(kMalloc, {Slot::wide(~0ull)}).spu_errno == kEnomem);
  CHECK(spe.memory(kCalloc, {Slot::wide(1ull << 32), Slot::wide(1ull << 32)}).spu_errno == kEnomem);
  CHECK(spe.memory(kMalloc, {Slot::wide(1 << 20)}).wide != 0); // all that was freed is one again
  CHECK(spe.memory(kMalloc, {Slot::wide(1)}).spu_errno == kEnomem);
}

TEST_CASE("runs find main memory at the same place") {
  std::uint64_t places[2];
  for (std::uint64_t& place : places)
    place = FakeSpe().memory(kMalloc, {Slot::wide(1000)}).wide;
  CHECK(places[0] == places[1]);
}

TEST_CASE("main memory is aligned") {
  FakeSpe spe;
  CHECK(spe.memory(kPosixMemalign, {kBuffer, Slot::wide(65536), Slot::wide(10)}).value == 0);
  CHECK(spe.load<std::uint32_t>(kBuffer) % 65536 == 0);
  CHECK(spe.load<std::uint32_t>(kBuffer) != 0);
  CHECK(spe.load<std::uint32_t>(kBuffer + 4) == 0xEEEEEEEE);
  CHECK(spe.memory(kPosixMemalign, {kBuffer, Slot::wide(48), Slot::wide(10)}).value == kEinval);
  CHECK(spe.memory(kPosixMemalign, {kBuffer, Slot::wide(128), Slot::wide(1ull << 40)}).value == kEnomem);
}

TEST_CASE("files and memory are mapped") {
  TemporaryFolder folder;
  std::ofstream(folder / "file") << std::string(5000, 'f');
  FakeSpe spe(with_folder(folder));
  CHECK(spe.posix(kOpen, {spe.text("file"), kRdwr, 0}).value == 3);
  const std::uint64_t ea = spe.posix(kMmap, {Slot::wide(0), 6000, 1, 2, 3, 0}).wide;
  REQUIRE(ea != ~0ull);
  CHECK(ea % 4096 == 0);
  CHECK(reinterpret_cast<std::uint8_t*>(ea)[4999] == 'f');
  CHECK(reinterpret_cast<std::uint8_t*>(ea)[5000] == 0);
  CHECK(spe.posix(kMsync, {Slot::wide(ea), 6000, 4}).value == 0);
  const std::uint64_t grown = spe.posix(kMremap, {Slot::wide(ea), 6000, 9000, 1}).wide;
  CHECK(reinterpret_cast<std::uint8_t*>(grown)[0] == 'f');
  CHECK(spe.posix(kMunmap, {Slot::wide(grown), 9000}).value == 0);
  CHECK(spe.posix(kMunmap, {Slot::wide(grown), 9000}).spu_errno == kEinval);

  const Answer shared = spe.posix(kMmap, {Slot::wide(0), 100, 3, 1, 3, 0});
  CHECK(shared.wide == ~0ull);
  CHECK(shared.spu_errno == kEnodev);
  CHECK(spe.posix(kMmap, {Slot::wide(0), 100, 3, 0x22, -1, 0}).wide != ~0ull);
  CHECK(spe.posix(kMmap, {Slot::wide(0), 0, 3, 0x22, -1, 0}).spu_errno == kEinval);
  CHECK(spe.posix(kMmap, {Slot::wide(0), 100, 1, 2, 77, 0}).spu_errno == kEbadf);
  CHECK(spe.posix(kMmap, {Slot::wide(0), 100, 1, 2, 0, 0}).spu_errno == kEnodev);
}

TEST_CASE("system calls move main memory") {
  TemporaryFolder folder;
  PpeCallsConfig config = with_folder(folder);
  Bytes memory(256);
  const auto ea = reinterpret_cast<std::uintptr_t>(memory.data());
  config.effective_memory = [&](std::uint64_t at, std::uint64_t bytes) {
    return at >= ea && at + bytes <= ea + memory.size() ? memory.data() + (at - ea) : nullptr;
  };
  FakeSpe spe(std::move(config));
  const auto linux_call = [&](std::initializer_list<std::uint64_t> block) {
    std::uint32_t at = kBuffer;
    for (const std::uint64_t value : block) {
      spe.store<std::uint64_t>(at, value);
      at += 8;
    }
    spe.store<std::uint32_t>(FakeSpe::kWord, kBuffer);
    return spe.handle(0x2104) ? static_cast<std::int64_t>(spe.load<std::uint64_t>(kBuffer)) : -999;
  };
  CHECK(spe.posix(kOpen, {spe.text("file"), kRdwr | kCreatFlag, 0644}).value == 3);
  std::copy_n("hello world!", 12, memory.begin());
  CHECK(linux_call({4, 3, ea, 12}) == 12);
  CHECK(contents(folder / "file") == "hello world!");
  CHECK(linux_call({179, 3, ea + 100, 5, 6}) == 5);
  CHECK(memory[100] == 'w');
  CHECK(linux_call({180, 3, ea, 1, 11}) == 1);
  CHECK(contents(folder / "file") == "hello worldh");
  CHECK(linux_call({4, 1, ea, 5}) == 5);
  CHECK(spe.out() == "hello");
  const std::uint64_t block = spe.memory(kMalloc, {Slot::wide(100)}).wide;
  CHECK(linux_call({179, 3, block, 100, 0}) == 12);
  CHECK(reinterpret_cast<std::uint8_t*>(block)[0] == 'h');

  put<std::uint64_t>(memory, 128, ea);
  put<std::uint64_t>(memory, 136, 5);
  put<std::uint64_t>(memory, 144, block);
  put<std::uint64_t>(memory, 152, 2);
  CHECK(linux_call({146, 1, ea + 128, 2}) == 7);
  CHECK(spe.out() == "hellohellohe");
  CHECK(linux_call({145, 3, ea + 128, 5000}) == -22);

  CHECK(linux_call({4, 1, ea + 250, 7}) == -14);
  CHECK(linux_call({3, 1, 0x1000, 1}) == -14);
  CHECK(linux_call({3, 77, ea, 1}) == -9);
  CHECK(linux_call({20}) == 1);
  CHECK(linux_call({9999}) == -38);
  spe.store<std::uint32_t>(FakeSpe::kWord, FakeSpe::kBytes - 8);
  CHECK(spe.handle(0x2104));
}

TEST_CASE("SPEs call at the same time") {
  PpeCallsConfig config;
  std::string out;
  config.standard_output = [&out](std::string_view text) { out += text; };
  celltrace::cell_emu::PpeCalls ppe(std::move(config));
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&ppe] {
      Bytes local_store(FakeSpe::kBytes);
      put<std::uint32_t>(local_store, 0x10, 24u << 24 | 0x200); // putchar
      for (int n = 0; n < 1000; ++n) {
        put<std::uint32_t>(local_store, 0x200, 'x');
        ppe.handle(0x2100, local_store.data(), 0x10);
      }
    });
  for (std::thread& thread : threads)
    thread.join();
  CHECK(out == std::string(4000, 'x'));
}
