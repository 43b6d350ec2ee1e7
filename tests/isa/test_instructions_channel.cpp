// Channels, stops, special registers, and instructions that change nothing.
#include "isa/instruction_rows.hpp"

#include <catch2/catch.hpp>

namespace celltrace::test {

namespace {

const Row kRows[] = {
    {.op = "rdch",
     .channel = 29,
     .answers = {.channel_value = 0x12345678},
     .gives = "12345678 00000000 00000000 00000000",
     .effects = {{Effect::read_channel, 29}}},
    {.op = "rdch",
     .channel = 127,
     .answers = {.channel_value = 0xFFFFFFFF},
     .gives = "ffffffff 00000000 00000000 00000000",
     .effects = {{Effect::read_channel, 127}}},
    {.op = "rchcnt",
     .channel = 21,
     .answers = {.channel_value = 0x12345678, .channel_count = 16},
     .gives = "00000010 00000000 00000000 00000000",
     .effects = {{Effect::count_channel, 21}}},
    {.op = "wrch",
     .rt = "89abcdef 01234567 00000000 ffffffff",
     .channel = 16,
     .effects = {{Effect::write_channel, 16, 0x89ABCDEF}}},

    {.op = "stop", .immediate = 0x2100, .effects = {{Effect::stop, 0x2100}}},
    {.op = "stop", .immediate = 0x3FFF, .effects = {{Effect::stop, 0x3FFF}}},
    {.op = "stop", .effects = {{Effect::stop, 0}}},
    {.op = "stopd", .effects = {{Effect::stop, 0x3FFF}}},

    // There are no special registers.
    {.op = "mfspr", .channel = 5, .gives = "00"},
    {.op = "mtspr", .channel = 5},

    {.op = "nop"},
    {.op = "lnop"},
    {.op = "sync"},
    {.op = "sync", .feature = 0x40},
    {.op = "dsync"},
};

} // namespace

std::span<const Row> channel_rows() {
  return kRows;
}

TEST_CASE("channels, stops and special registers do as the ISA says") {
  check(kRows);
}

} // namespace celltrace::test
