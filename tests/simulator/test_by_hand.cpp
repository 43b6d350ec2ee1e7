// Programs that are written word by word, so that no compiler is needed: what they find at their start, and
// profiles and counters of them to the last character.
#include "backends/cell_emu/simulator/code_places.hpp"
#include "backends/cell_emu/simulator/ppe/spu_errno.hpp"
#include "backends/cell_emu/simulator/program_arguments.hpp"
#include "celltrace/error.hpp"
#include "celltrace/simulator.hpp"
#include "simulator/machine_code.hpp"

#include <cerrno>
#include <cstring>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace celltrace;
using namespace celltrace::test;
using namespace celltrace::cell_emu;
using Catch::Matchers::Contains;

namespace {

alignas(128) std::uint8_t main_memory[1024];

template <class Integer> Integer loaded(ea_t ea) {
  return load_big_endian<Integer>(reinterpret_cast<const std::uint8_t*>(ea));
}
std::string text_at(ea_t ea) {
  return reinterpret_cast<const char*>(ea);
}

/// Stores registers 3 to 6 to 0x1000, puts them into main memory at register 4, and ends.
Code registers_to(ea_t ea) {
  Code code;
  for (std::uint32_t i = 0; i < 4; ++i)
    code.add("stqa", {.rt = 3 + i, .immediate = static_cast<std::int32_t>(0x1000 / 4 + 4 * i)});
  code.add("ilhu", {.rt = 4, .immediate = static_cast<std::int32_t>(ea >> 48 & 0xFFFF)});
  code.add("iohl", {.rt = 4, .immediate = static_cast<std::int32_t>(ea >> 32 & 0xFFFF)});
  code.add("ilhu", {.rt = 9, .immediate = static_cast<std::int32_t>(ea >> 16 & 0xFFFF)});
  code.add("iohl", {.rt = 9, .immediate = static_cast<std::int32_t>(ea & 0xFFFF)});
  code.write_channel(16, 0x1000);
  code.add("wrch", {.rt = 4, .ra = 17});
  code.add("wrch", {.rt = 9, .ra = 18});
  code.write_channel(19, 64);
  code.write_channel(20, 1);
  code.write_channel(21, 0x20);
  return code.wait_for_tags(2).exit(0);
}

/// A loop, an instruction of each unit, a wait for DMA, and a part that lies apart.
Code everything() {
  Code code;
  code.add("il", {.rt = 5, .immediate = 300});
  code.add("lqa", {.rt = 7, .immediate = 0x400 / 4});
  code.add("ai", {.rt = 5, .ra = 5, .immediate = -1});
  code.add("lnop");
  code.add("fm", {.rt = 7, .ra = 7, .rb = 7});
  code.add("brnz", {.rt = 5, .immediate = -3});
  code.add("br", {.immediate = 3});
  code.add("nop").add("nop");
  for (const char* const mnemonic : {"dfa", "dfa", "mpy", "shl", "cntb", "rotqby", "a"})
    code.add(mnemonic, {.rt = 8, .ra = 8, .rb = 7});
  code.dma(0x40, 0x2000, 128, 3);
  code.wait_for_tags(1 << 3);
  code.add("bra", {.immediate = 0x800 / 4});
  code.fill_to(0x800);
  code.add("ai", {.rt = 7, .ra = 8, .immediate = 1});
  return code.exit(5);
}

} // namespace

TEST_CASE("a main(speid, argp, envp) finds what it is given in registers 3 to 6") {
  std::memset(main_memory, 0, sizeof main_memory);
  const ea_t ea = to_ea(main_memory);
  {
    const SimulatedRun run = simulate(simulated(1), registers_to(ea).elf(), 0x123456789ABCDEF0);
    INFO(run.report());
    CHECK(run.ok());
    CHECK(loaded<std::uint64_t>(ea) == 0x10000000);
    CHECK(loaded<std::uint64_t>(ea + 8) == 0);
    CHECK(loaded<std::uint64_t>(ea + 16) == 0x123456789ABCDEF0);
    CHECK(loaded<std::uint64_t>(ea + 24) == 0);
    CHECK(loaded<std::uint64_t>(ea + 32) == 0);
    CHECK(loaded<std::uint64_t>(ea + 48) % kLocalStoreBytes == 0);
    CHECK(loaded<std::uint64_t>(ea + 48) != 0);
  }
  // argv[0] alone is none of its business; with more argp is an argv.
  MachineConfig config = simulated(1);
  config.simulation.arguments = {"program"};
  simulate(config, registers_to(ea).elf(), 77);
  CHECK(loaded<std::uint64_t>(ea + 16) == 77);
  config.simulation.arguments = {"program", "one"};
  simulate(config, registers_to(ea).elf(), 77);
  CHECK(loaded<std::uint64_t>(ea + 16) > 77);
}

TEST_CASE("an argv is laid out for a PPE and for an SPU") {
  const ProgramArguments arguments({"program", "exactly 15 long", "", "x"});
  CHECK(arguments.has_any());
  CHECK_FALSE(ProgramArguments({"program"}).has_any());
  CHECK_FALSE(ProgramArguments({}).has_any());
  // Pointers of 64 bits, the last one 0, and strings in quadwords of their own.
  const ea_t argv = arguments.ppe_argv();
  CHECK(argv % 128 == 0);
  const ea_t strings = argv + 48;
  for (const auto& [i, at] : {std::pair(0u, 0u), {1u, 16u}, {2u, 32u}, {3u, 48u}})
    CHECK(loaded<std::uint64_t>(argv + 8 * i) == strings + at);
  CHECK(loaded<std::uint64_t>(argv + 32) == 0);
  CHECK(text_at(strings) == "program");
  CHECK(text_at(strings + 16) == "exactly 15 long");
  CHECK(text_at(strings + 32).empty());
  CHECK(text_at(strings + 48) == "x");
  // For code that fetches it: pointers of 32 bits to where it will be, at the end of local store, and
  // strings.
  const StartRegisters registers = arguments.for_fetching(0x1122334455667788);
  CHECK(registers.spe_id.word(0) == 4);
  const std::uint32_t bytes = registers.argp.word(3), lsa = registers.argp.word(0);
  CHECK(bytes == 48); // 5 pointers of 4 bytes and 8 + 16 + 1 + 2 bytes: 47
  CHECK(lsa == kLocalStoreBytes - bytes);
  const ea_t fetched = static_cast<ea_t>(registers.argp.word(1)) << 32 | registers.argp.word(2);
  CHECK(registers.local_store.doubleword(0) == 0x1122334455667788);
  CHECK(registers.local_store.doubleword(1) == 0);
  for (const auto& [i, at] : {std::pair(0u, 0u), {1u, 8u}, {2u, 24u}, {3u, 25u}})
    CHECK(loaded<std::uint32_t>(fetched + 4 * i) == lsa + 20 + at);
  CHECK(loaded<std::uint32_t>(fetched + 16) == 0);
  CHECK(text_at(fetched + 20) == "program");
  CHECK(text_at(fetched + 28) == "exactly 15 long");
  CHECK(text_at(fetched + 45) == "x");
  // As many bytes as one command brings: 4 for the pointer and 4 for 0.
  CHECK(ProgramArguments({std::string(16375, 'y')}).for_fetching(0).argp.word(3) == 16384);
  CHECK_THROWS_WITH(ProgramArguments({std::string(16376, 'y')}),
                    Contains("take 16400 bytes, more than 16384"));
}

TEST_CASE("start-up code that fetches argv is known by one of its first eight instructions") {
  const auto fetches = [](unsigned at, std::uint32_t word) {
    Code code;
    for (unsigned i = 0; i < 12; ++i)
      code.word(i == at ? word : 0x40200000);
    return fetches_argv(SpuElf(code.elf()));
  };
  for (unsigned at = 0; at < 8; ++at)
    CHECK(fetches(at, 0x21A00804));
  CHECK_FALSE(fetches(8, 0x21A00804));
  CHECK_FALSE(fetches(3, 0x21A00805));
  Code last;
  last.add("nop");
  CHECK_FALSE(fetches_argv(SpuElf(last.elf())));
  // The words behind the entry are those that count, also in the last segment's last word.
  ElfImage image;
  image.entry = 0x100;
  Bytes words(8);
  put<std::uint32_t>(words, 0, 0x40200000);
  put<std::uint32_t>(words, 4, 0x21A00804);
  image.add_segment(0x100, words, 8, 5);
  CHECK(fetches_argv(SpuElf(image.build())));
  image.entry = 0x104;
  CHECK(fetches_argv(SpuElf(image.build())));
}

TEST_CASE("places in code that tells no names are unknown") {
  const CodePlaces places{SpuElf(everything().elf())};
  const CodePlace place = places.at(8);
  CHECK(place.function == nullptr);
  CHECK(place.offset == 0);
  CHECK(place.file == nullptr);
  CHECK(place.line == 0);
}

TEST_CASE("a profile of code by hand, to the last character") {
  SpuProfile profile;
  MachineConfig config = simulated(1);
  config.simulation.profile = &profile;
  const Bytes elf = everything().elf();
  const SimulatedRun run = simulate(config, elf, to_ea(main_memory));
  CHECK(run.ok());
  CHECK(run.exit_codes[0] == 5);
  CHECK(profile_text(profile, elf) ==
        "6899 cycles, 1229 instructions, 5.61 cycles an instruction, 49.3 % issued in pairs\n"
        "\n"
        "                                                     cycles lost, % of the function's\n"
        "       cycles      %  instructions    CPI paired     dep   miss  fetch   hint     dp   wait  "
        "function\n"
        "         6898  99.99          1227   5.62  49.2%     0.8   78.5    0.0    0.0    0.0    7.3  LS "
        "0x00000\n"
        "            1   0.01             2   0.50 100.0%     0.0    0.0    0.0    0.0    0.0    0.0  LS "
        "0x00800\n"
        "\n"
        "dep: results that were not there; miss: branches that were not foreseen; fetch: instructions that "
        "were not\n"
        "there; hint: late hints; dp: double precision; wait: channels (DMA, mailboxes, ..., calls of the "
        "PPE)\n"
        "\n"
        "LS 0x00000: 6898 cycles, 99.99 %\n"
        "     LS pipe        hits        cycles  instruction\n"
        "  00000 0D             1             1  il      $5,300\n"
        "  00004 1D             1             0  lqa     $7,0x400\n"
        "  00008 0D           300           301  ai      $5,$5,-1                dependency 1\n"
        "  0000c 1D           300             0  lnop\n"
        "  00010 0d           300           303  fm      $7,$7,$7                dependency 3\n"
        "  00014 1d           300          5681  brnz    $5,0x8                  branch miss 5382\n"
        "  00018 1              1            19  br      0x24                    branch miss 18\n"
        "  ... not executed: 2\n"
        "  00024 0              1             1  dfa     $8,$8,$7\n"
        "  00028 0              1            13  dfa     $8,$8,$7                dependency 12\n"
        "  0002c 0              1            13  mpy     $8,$8,$7                dependency 12\n"
        "  00030 0              1             7  shl     $8,$8,$7                dependency 6\n"
        "  00034 0              1             4  cntb    $8,$8                   dependency 3\n"
        "  00038 1              1             4  rotqby  $8,$8,$7                dependency 3\n"
        "  0003c 0              1             4  a       $8,$8,$7                dependency 3\n"
        "  00040 0              1             1  il      $99,8192\n"
        "  00044 1              1             2  wrch    $ch16,$99               dependency 1\n"
        "  00048 1              1             1  wrch    $ch17,$4\n"
        "  0004c 1              1             1  rotqbyi $98,$4,4\n"
        "  00050 1              1             4  wrch    $ch18,$98               dependency 3\n"
        "  00054 0              1             1  il      $99,128\n"
        "  00058 1              1             2  wrch    $ch19,$99               dependency 1\n"
        "  0005c 0              1             1  il      $99,3\n"
        "  00060 1              1             2  wrch    $ch20,$99               dependency 1\n"
        "  00064 0              1             1  il      $99,64\n"
        "  00068 1              1             2  wrch    $ch21,$99               dependency 1\n"
        "  0006c 0              1             1  il      $99,8\n"
        "  00070 1              1             2  wrch    $ch22,$99               dependency 1\n"
        "  00074 0              1             1  il      $99,2\n"
        "  00078 1              1             2  wrch    $ch23,$99               dependency 1\n"
        "  0007c 1              1           504  rdch    $97,$ch24               channel 503\n"
        "  00080 1              1            19  bra     0x800                   branch miss 18\n");
  const auto json = nlohmann::json::parse(profile_json(profile, elf));
  REQUIRE(json["functions"].size() == 2);
  const auto& first = json["functions"][0];
  CHECK(first["name"] == "LS 0x00000");
  CHECK(first["address"] == 0);
  CHECK(json["functions"][1]["name"] == "LS 0x00800");
  CHECK(json["functions"][1]["address"] == 2048);
  CHECK(first["instructions"][5] ==
        nlohmann::json::parse(R"({"address": 20, "text": "brnz\t$5,0x8", "file": "", "line": 0,
    "hits": 300, "cycles": 5681, "dual": 1, "dependency": 0, "branch_miss": 5382, "prefetch_miss": 0, "hint_target": 0,
    "fp_resource": 0, "channel": 0})"));
  for (const auto& [count, all, of_first] : {std::tuple("hits", 1229, 1227),
                                             {"cycles", 6899, 6898},
                                             {"dual", 303, 302},
                                             {"dependency", 52, 52},
                                             {"branch_miss", 5418, 5418},
                                             {"channel", 503, 503},
                                             {"prefetch_miss", 0, 0},
                                             {"hint_target", 0, 0},
                                             {"fp_resource", 0, 0}}) {
    CAPTURE(count);
    CHECK(json[count] == all);
    CHECK(first[count] == of_first);
  }
  // Of all that was executed half and more, and no function but the first.
  CHECK_THAT(profile_text(profile, elf, 0.5), !Contains("LS 0x00800:"));
  CHECK_THAT(profile_text(profile, elf, 1), Contains("\nLS 0x00800: 1 cycles, 0.01 %\n"));
  CHECK(counters_text(run, TimingParameters::cell()) ==
        "1 SPE, 2.2 us at 3.200 GHz\n"
        "total instructions                      929\n"
        "cycles an instruction                  7.43\n"
        "single cycle                            923   13.4 %\n"
        "dual cycle                                3    0.0 %\n"
        "nop cycle                                 0    0.0 %\n"
        "stall due to dependency                  52    0.8 %\n"
        "stall due to branch miss               5418   78.5 %\n"
        "stall due to prefetch miss                0    0.0 %\n"
        "stall due to hint target                  0    0.0 %\n"
        "stall due to fp resource                  0    0.0 %\n"
        "stall due to ls contention                0    0.0 %\n"
        "channel stall cycle                     503    7.3 %\n"
        "stall due to injection                    0    0.0 %\n"
        "total cycle                            6899  100.0 %\n"
        "by unit                        instructions     waited for\n"
        "  fx2                                   309              7\n"
        "  fx3                                     1              3\n"
        "  fxb                                     1              3\n"
        "  fp6                                   300              0\n"
        "  fp7                                     1              6\n"
        "  fpd                                     2             24\n"
        "  ls                                      1              3\n"
        "  shuf                                    2              6\n"
        "  br                                    303              0\n"
        "  hbr                                     0\n"
        "  spr                                     9              0\n"
        "  nop                                   300\n"
        "branches taken                          301\n"
        "branches not foreseen                   301\n"
        "hints that were right                     0\n"
        "DMA commands                              1 (128 bytes read, 0 written)\n");
  // Twice the profile of two SPEs.
  SpuProfile both;
  config.spes = 2;
  config.simulation.profile = &both;
  simulate(config, elf, to_ea(main_memory));
  for (std::size_t i = 0; i < 12; ++i) {
    CHECK(both.words()[i].hits == 2 * profile.words()[i].hits);
    CHECK(both.words()[i].dual == 2 * profile.words()[i].dual);
  }
}

TEST_CASE("every errno of the SPU, and what perror() says of it") {
  const std::vector<std::pair<int, int>> same_numbers = {
      {0, 0},          {EPERM, 1},    {ENOENT, 2},     {ESRCH, 3},   {EINTR, 4},      {EIO, 5},
      {ENXIO, 6},      {E2BIG, 7},    {ENOEXEC, 8},    {EBADF, 9},   {ECHILD, 10},    {EAGAIN, 11},
      {ENOMEM, 12},    {EACCES, 13},  {EFAULT, 14},    {EBUSY, 16},  {EEXIST, 17},    {EXDEV, 18},
      {ENODEV, 19},    {ENOTDIR, 20}, {EISDIR, 21},    {EINVAL, 22}, {ENFILE, 23},    {EMFILE, 24},
      {ENOTTY, 25},    {ETXTBSY, 26}, {EFBIG, 27},     {ENOSPC, 28}, {ESPIPE, 29},    {EROFS, 30},
      {EMLINK, 31},    {EPIPE, 32},   {EDOM, 33},      {ERANGE, 34}, {EDEADLK, 35},   {ENAMETOOLONG, 36},
      {ENOLCK, 37},    {ENOSYS, 38},  {ENOTEMPTY, 39}, {ELOOP, 40},  {EOVERFLOW, 75}, {EILSEQ, 84},
      {EOPNOTSUPP, 95}};
  for (const auto& [host, spu] : same_numbers) {
    CAPTURE(host);
    CHECK(static_cast<int>(spu_errno(host)) == spu);
    CHECK(std::string(error_text(static_cast<std::uint32_t>(spu))).size() > 6);
    CHECK(error_text(static_cast<std::uint32_t>(spu)) != "Unknown error");
  }
  CHECK(spu_errno(ENOTBLK) == SpuErrno::io);
  CHECK(error_text(15) == "Unknown error");
  CHECK(error_text(0) == "Success");
  CHECK(error_text(2) == "No such file or directory");
  CHECK(error_text(40) == "Too many levels of symbolic links");
  for (const auto& [named, number] : {std::pair(SpuErrno::not_permitted, EPERM),
                                      {SpuErrno::no_entry, ENOENT},
                                      {SpuErrno::bad_file, EBADF},
                                      {SpuErrno::no_memory, ENOMEM},
                                      {SpuErrno::access, EACCES},
                                      {SpuErrno::fault, EFAULT},
                                      {SpuErrno::exists, EEXIST},
                                      {SpuErrno::no_device, ENODEV},
                                      {SpuErrno::not_directory, ENOTDIR},
                                      {SpuErrno::is_directory, EISDIR},
                                      {SpuErrno::invalid, EINVAL},
                                      {SpuErrno::too_many_open_files, EMFILE},
                                      {SpuErrno::illegal_seek, ESPIPE},
                                      {SpuErrno::range, ERANGE},
                                      {SpuErrno::name_too_long, ENAMETOOLONG},
                                      {SpuErrno::not_implemented, ENOSYS},
                                      {SpuErrno::loop, ELOOP},
                                      {SpuErrno::overflow, EOVERFLOW},
                                      {SpuErrno::illegal_sequence, EILSEQ}})
    CHECK(spu_errno(number) == named);
}
